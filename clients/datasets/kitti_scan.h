// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// Points of a velodyne/NNNNNN.bin (float32 x, y, z, reflectance), in the LiDAR's frame.
Result<std::vector<Eigen::Vector3f>> ReadKittiPoints(const std::filesystem::path& path);

/// Words of a labels/NNNNNN.label, one a point; BAD_SCAN unless there are `num_points`.
Result<std::vector<std::uint32_t>> ReadKittiLabels(const std::filesystem::path& path, std::size_t num_points);

/// Leaves out, in both lists, points that are not labelled and points of things that move.
void DropUnlabelledAndMoving(std::vector<Eigen::Vector3f>& points_m, std::vector<std::uint32_t>& words);

/// Words of points of things that move become 0, not labelled.
void UnlabelMoving(std::vector<std::uint32_t>& words);

}  // namespace dhpmap
