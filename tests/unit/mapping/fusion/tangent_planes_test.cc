// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/tangent_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "mapping/fusion/bundler.h"
#include "mapping/fusion/grazed_columns.h"
#include "mapping/fusion/integrator.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::LookAt;
using testing::Render;
using testing::Scene;
using testing::SmallCamera;
using testing::Solid;

constexpr ClassId kSeenClass{3};
constexpr double kSide_m = 0.04, kBand_m = 0.08;

Scene Floor() { return {{{.shape = Solid::Shape::kHalfSpace, .center_m = {0, 0, 0.013}, .size_m = {0, 0, 1}}}}; }
Scene Ball() { return {{{.shape = Solid::Shape::kSphere, .center_m = {2.01, 0.02, 1.01}, .size_m = {0.5, 0, 0}}}}; }
Scene Box() { return {{{.shape = Solid::Shape::kBox, .center_m = {2.013, 0.021, 1.007}, .size_m = {0.5, 0.45, 0.4}}}}; }

PanopticFrame OneSegment(PanopticFrame frame) {
  for (std::uint32_t& id : frame.camera->segments) id = 1;
  frame.segments = {{.id = SegmentId(1), .class_id = kSeenClass}};
  return frame;
}
PanopticFrame See(const Scene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  return OneSegment(Render(scene, SmallCamera(), LookAt(eye, target)));
}

/// A scan from above a road at z = 0: rings that lie apart by more the farther away.
PanopticFrame ScanOfRoad() {
  constexpr double kHeight_m = 1.73;
  PanopticFrame frame;
  LidarData& data = frame.lidar.emplace();
  for (int row = 0; row < 50; ++row) {
    for (int column = 0; column < 471; ++column) {
      const double slope = (3 + 0.42 * row) * std::numbers::pi / 180;
      const double angle = (-40 + 0.17 * column) * std::numbers::pi / 180;
      const double ahead_m = kHeight_m / std::tan(slope);
      data.points_m.emplace_back(
          Eigen::Vector3d(ahead_m * std::cos(angle), ahead_m * std::sin(angle), -kHeight_m).cast<float>());
    }
  }
  frame.T_map_sensor.translation() = Eigen::Vector3d(0.03, 0.05, kHeight_m);
  return frame;
}

PanopticFrame ScanOf(const std::vector<Eigen::Vector3f>& points_m) {
  PanopticFrame frame;
  frame.lidar.emplace().points_m = points_m;
  return frame;
}

IntegrationConfig FarReaching() {
  IntegrationConfig config;
  config.max_range_m = 60;
  return config;
}

std::vector<SegmentBundles> BundlesOf(const PanopticFrame& frame, double voxel_size_m = kSide_m, int num_threads = 1) {
  ThreadPool pool(num_threads);
  Bundler bundler(FarReaching(), pool);
  return bundler.BundleFrame(frame, frame.T_map_sensor, voxel_size_m);
}

void AlongRays(std::vector<SegmentBundles>& segments) {
  for (SegmentBundles& segment : segments) {
    for (Bundle& bundle : segment.bundles) {
      const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
      bundle.plane = {.normal = -end_m.normalized(), .offset_m = end_m.norm()};
    }
  }
}

bool IsAcrossRay(const Bundle& bundle) {
  const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
  return bundle.plane.normal.isApprox(-end_m.normalized(), 1e-5f) &&
         std::abs(bundle.plane.offset_m - end_m.norm()) < 1e-4f && bundle.plane.before_m == 0 &&
         bundle.plane.behind_m == 0;
}

Submap Fuse(const std::vector<SegmentBundles>& segments, const PanopticFrame& frame, double voxel_size_m,
            double truncation_m) {
  SubmapInfo info;
  info.id = SubmapId(1);
  info.voxel_size_m = voxel_size_m;
  info.truncation_m = truncation_m;
  Submap submap(info, 1);
  const RayOrigin origin(frame.T_map_sensor.translation(), voxel_size_m);
  for (const SegmentBundles& segment : segments) IntegrateSegment(segment, origin, kSeenClass, FarReaching(), submap);
  return submap;
}

