// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace dhpmap {

/// Extent of a grid from its origin along each axis: a quarter of the range of 32-bit voxel indices. So a sensor within
/// reach of the map's grid fits into 32 bits on the grid of any submap with a pose within reach: sqrt(3) times both,
/// plus rays of at most 10^7 voxels.
inline constexpr std::int32_t kGridReach_vox = 1 << 29;

inline double GridReach_m(double voxel_size_m) { return kGridReach_vox * voxel_size_m; }

/// Explains why a position is beyond a grid of such voxels, with the limit and a remedy; empty if it is within reach.
/// NaN and infinity never are.
std::string WhyBeyondGrid(const Eigen::Vector3d& p_m, double voxel_size_m);

}  // namespace dhpmap
