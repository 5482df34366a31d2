// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// Points of a velodyne/NNNNNN.bin (float32 x, y, z, reflectance), in m in the LiDAR's frame.
Result<std::vector<Eigen::Vector3f>> ReadKittiPoints(const std::filesystem::path& path);

/// Words of a labels/NNNNNN.label, one per point; BAD_SCAN if their number is not `num_points`.
Result<std::vector<std::uint32_t>> ReadKittiLabels(const std::filesystem::path& path, std::size_t num_points);

/// Removes unlabelled and moving points from both lists.
void DropUnlabelledAndMoving(std::vector<Eigen::Vector3f>& points_m, std::vector<std::uint32_t>& words);

/// Sets the words of moving points to 0, unlabelled.
void UnlabelMoving(std::vector<std::uint32_t>& words);

}  // namespace dhpmap
