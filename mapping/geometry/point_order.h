// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace dhpmap {

/// The numbers of the points (finite, fewer than 2^32) in an order in which each is mostly close to the one before:
/// along a Z-order curve through the box around them.
std::vector<std::uint32_t> OrderAlongCurve(std::span<const Eigen::Vector3d> points);

}  // namespace dhpmap
