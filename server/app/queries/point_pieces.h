// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mapping/base/spread.h"

namespace dhpmap {

/// Divides points into batches of similar size, so that cancellation is seen between two and working memory is bounded.
std::vector<std::span<const Eigen::Vector3d>> BatchesOf(std::span<const Eigen::Vector3d> points_m);

/// Calls body(numbers) for pieces of a batch, each with points that are close together, for cache locality.
void SpreadAlongCurve(std::span<const Eigen::Vector3d> batch, const Spread& spread,
                      const std::function<void(std::span<const std::uint32_t>)>& body);

}  // namespace dhpmap
