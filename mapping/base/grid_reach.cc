// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/grid_reach.h"

#include <array>
#include <charconv>
#include <cmath>

namespace dhpmap {
namespace {

std::string Short(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace

std::string WhyBeyondGrid(const Eigen::Vector3d& p_m, double voxel_size_m) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  const double reach_m = GridReach_m(voxel_size_m);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(p_m[axis]) <= reach_m) continue;
    return std::string(kAxes[static_cast<std::size_t>(axis)]) + " = " + Short(p_m[axis]) + " m is beyond +-" +
           Short(reach_m) + " m, which a grid of " + Short(voxel_size_m) +
           " m voxels reaches: use a local frame, with its origin near the place";
  }
  return {};
}

}  // namespace dhpmap