/// |Stored - true distance| of the voxels near the surface, in voxels, ascending.
std::vector<double> Errors(const std::vector<SegmentBundles>& segments, const PanopticFrame& frame, const Scene& scene,
                           const std::function<bool(const Eigen::Vector3d&)>& counts) {
  const Submap submap = Fuse(segments, frame, kSide_m, kBand_m);
  std::vector<double> errors;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const Eigen::Vector3d centre = VoxelCentre(VoxelIn(entry.index, i), kSide_m);
      const double truth_m = scene.Distance(centre);
      if (!entry.tsdf->IsObserved(i) || std::abs(truth_m) > kSide_m || !counts(centre)) continue;
      errors.push_back(std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(i)] - truth_m) / kSide_m);
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}
std::vector<double> RayErrors(const PanopticFrame& frame, const Scene& scene,
                              const std::function<bool(const Eigen::Vector3d&)>& counts) {
  std::vector<SegmentBundles> segments = BundlesOf(frame);
  AlongRays(segments);
  return Errors(segments, frame, scene, counts);
}
double At(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}
bool Everywhere(const Eigen::Vector3d&) { return true; }

TEST(TangentPlanes, OfAFloorThatIsGrazedAreTheFloor) {
  const PanopticFrame frame = See(Floor(), {0.1, 0.2, 0.4}, {3, 0.2, 0.1});
  // Farther away the rows of pixels lie several voxels apart.
  const auto is_near = [](const Eigen::Vector3d& p) { return p.head<2>().norm() < 1.5; };
  const std::vector<double> errors = Errors(BundlesOf(frame), frame, Floor(), is_near);
  ASSERT_GT(errors.size(), 1000u);
  EXPECT_LT(At(errors, 0.5), 0.01);
  EXPECT_LT(At(errors, 0.95), 0.05);
  EXPECT_GT(At(RayErrors(frame, Floor(), is_near), 0.5), 0.1) << "along the ray they were far off";
}

TEST(TangentPlanes, OfABallFollowItWithinATenthOfAVoxel) {
  const PanopticFrame frame = See(Ball(), {0.3, 0.1, 1.2}, {2, 0, 1});
  const std::vector<double> errors = Errors(BundlesOf(frame), frame, Ball(), Everywhere);
  ASSERT_GT(errors.size(), 500u);
  EXPECT_LT(At(errors, 0.5), 0.1);
  EXPECT_LT(At(errors, 0.5), At(RayErrors(frame, Ball(), Everywhere), 0.5));
}

TEST(TangentPlanes, DoNotSmearTheEdgeOfABox) {
  const PanopticFrame frame = See(Box(), {0.2, -0.9, 1.9}, {2, 0, 1});
  const auto at_an_edge = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d from_face = (Box().solids[0].size_m - (p - Box().solids[0].center_m).cwiseAbs()).cwiseAbs();
    return (from_face.array() < 2 * kSide_m).count() == 2;
  };
  const std::vector<double> errors = Errors(BundlesOf(frame), frame, Box(), at_an_edge);
  const std::vector<double> before = RayErrors(frame, Box(), at_an_edge);
  ASSERT_GT(errors.size(), 200u);
  EXPECT_LE(At(errors, 0.5), At(before, 0.5));
  EXPECT_LE(At(errors, 0.95), At(before, 0.95) * 1.05);
}

TEST(TangentPlanes, AverageNoiseAway) {
  PanopticFrame frame = See(Floor(), {0.1, 0.2, 0.9}, {2, 0.2, 0});
  std::mt19937 random(5);
  std::normal_distribution<float> noise_m(0, 0.008f);
  for (float& depth_m : frame.camera->depth_m) {
    if (depth_m > 0) depth_m += noise_m(random);
  }
  const std::vector<double> errors = Errors(BundlesOf(frame), frame, Floor(), Everywhere);
  const std::vector<double> before = RayErrors(frame, Floor(), Everywhere);
  EXPECT_LT(At(errors, 0.5), 0.7 * At(before, 0.5));
  EXPECT_LT(At(errors, 0.95), At(before, 0.95));
}

