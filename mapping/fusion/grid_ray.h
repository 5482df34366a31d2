// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "mapping/base/floor_to_int.h"
#include "mapping/base/grid.h"

namespace dhpmap {

/// Traverses the voxels on a ray, in order (Amanatides and Woo 1987). Lengths start at the sensor's origin, which lies
/// `offset_vox` (0..1) inside `base`.
class GridRay {
 public:
  /// `direction` is a unit vector; from_m <= to_m.
  GridRay(VoxelIndex base, const Eigen::Vector3f& offset_vox, const Eigen::Vector3f& direction, float voxel_size_m,
          float from_m, float to_m)
      : base_(base) {
    const float voxels_per_m = 1.0f / voxel_size_m;
    for (int axis = 0; axis < 3; ++axis) {
      const float d = direction[axis];
      const float start_vox = offset_vox[axis] + from_m * voxels_per_m * d;
      const float end_vox = offset_vox[axis] + to_m * voxels_per_m * d;
      index_[axis] = FloorToInt(start_vox);
      num_voxels_ += std::abs(FloorToInt(end_vox) - index_[axis]);
      step_[axis] = d < 0 ? -1 : 1;
      const float to_border_vox =
          d < 0 ? start_vox - static_cast<float>(index_[axis]) : static_cast<float>(index_[axis] + 1) - start_vox;
      const float per_voxel = d == 0 ? std::numeric_limits<float>::infinity() : 1.0f / std::abs(d);
      t_step_[axis] = per_voxel;
      t_next_[axis] = d == 0 ? std::numeric_limits<float>::infinity() : to_border_vox * per_voxel;
      along_step_m_[axis] = std::abs(d) * voxel_size_m;
      centre_along_m_ += (static_cast<float>(index_[axis]) + 0.5f - offset_vox[axis]) * d * voxel_size_m;
    }
  }

  /// Number of voxels on the ray; call Next one time fewer.
  [[nodiscard]] int num_voxels() const { return num_voxels_; }
  [[nodiscard]] VoxelIndex voxel() const { return {base_.x + index_[0], base_.y + index_[1], base_.z + index_[2]}; }
  /// Distance of the voxel's centre from the origin, projected onto the ray.
  [[nodiscard]] float CentreAlongRay_m() const { return centre_along_m_; }

  /// Centre of the current voxel, relative to the sensor's origin.
  [[nodiscard]] Eigen::Vector3f Centre_m(const Eigen::Vector3f& offset_vox, float voxel_size_m) const {
    const Eigen::Vector3f corner_vox(static_cast<float>(index_[0]), static_cast<float>(index_[1]),
                                     static_cast<float>(index_[2]));
    return (corner_vox + Eigen::Vector3f::Constant(0.5f) - offset_vox) * voxel_size_m;
  }
  /// Direction along an axis: -1 or 1.
  [[nodiscard]] int Sense(int axis) const { return step_[axis]; }

  /// Steps to the next voxel; returns the axis of the step.
  int Next() {
    const int axis = t_next_[0] < t_next_[1] ? (t_next_[0] < t_next_[2] ? 0 : 2) : (t_next_[1] < t_next_[2] ? 1 : 2);
    for (int i = 0; i < 3; ++i) {  // all three: a read of all soon after a single write would stall on store forwarding
      index_[i] += i == axis ? step_[i] : 0;
      t_next_[i] += i == axis ? t_step_[i] : 0.0f;
    }
    centre_along_m_ += along_step_m_[axis];
    return axis;
  }

 private:
  VoxelIndex base_;
  int index_[3];
  int step_[3];
  float t_next_[3];
  float t_step_[3];
  float along_step_m_[3];
  float centre_along_m_ = 0;
  int num_voxels_ = 1;
};

/// Distance from a plane to the centre of the current voxel, updated incrementally; positive in front of it.
class DistanceToPlane {
 public:
  DistanceToPlane(const GridRay& ray, const Eigen::Vector3f& offset_vox, float voxel_size_m,
                  const Eigen::Vector3f& normal, float offset_m)
      : distance_m_(normal.dot(ray.Centre_m(offset_vox, voxel_size_m)) + offset_m) {
    for (int axis = 0; axis < 3; ++axis) {
      step_m_[axis] = normal[axis] * static_cast<float>(ray.Sense(axis)) * voxel_size_m;
    }
  }
  void GoOn(int axis) { distance_m_ += step_m_[axis]; }
  [[nodiscard]] float distance_m() const { return distance_m_; }

 private:
  float distance_m_;
  float step_m_[3];
};

}  // namespace dhpmap
