// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "mapping/mesh/mesh.h"
#include "mapping/query/distance_query.h"
#include "server/app/states/map_view.h"

// Compares a server that reuses index, surfaces and fields between states with a newly started one.

namespace dhpmap::testing {

/// The same submap with a new table, built block by block.
inline Submap RebuiltByBlock(const Submap& submap) {
  Submap rebuilt(submap.info(), 1);
  for (const BlockEntry& entry : submap.blocks().entries()) {
    if (entry.tsdf == nullptr && entry.labels == nullptr) continue;
    rebuilt.PutBlock(entry.index, entry.tsdf, entry.labels);
    if (entry.gone != nullptr) rebuilt.PutGone(entry.index, entry.gone);
  }
  rebuilt.UpdateBoundingSphere();
  return rebuilt;
}

/// Queries each state of a map near its objects. The points depend on the seed only.
class LiveAnswers {
 public:
  explicit LiveAnswers(unsigned seed) : random_(seed) {}

  /// Queries without comparing, so that the next state starts from this state's caches.
  void Follow(const MapView& live, SurfaceCache& surfaces) {
    const std::vector<Eigen::Vector3d> points_m = DrawPoints(live.snapshot());
    std::vector<SurfaceDistance> answers(points_m.size());
    DistanceQuery(surfaces.Of(live.shared_snapshot()), Approximate()).At(points_m, answers);
    (void)live.lookup();
  }

  /// Points and exact distances are bit-identical; near fields, some of which are made for this, are within their
  /// tolerance.
  ::testing::AssertionResult AreAsIfMadeAnew(const MapView& live, SurfaceCache& surfaces) {
    const MapView anew(live.shared_snapshot());
    SurfaceCache fresh(std::size_t{1} << 30);
    const auto kept = surfaces.Of(live.shared_snapshot());
    const DistanceQuery exact(kept, {}), quick(kept, Approximate()), truth(fresh.Of(live.shared_snapshot()), {});
    const std::vector<Eigen::Vector3d> points_m = DrawPoints(live.snapshot());
    const double voxel_size_m = live.snapshot().info().config.voxel_size_m;
    const auto differ = [](const char* what, const Eigen::Vector3d& p_m) {
      return ::testing::AssertionFailure() << what << " at " << p_m.transpose() << " is not as if made anew";
    };
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const Eigen::Vector3d& p_m = points_m[i];
      if (!IsSame(live.lookup().At(p_m), anew.lookup().At(p_m))) return differ("the point", p_m);
      const SurfaceDistance expected = truth.At(p_m);
      if (!IsSame(exact.At(p_m), expected)) return differ("the distance", p_m);
      const double expected_m = std::abs(expected.distance_m);
      if (!IsNear(quick.At(p_m), expected_m, voxel_size_m)) return differ("the near field", p_m);
      if (i >= kNumMade) continue;
      for (int n = 0; n < kTimes; ++n) (void)quick.At(p_m);
      if (!IsNear(quick.At(p_m), expected_m, voxel_size_m)) return differ("the near field made for it", p_m);
    }
    return ::testing::AssertionSuccess();
  }

  /// The mesh of one object has the size and extent of that of the rebuilt object.
  ::testing::AssertionResult MeshIsAsIfRebuilt(const MapSnapshot& map) {
    const Submap& object = *map.submaps()[random_() % map.submaps().size()];
    const Mesh mesh = ExtractMesh(object, *map.info().label_set, MeshColoring::kSensor);
    const Mesh anew = ExtractMesh(RebuiltByBlock(object), *map.info().label_set, MeshColoring::kSensor);
    const bool is_same = mesh.vertices_m.size() == anew.vertices_m.size() &&
                         mesh.triangles.size() == anew.triangles.size() &&
                         BoundsOf(mesh).min() == BoundsOf(anew).min() && BoundsOf(mesh).max() == BoundsOf(anew).max();
    if (is_same) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "the mesh of submap " << object.id().value << " has "
                                         << mesh.vertices_m.size() << " vertices, rebuilt " << anew.vertices_m.size();
  }

 private:
  static Eigen::AlignedBox3f BoundsOf(const Mesh& mesh) {
    Eigen::AlignedBox3f bounds_m;
    for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) bounds_m.extend(vertex_m);
    return bounds_m;
  }

  static constexpr std::size_t kNumPoints = 30;
  static constexpr std::size_t kNumMade = 3;  // fields are what takes longest
  static constexpr int kTimes = 70;           // more often than a cell must be asked for to be made

  static DistanceOptions Approximate() {
    DistanceOptions options;
    options.tolerance_vox = NearField::kTolerance_vox;
    return options;
  }

  static bool IsSame(const PointInfo& a, const PointInfo& b) {
    return a.is_observed == b.is_observed && a.is_free == b.is_free && a.submap == b.submap &&
           a.panoptic == b.panoptic && a.class_id == b.class_id && a.distance_m == b.distance_m &&
           a.weight == b.weight && a.color == b.color && a.class_confidence == b.class_confidence &&
           a.instance_confidence == b.instance_confidence;
  }
  /// Both answers are from one state, so an object is the same row.
  static bool IsSame(const SurfaceDistance& a, const SurfaceDistance& b) {
    if (a.status != b.status || a.distance_m != b.distance_m || a.submap != b.submap) return false;
    return a.gradient == b.gradient && (a.submap == nullptr || a.nearest_m == b.nearest_m);
  }
  /// Never too short, too long by what DistanceQuery says. Which side it is on may be another where two are as near.
  static bool IsNear(const SurfaceDistance& quick, double expected_m, double voxel_size_m) {
    const double rounding_m = 4e-5 * expected_m + 4e-4 * voxel_size_m;
    const double most_m = std::min(NearField::kTolerance_vox * voxel_size_m, NearField::kShare * expected_m);
    const double over_m = std::abs(quick.distance_m) - expected_m;
    return over_m >= -rounding_m && over_m <= most_m + rounding_m;
  }

  /// Around objects, each with equal probability.
  std::vector<Eigen::Vector3d> DrawPoints(const MapSnapshot& map) {
    std::vector<BoundingSphere> spheres;
    for (const auto& submap : map.submaps()) {
      if (!submap->bounding_sphere().IsEmpty()) spheres.push_back(submap->BoundingSphereInMap());
    }
    std::vector<Eigen::Vector3d> points_m;
    while (!spheres.empty() && points_m.size() < kNumPoints) {
      const BoundingSphere& sphere = spheres[random_() % spheres.size()];
      const double x = DrawUnit(), y = DrawUnit(), z = DrawUnit();
      // Walls are large: what stands before them is where the answers are not all the same.
      points_m.push_back(sphere.center_m + std::min(1.5, sphere.radius_m) * Eigen::Vector3d(x, y, z));
    }
    return points_m;
  }
  double DrawUnit() { return static_cast<double>(random_() % 2001) / 1000.0 - 1; }

  std::mt19937 random_;
};

}  // namespace dhpmap::testing