TEST(TangentPlanes, OfARoadAreTheRoadWhereItsRingsLieMetresApart) {
  constexpr float kRoadVoxel_m = 0.1f;
  int num_far = 0;
  for (const SegmentBundles& segment : BundlesOf(ScanOfRoad(), kRoadVoxel_m)) {
    for (const Bundle& bundle : segment.bundles) {
      const float range_m = (bundle.weighted_sum_m / bundle.weight).norm();
      if (range_m < 15 || range_m > 25) continue;
      ++num_far;
      ASSERT_GT(bundle.plane.normal.z(), 0.9999f);
      ASSERT_NEAR(bundle.plane.offset_m, 1.73f, 0.01f);
    }
  }
  EXPECT_GT(num_far, 1000);
}

/// The share of a road's measured voxels, 20 to 30 m ahead, that belong to a cell with all corners stored, four of them
/// above the road and four below.
double ShareWithASurface(const std::vector<SegmentBundles>& segments, const PanopticFrame& frame) {
  constexpr double kRoadVoxel_m = 0.1, kRoadTruncation_m = 0.3;
  const Submap submap = Fuse(segments, frame, kRoadVoxel_m, kRoadTruncation_m);
  const auto stored = [&](VoxelIndex at) {
    const BlockEntry* entry = submap.blocks().Find(BlockOf(at));
    const int linear = LinearIndex(at);
    return entry != nullptr && entry->tsdf->IsObserved(linear) ? entry->tsdf->distance_m[linear] : NAN;
  };
  const auto is_crossed = [&](int x, int y) { return stored({x, y, -1}) < 0 && stored({x, y, 0}) > 0; };
  const auto is_cell = [&](int x, int y) {
    return is_crossed(x, y) && is_crossed(x + 1, y) && is_crossed(x, y + 1) && is_crossed(x + 1, y + 1);
  };
  int num_ends = 0, num_with = 0;
  for (const SegmentBundles& segment : segments) {
    for (const Bundle& bundle : segment.bundles) {
      const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
      if (end_m.norm() < 20 || end_m.norm() > 30) continue;
      const VoxelIndex at = VoxelAt(end_m.cast<double>() + frame.T_map_sensor.translation(), kRoadVoxel_m);
      ++num_ends;
      num_with +=
          is_cell(at.x, at.y) || is_cell(at.x - 1, at.y) || is_cell(at.x, at.y - 1) || is_cell(at.x - 1, at.y - 1);
    }
  }
  EXPECT_GT(num_ends, 500);
  return static_cast<double>(num_with) / num_ends;
}

TEST(GrazedColumns, GiveMeasuredVoxelsOfARoadASurfaceWhereRingsLieMetresApart) {
  const PanopticFrame frame = ScanOfRoad();
  std::vector<SegmentBundles> segments = BundlesOf(frame, 0.1);
  EXPECT_GT(ShareWithASurface(segments, frame), 0.9);
  AlongRays(segments);
  EXPECT_LT(ShareWithASurface(segments, frame), 0.2) << "a ray stays on one side of the road";
}

