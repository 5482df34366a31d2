// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/grazed_columns.h"

#include <algorithm>
#include <cmath>

#include "mapping/base/floor_to_int.h"
#include "mapping/fusion/ray_band.h"

namespace dhpmap {

GrazedColumns::GrazedColumns(const TangentPlane& plane, const Eigen::Vector3f& end_m,
                             const Eigen::Vector3f& sensor_offset_vox, float voxel_size_m) {
  const Eigen::Vector3f direction = end_m.normalized();
  const Eigen::Vector3f ahead = (direction - plane.normal * plane.normal.dot(direction)).normalized();
  int across = 0;
  plane.normal.cwiseAbs().maxCoeff(&across);
  for (int column = -1; column <= 1; ++column) {
    if (column < 0 && plane.before_m < voxel_size_m) continue;
    if (column > 0 && plane.behind_m < voxel_size_m) continue;
    const Eigen::Vector3f at_vox = end_m / voxel_size_m + ahead * static_cast<float>(column) + sensor_offset_vox;
    for (int step = -2; step <= 2; ++step) {
      Eigen::Vector3i voxel(FloorToInt(at_vox.x()), FloorToInt(at_vox.y()), FloorToInt(at_vox.z()));
      voxel[across] += step;
      const Eigen::Vector3f centre_vox = voxel.cast<float>() + Eigen::Vector3f::Constant(0.5f) - sensor_offset_vox;
      const float distance_m = plane.normal.dot(centre_vox) * voxel_size_m + plane.offset_m;
      if (std::abs(distance_m) > RayBand::kCellReach_vox * voxel_size_m) continue;
      const VoxelIndex offset{voxel.x(), voxel.y(), voxel.z()};
      const auto is_same = [offset](const Voxel& other) { return other.offset == offset; };
      if (std::any_of(begin(), end(), is_same)) continue;  // an oblique step sometimes stays in the column
      voxels_[num_++] = {offset, distance_m};
    }
  }
}

}  // namespace dhpmap
