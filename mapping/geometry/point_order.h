// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace dhpmap {

/// Indices of the points (finite, fewer than 2^32) along a Z-order curve through their bounding box, so that
/// consecutive ones are mostly close.
std::vector<std::uint32_t> OrderAlongCurve(std::span<const Eigen::Vector3d> points);

}  // namespace dhpmap