TEST(GrazedColumns, StayWithinTheirReachAndWithinACellOfThePlane) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> part(-1, 1);
  constexpr float kVoxel_m = 0.1f;
  for (int round = 0; round < 200; ++round) {
    const Eigen::Vector3f end_m = Eigen::Vector3f{20 * part(random), 20 * part(random), 20 * part(random)};
    const Eigen::Vector3f towards = -end_m.normalized(), side = towards.unitOrthogonal();
    const float cosine = 0.05f + 0.1f * std::abs(part(random));
    const Eigen::Vector3f normal = cosine * towards + std::sqrt(1 - cosine * cosine) * side;
    const TangentPlane plane{.normal = normal, .offset_m = -normal.dot(end_m), .before_m = 0.5f, .behind_m = 0.5f};
    ASSERT_TRUE(GrazedColumns::AreNeeded(plane, -towards));
    const Eigen::Vector3f offset_vox(0.3f, 0.9f, 0.1f);
    const VoxelIndex end = VoxelAt((end_m / kVoxel_m + offset_vox).cast<double>(), 1.0);
    int num = 0;
    std::set<std::array<int, 3>> seen;
    for (const GrazedColumns::Voxel& v : GrazedColumns(plane, end_m, offset_vox, kVoxel_m)) {
      const Eigen::Vector3f centre_m =
          (Eigen::Vector3f(v.offset.x, v.offset.y, v.offset.z) + Eigen::Vector3f::Constant(0.5f) - offset_vox) *
          kVoxel_m;
      EXPECT_TRUE(seen.insert({v.offset.x, v.offset.y, v.offset.z}).second) << "written once a ray";
      EXPECT_NEAR(v.distance_m, normal.dot(centre_m - end_m), 1e-4f);
      EXPECT_LE(std::abs(v.distance_m), 1.5f * kVoxel_m);
      for (const int away : {v.offset.x - end.x, v.offset.y - end.y, v.offset.z - end.z}) {
        EXPECT_LE(std::abs(away), GrazedColumns::kReach_vox);
      }
      ++num;
    }
    EXPECT_GE(num, 6);
  }
}

TEST(TangentPlanes, LeaveNoHolesBetweenTheRingsOfAScan) {
  constexpr double kRoadVoxel_m = 0.2, kRoadTruncation_m = 0.4;
  const PanopticFrame frame = ScanOfRoad();
  // The columns of voxels between 6 and 12 m ahead in which both corners of the cell around the road are stored.
  const auto share_of_columns = [&](const std::vector<SegmentBundles>& segments) {
    const Submap submap = Fuse(segments, frame, kRoadVoxel_m, kRoadTruncation_m);
    int num_columns = 0, num_closed = 0;
    for (int x = 30; x < 60; ++x) {
      for (int y = -x / 2; y < x / 2; ++y) {
        const auto stored = [&](int z) -> std::optional<float> {
          const BlockEntry* entry = submap.blocks().Find(BlockOf({x, y, z}));
          const int linear = LinearIndex({x, y, z});
          if (entry == nullptr || !entry->tsdf->IsObserved(linear)) return std::nullopt;
          return entry->tsdf->distance_m[static_cast<std::size_t>(linear)];
        };
        ++num_columns;
        const std::optional<float> below = stored(-1), above = stored(0);  // centres at -0.1 and 0.1 m
        num_closed += below && above && *below < 0 && *above > 0;
      }
    }
    return static_cast<double>(num_closed) / num_columns;
  };
  std::vector<SegmentBundles> segments = BundlesOf(frame, kRoadVoxel_m);
  const double across = share_of_columns(segments);
  AlongRays(segments);
  EXPECT_GT(across, 0.97);
  EXPECT_LT(share_of_columns(segments), 0.7) << "a road that was whole anyway shows nothing";
}

TEST(TangentPlanes, OfADepthImageAreNotWalkedOn) {
  for (const SegmentBundles& segment : BundlesOf(See(Floor(), {0.1, 0.2, 0.4}, {3, 0.2, 0.1}))) {
    for (const Bundle& bundle : segment.bundles) {
      ASSERT_EQ(bundle.plane.before_m, 0);
      ASSERT_EQ(bundle.plane.behind_m, 0);
    }
  }
}

TEST(TangentPlanes, OfALonePointAndALineAreAcrossTheRay) {
  const std::vector<SegmentBundles> point = BundlesOf(ScanOf({{2, 0.3f, -0.5f}}));
  ASSERT_EQ(point.size(), 1u);
  EXPECT_TRUE(IsAcrossRay(point[0].bundles[0]));
  std::vector<Eigen::Vector3f> line_m;
  line_m.reserve(200);
  for (int i = 0; i < 200; ++i) line_m.emplace_back(2, -1 + 0.01f * static_cast<float>(i), -0.5f);
  const std::vector<SegmentBundles> line = BundlesOf(ScanOf(line_m));
  ASSERT_GT(line[0].bundles.size(), 40u);
  for (const Bundle& bundle : line[0].bundles) EXPECT_TRUE(IsAcrossRay(bundle));
}

