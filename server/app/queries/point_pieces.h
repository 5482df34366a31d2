// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mapping/base/spread.h"

namespace dhpmap {

/// Cuts many points into batches of about the same size, so that whoever has given up is seen between two, and what
/// answers take beside the answer is bounded.
std::vector<std::span<const Eigen::Vector3d>> BatchesOf(std::span<const Eigen::Vector3d> points_m);

/// Calls body(numbers) with pieces that hold the numbers of all points of a batch, each of points that are close
/// together, so that they share what is in the caches.
void SpreadAlongCurve(std::span<const Eigen::Vector3d> batch, const Spread& spread,
                      const std::function<void(std::span<const std::uint32_t>)>& body);

}  // namespace dhpmap
