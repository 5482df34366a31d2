// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/pipeline/map_builder.h"
#include "mapping/query/distance_query.h"
#include "mapping/surfaces/surface_cache.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

// A room that sensors walk through, and what a map of it says that is there, as the tests of what is gone need them.

namespace dhpmap::testing {

inline constexpr ClassId kChair{1}, kPerson{2}, kWall{3}, kFloor{4}, kDoor{5};
inline constexpr std::int64_t kPeriod_ns = 100'000'000;
inline const PinholeCamera kCamera{200, 150, 130, 130, 100, 75};

inline Solid Box(ClassId of, const Eigen::Vector3d& center_m, const Eigen::Vector3d& half_m) {
  return {.shape = Solid::Shape::kBox, .center_m = center_m, .size_m = half_m, .segment = of.value};
}

/// A room that is open towards -x, with a wall at x = 3 and one at y = 2.
inline Scene EmptyRoom() {
  const auto face = [](ClassId of, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    return Solid{.shape = Solid::Shape::kHalfSpace, .center_m = point, .size_m = normal, .segment = of.value};
  };
  return {{face(kFloor, {0, 0, 0}, {0, 0, 1}), face(kWall, {3, 0, 0}, {-1, 0, 0}), face(kWall, {0, 2, 0}, {0, -1, 0})}};
}

inline Scene With(Scene scene, const Solid& solid) {
  scene.solids.push_back(solid);
  return scene;
}

inline Solid Chair(double x_m = 1.7, double y_m = 0.2) { return Box(kChair, {x_m, y_m, 0.4}, {0.25, 0.25, 0.4}); }

struct Hit {
  double t = 30;
  const Solid* solid = nullptr;
};

/// What a ray from outside meets first: boxes and half spaces in closed form.
inline Hit Cast(const Scene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) {
  Hit hit;
  for (const Solid& solid : scene.solids) {
    double t = 0, leave = 1e9;
    if (solid.shape == Solid::Shape::kHalfSpace) {
      const double along = ray.dot(solid.size_m);
      if (along >= 0) continue;
      t = (solid.center_m - eye).dot(solid.size_m) / along;
    } else {
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (solid.center_m[axis] - solid.size_m[axis] - eye[axis]) / ray[axis];
        const double b = (solid.center_m[axis] + solid.size_m[axis] - eye[axis]) / ray[axis];
        t = std::max(t, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (t >= leave) continue;
    }
    if (t < hit.t) hit = {t, &solid};
  }
  return hit;
}

inline PanopticFrame FrameFrom(const Scene& scene, const Eigen::Vector3d& eye, std::int64_t stamp_ns) {
  PanopticFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.T_map_sensor = LookAt(eye, {1.8, 0.2, 0.5});
  DepthCameraData& data = frame.camera.emplace();
  data.camera = kCamera;
  for (int v = 0; v < kCamera.height_px; ++v) {
    for (int u = 0; u < kCamera.width_px; ++u) {
      const Eigen::Vector3d ray((u - kCamera.cx_px) / kCamera.fx_px, (v - kCamera.cy_px) / kCamera.fy_px, 1);
      const Hit hit = Cast(scene, eye, frame.T_map_sensor.linear() * ray);
      data.depth_m.push_back(hit.solid != nullptr ? static_cast<float>(hit.t) : 0.0f);
      data.segments.push_back(hit.solid != nullptr ? hit.solid->segment : 0);
    }
  }
  for (const ClassId c : {kChair, kPerson, kWall, kFloor, kDoor}) {
    frame.segments.push_back({.id = SegmentId(c.value), .class_id = c});
  }
  return frame;
}

/// Frame `i` of a walk to and fro on an arc.
inline PanopticFrame WalkFrame(const Scene& scene, int i) {
  const double angle = 0.8 * std::sin(0.3 * i);
  return FrameFrom(scene, {1.7 - 2.0 * std::cos(angle), 0.2 - 2.0 * std::sin(angle), 1.3}, i * kPeriod_ns);
}

inline MapInfo Info() {
  MapInfo info = NamedMap("room", 2, 3);
  info.config.tracking.min_points_stuff = 100;
  info.config.tracking.min_points_medium = 50;
  info.config.refinement.every_frames = 0;
  return info;
}

/// A mapping session that counts its frames.
class Session {
 public:
  explicit Session(MapInfo info = Info(), int num_threads = 1) : builder_(std::move(info), num_threads) {}

  void Walk(const Scene& scene, int num_frames) {
    for (; num_frames > 0; --num_frames) Take(WalkFrame(scene, next_++));
  }
  void Take(const PanopticFrame& frame) {
    const auto report = builder_.Integrate(frame);
    ASSERT_TRUE(report.ok()) << report.status().ToString();
  }
  Map& map() { return builder_.map(); }
  MapBuilder& builder() { return builder_; }
  std::shared_ptr<const MapSnapshot> Now() { return builder_.map().Publish(0); }
  int next_ = 0;

 private:
  MapBuilder builder_;
};

inline const Submap* FindThing(const MapSnapshot& map, ClassId of) {
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing && submap->info().class_id == of) return submap.get();
  }
  return nullptr;
}

/// Points on the sides and the top of a box, but for what is within a voxel of the floor.
inline std::vector<Eigen::Vector3d> PointsOf(const Solid& box) {
  std::vector<Eigen::Vector3d> points;
  constexpr int kSteps = 9;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double a = 2.0 * i / kSteps - 1, b = 2.0 * k / kSteps - 1;
      for (const Eigen::Vector3d& at : {Eigen::Vector3d(-1, a, b), Eigen::Vector3d(1, a, b), Eigen::Vector3d(a, -1, b),
                                        Eigen::Vector3d(a, 1, b), Eigen::Vector3d(a, b, 1)}) {
        const Eigen::Vector3d p = box.center_m + at.cwiseProduct(box.size_m);
        if (p.z() > 0.04) points.push_back(p);
      }
    }
  }
  return points;
}

/// Of the points, those that have a surface within a voxel; by distance queries, which know surfaces only.
inline std::vector<Eigen::Vector3d> WithSurface(const std::shared_ptr<const MapSnapshot>& map,
                                                const std::vector<Eigen::Vector3d>& points) {
  SurfaceCache cache(std::size_t{1} << 28);
  const DistanceQuery query(cache.Of(map), {.max_distance_m = 1.0});
  std::vector<Eigen::Vector3d> found;
  for (const Eigen::Vector3d& p : points) {
    if (std::abs(query.At(p).distance_m) <= 0.04) found.push_back(p);
  }
  return found;
}

inline double ShareWithSurface(const std::shared_ptr<const MapSnapshot>& map,
                               const std::vector<Eigen::Vector3d>& points) {
  return static_cast<double>(WithSurface(map, points).size()) / static_cast<double>(points.size());
}

}  // namespace dhpmap::testing
