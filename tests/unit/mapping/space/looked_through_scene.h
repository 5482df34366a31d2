// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "mapping/space/free_space_finder.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A room of 5 x 4 x 2.6 m with a table, a ball and a pillar; only its walls' inner faces can be seen.
inline Scene FurnishedRoom() {
  using Shape = Solid::Shape;
  const auto wall = [](Eigen::Vector3d point, Eigen::Vector3d normal) {
    return Solid{.shape = Shape::kHalfSpace, .center_m = point, .size_m = normal};
  };
  return {{wall({0, 0, 0}, {0, 0, 1}),
           wall({0, 0, 2.6}, {0, 0, -1}),
           wall({-2.5, 0, 0}, {1, 0, 0}),
           wall({2.5, 0, 0}, {-1, 0, 0}),
           wall({0, -2, 0}, {0, 1, 0}),
           wall({0, 2, 0}, {0, -1, 0}),
           {.shape = Shape::kBox, .center_m = {1.2, 0.4, 0.7}, .size_m = {0.5, 0.4, 0.04}},
           {.shape = Shape::kSphere, .center_m = {0.6, -1.0, 0.5}, .size_m = {0.3, 0, 0}},
           {.shape = Shape::kBox, .center_m = {-0.4, 1.1, 1.3}, .size_m = {0.06, 0.06, 1.3}}}};
}

/// Where the unit ray, from outside, enters a solid; infinity if it does not.
inline double Enter(const Solid& solid, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d to = solid.center_m - origin;
  switch (solid.shape) {
    case Solid::Shape::kHalfSpace: {
      const double along = direction.dot(solid.size_m);
      return along < 0 ? std::max(0.0, to.dot(solid.size_m) / along) : kNever;
    }
    case Solid::Shape::kSphere: {
      const double nearest = to.dot(direction);
      const double half2 = solid.size_m.x() * solid.size_m.x() - (to - nearest * direction).squaredNorm();
      return half2 > 0 && nearest > 0 ? nearest - std::sqrt(half2) : kNever;
    }
    case Solid::Shape::kBox: {
      double enter = 0, leave = kNever;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (to[axis] - solid.size_m[axis]) / direction[axis];
        const double b = (to[axis] + solid.size_m[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      return enter < leave ? enter : kNever;
    }
  }
  return kNever;
}

/// Distance to what the unit ray hits first, or infinity if nothing within 60 m.
inline double CastRay(const Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double nearest = 60;
  for (const Solid& solid : scene.solids) nearest = std::min(nearest, Enter(solid, origin, direction));
  return nearest < 60 ? nearest : std::numeric_limits<double>::infinity();
}

/// 320 x 240 pixels, 90 degrees wide.
inline PinholeCamera QuarterCamera() { return {320, 240, 160, 160, 160, 120}; }

/// Frame `i` of a walk around the room.
inline PanopticFrame RoomFrame(int i, const Scene& scene) {
  const double angle = 0.7 * i;
  const Eigen::Vector3d eye(1.0 * std::cos(angle) - 0.6, 0.9 * std::sin(angle) - 0.2, 1.25);
  const Eigen::Vector3d target(2.0 * std::cos(angle + 2.0), 1.5 * std::sin(angle + 2.0), 0.7);
  PanopticFrame frame = Render(scene, QuarterCamera(), LookAt(eye, target));
  frame.stamp_ns = i * 100'000'000LL;
  return frame;
}

/// A scanner with `num_beams` beams from `low_deg` to `high_deg` and `num_columns` columns around; what is hit within
/// 60 m.
inline PanopticFrame Scan(const Scene& scene, const Transform& T_map_lidar, int num_beams, double low_deg,
                          double high_deg, int num_columns) {
  PanopticFrame frame;
  frame.T_map_sensor = T_map_lidar;
  LidarData& data = frame.lidar.emplace();
  for (int beam = 0; beam < num_beams; ++beam) {
    const double elevation = (low_deg + (high_deg - low_deg) * beam / std::max(1, num_beams - 1)) * M_PI / 180;
    for (int column = 0; column < num_columns; ++column) {
      const double azimuth = 2 * M_PI * column / num_columns;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const double range = CastRay(scene, T_map_lidar.translation(), T_map_lidar.linear() * ray);
      if (std::isfinite(range)) data.points_m.emplace_back((range * ray).cast<float>());
    }
  }
  return frame;
}

/// A map that has looked through these frames.
inline Map MapOfLooks(const MapConfig& config, const std::vector<PanopticFrame>& frames, int num_threads = 1) {
  MapInfo info;
  info.name = "m";
  info.config = config;
  Map map(info);
  ThreadPool pool(num_threads);
  FreeSpaceFinder finder;
  for (const PanopticFrame& frame : frames) finder.Look(frame, map, pool);
  return map;
}

/// Calls visit(VoxelIndex) for all voxels of a box, in metres.
template <typename Visitor>
void ForEachVoxel(const Eigen::Vector3d& least_m, const Eigen::Vector3d& most_m, double voxel_size_m, Visitor&& visit) {
  const VoxelIndex first = VoxelAt(least_m, voxel_size_m), last = VoxelAt(most_m, voxel_size_m);
  for (std::int32_t z = first.z; z <= last.z; ++z) {
    for (std::int32_t y = first.y; y <= last.y; ++y) {
      for (std::int32_t x = first.x; x <= last.x; ++x) visit(VoxelIndex{x, y, z});
    }
  }
}

}  // namespace dhpmap::testing