TEST(TangentPlanes, ReachNoFartherThanOtherPointsInThem) {
  // A patch of half a metre that is grazed: nothing is known of where its plane goes on.
  std::vector<Eigen::Vector3f> points_m;
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) {
      points_m.emplace_back(4 + 0.01f * static_cast<float>(i), 0.01f * static_cast<float>(j), -1.0f);
    }
  }
  const std::vector<SegmentBundles> segments = BundlesOf(ScanOf(points_m));
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_GT(segments[0].bundles.size(), 100u) << "a voxel is 4 cm wide";
  for (const Bundle& bundle : segments[0].bundles) {
    const float x_m = bundle.weighted_sum_m.x() / bundle.weight;
    EXPECT_LT(x_m - bundle.plane.before_m, 4.5f);
    EXPECT_GT(x_m - bundle.plane.before_m, 4 - 0.05f);
    EXPECT_LT(x_m + bundle.plane.behind_m, 4.5f + 0.05f);
  }
}

TEST(TangentPlanes, DoNotDependOnTheOrderOfPoints) {
  PanopticFrame frame = ScanOfRoad();
  std::map<VoxelIndex, TangentPlane> planes;
  const auto visit = [](const std::vector<SegmentBundles>& segments, const auto& see) {
    for (const BundleCell& cell : segments[0].cells) {
      for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
        see(VoxelIn(cell.block, segments[0].bundles[b].linear), segments[0].bundles[b].plane);
      }
    }
  };
  visit(BundlesOf(frame, 0.2), [&](VoxelIndex v, const TangentPlane& plane) { planes[v] = plane; });
  std::shuffle(frame.lidar->points_m.begin(), frame.lidar->points_m.end(), std::mt19937(7));
  std::size_t num_seen = 0;
  visit(BundlesOf(frame, 0.2), [&](VoxelIndex v, const TangentPlane& plane) {
    const TangentPlane& expected = planes.at(v);
    EXPECT_LT((plane.normal - expected.normal).norm(), 1e-4f);
    EXPECT_NEAR(plane.offset_m, expected.offset_m, 1e-4f);
    EXPECT_NEAR(plane.before_m, expected.before_m, 1e-2f);
    ++num_seen;
  });
  EXPECT_EQ(num_seen, planes.size());
}

TEST(TangentPlanes, HaveTheSameBitsForAnyNumberOfThreads) {
  PanopticFrame frame = See(Box(), {0.2, -0.9, 1.9}, {2, 0, 1});
  const int width = frame.camera->camera.width_px;
  for (std::size_t i = 0; i < frame.camera->segments.size(); ++i) {
    frame.camera->segments[i] = 1 + static_cast<std::uint32_t>(static_cast<int>(i) % width / 20);
  }
  frame.segments.clear();
  for (std::uint32_t id = 1; id <= 8; ++id) frame.segments.push_back({.id = SegmentId(id), .class_id = kSeenClass});
  const std::vector<SegmentBundles> one = BundlesOf(frame, kSide_m, 1);
  ASSERT_GT(one.size(), 3u);
  for (const int num_threads : {2, 4}) {
    const std::vector<SegmentBundles> several = BundlesOf(frame, kSide_m, num_threads);
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t s = 0; s < one.size(); ++s) {
      ASSERT_EQ(several[s].bundles.size(), one[s].bundles.size());
      for (std::size_t b = 0; b < one[s].bundles.size(); ++b) {
        const TangentPlane &a = one[s].bundles[b].plane, &c = several[s].bundles[b].plane;
        EXPECT_TRUE(a.normal == c.normal && a.offset_m == c.offset_m);
      }
    }
  }
}

}  // namespace
}  // namespace dhpmap
