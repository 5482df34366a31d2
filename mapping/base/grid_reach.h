// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace dhpmap {

/// How far a grid reaches from its origin along each axis: a quarter of what the 32-bit numbers of voxels hold. So a
/// sensor within reach of the map's grid is within 32 bits on the grid of any submap whose pose is within reach, too:
/// sqrt(3) times both, and the rays (at most 10^7 voxels) besides.
inline constexpr std::int32_t kGridReach_vox = 1 << 29;

inline double GridReach_m(double voxel_size_m) { return kGridReach_vox * voxel_size_m; }

/// What is wrong with the position on a grid of such voxels, with the limit and what to do about it; empty if nothing.
/// Neither NaN nor infinity is within reach.
std::string WhyBeyondGrid(const Eigen::Vector3d& p_m, double voxel_size_m);

}  // namespace dhpmap
