// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/bundler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <utility>

namespace dhpmap {
namespace {

constexpr double kBundleVoxel_m = 0.125;

/// Segments 4 and 9 are in the table, 9 first; 5 is not, and 0 is nothing.
std::vector<SegmentInfo> Table() {
  return {{.id = SegmentId(9), .class_id = ClassId(1)}, {.id = SegmentId(4), .class_id = ClassId(2)}};
}
int RowOf(std::uint32_t id) { return id == 9 ? 0 : id == 4 ? 1 : -1; }

Transform SomePose() {
  Transform T = Transform::Identity();
  T.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(3.21, -0.07, 1.4);
  return T;
}

/// The point as the grid sees it lies so near a voxel's border that rounding decides.
bool IsNearABorder(const Eigen::Vector3d& p_grid) {
  for (int axis = 0; axis < 3; ++axis) {
    const double v = p_grid[axis] / kBundleVoxel_m;
    if (std::abs(v - std::round(v)) < 1e-3) return true;
  }
  return false;
}

/// A frame with noise for content, but for points whose voxel rounding would decide: these are invalid.
PanopticFrame NoisyCameraFrame(int width_px, int height_px, const Transform& T_grid_sensor) {
  PanopticFrame frame;
  frame.segments = Table();
  frame.unlisted_ids_are_unknown = true;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = {.width_px = width_px, .height_px = height_px, .fx_px = 40, .fy_px = 42, .cx_px = 20.5, .cy_px = 15.25};
  std::mt19937 random(7);
  std::uint32_t segment = 0;
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      float depth_m = 0.5f + static_cast<float>(random() % 3000) / 1000.0f;
      const Eigen::Vector3d ray((u - 20.5) / 40, (v - 15.25) / 42, 1);
      if (IsNearABorder(T_grid_sensor * (ray * static_cast<double>(depth_m)))) depth_m = 0;
      if (random() % 3 == 0) segment = std::vector<std::uint32_t>{0, 4, 5, 9}[random() % 4];
      data.depth_m.push_back(depth_m);
      data.segments.push_back(segment);
      data.color.push_back({static_cast<std::uint8_t>(random() % 256), static_cast<std::uint8_t>(random() % 256), 9});
    }
  }
  return frame;
}

PanopticFrame NoisyLidarFrame(int num_points, const Transform& T_grid_sensor) {
  PanopticFrame frame;
  frame.segments = Table();
  frame.unlisted_ids_are_unknown = true;
  LidarData& data = frame.lidar.emplace();
  std::mt19937 random(11);
  const auto coordinate = [&random] { return static_cast<float>(static_cast<int>(random() % 8000) - 4000) / 1000.0f; };
  while (static_cast<int>(data.points_m.size()) < num_points) {
    const Eigen::Vector3f p(coordinate(), coordinate(), coordinate());
    if (IsNearABorder(T_grid_sensor * p.cast<double>())) continue;
    data.points_m.push_back(p);
    data.segments.push_back(std::vector<std::uint32_t>{0, 4, 5, 9}[random() % 4]);
    data.color.push_back({static_cast<std::uint8_t>(random() % 256), 7, static_cast<std::uint8_t>(random() % 256)});
  }
  return frame;
}

struct BundleSum {
  std::uint32_t num_points = 0;
  double weight = 0;
  Eigen::Vector3d weighted_sum_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d weighted_color = Eigen::Vector3d::Zero();
};
using Sums = std::map<std::pair<int, VoxelIndex>, BundleSum>;  // by row and voxel

/// Point by point, in double precision.
Sums SlowSums(const PanopticFrame& frame, const Transform& T_grid_sensor, const IntegrationConfig& config) {
  Sums sums;
  const auto add = [&](const Eigen::Vector3d& p_sensor, std::uint32_t segment, const Color& color) {
    const double range_m = p_sensor.norm();
    if (range_m < config.min_range_m || range_m > config.max_range_m) return;
    const double divisor = config.weighting == Weighting::kConstant                              ? 1.0
                           : frame.camera && config.weighting == Weighting::kInverseDepthSquared ? p_sensor.z()
                                                                                                 : range_m;
    const double weight = 1.0 / (divisor * divisor);
    BundleSum& sum = sums[{RowOf(segment), VoxelAt(T_grid_sensor * p_sensor, kBundleVoxel_m)}];
    ++sum.num_points;
    sum.weight += weight;
    sum.weighted_sum_m += weight * (T_grid_sensor.linear() * p_sensor);
    sum.weighted_color += weight * Eigen::Vector3d(color.r, color.g, color.b);
  };
  if (frame.camera) {
    const PinholeCamera& camera = frame.camera->camera;
    for (std::size_t i = 0; i < frame.camera->depth_m.size(); ++i) {
      const double depth_m = static_cast<double>(frame.camera->depth_m[i]);
      if (!(depth_m > 0)) continue;
      const auto u = static_cast<double>(i % static_cast<std::size_t>(camera.width_px));
      const auto v = static_cast<double>(i / static_cast<std::size_t>(camera.width_px));
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
      add(depth_m * ray, frame.camera->segments[i], frame.camera->color[i]);
    }
  } else {
    for (std::size_t i = 0; i < frame.lidar->points_m.size(); ++i) {
      add(frame.lidar->points_m[i].cast<double>(), frame.lidar->segments[i], frame.lidar->color[i]);
    }
  }
  return sums;
}

/// The same from bundles; fails where two bundles of a segment end in one voxel.
Sums SumsOf(const std::vector<SegmentBundles>& segments) {
  Sums sums;
  for (const SegmentBundles& segment : segments) {
    std::int64_t num_points = 0;
    for (const BundleCell& cell : segment.cells) {
      for (std::uint32_t i = 0; i < cell.num_bundles; ++i) {
        const Bundle& bundle = segment.bundles[cell.first_bundle + i];
        const VoxelIndex voxel = VoxelIn(cell.block, bundle.linear);
        EXPECT_TRUE(segment.EndsIn(voxel));
        num_points += bundle.num_points;
        const BundleSum sum{bundle.num_points, static_cast<double>(bundle.weight), bundle.weighted_sum_m.cast<double>(),
                            bundle.weighted_color.cast<double>()};
        EXPECT_TRUE(sums.emplace(std::pair(segment.row, voxel), sum).second);
      }
    }
    EXPECT_EQ(num_points, segment.num_points);
  }
  return sums;
}

void ExpectSame(const Sums& expected, const Sums& actual) {
  ASSERT_EQ(expected.size(), actual.size());
  for (auto e = expected.begin(), a = actual.begin(); e != expected.end(); ++e, ++a) {
    ASSERT_EQ(e->first, a->first);
    ASSERT_EQ(e->second.num_points, a->second.num_points);
    ASSERT_NEAR(e->second.weight, a->second.weight, 1e-5 * e->second.weight);
    ASSERT_LT((e->second.weighted_sum_m - a->second.weighted_sum_m).norm(), 1e-4 * e->second.weight);
    ASSERT_LT((e->second.weighted_color - a->second.weighted_color).norm(), 1e-2 * e->second.weight);
  }
}

class Bundling : public ::testing::TestWithParam<Weighting> {
 protected:
  const IntegrationConfig config_{.min_range_m = 0.9, .max_range_m = 3.0, .weighting = GetParam()};
  ThreadPool pool_{2};
  Bundler bundler_{config_, pool_};
};

TEST_P(Bundling, SumsPixelsBySegmentAndVoxelAsTheSlowWayDoes) {
  const PanopticFrame frame = NoisyCameraFrame(83, 61, SomePose());
  const Sums slow = SlowSums(frame, SomePose(), config_);
  ASSERT_GT(slow.size(), 1000u);
  ExpectSame(slow, SumsOf(bundler_.BundleFrame(frame, SomePose(), kBundleVoxel_m)));
}

TEST_P(Bundling, SumsPointsBySegmentAndVoxelAsTheSlowWayDoes) {
  const PanopticFrame frame = NoisyLidarFrame(9000, SomePose());  // more than two bands
  const Sums slow = SlowSums(frame, SomePose(), config_);
  ASSERT_GT(slow.size(), 1000u);
  ExpectSame(slow, SumsOf(bundler_.BundleFrame(frame, SomePose(), kBundleVoxel_m)));
}

INSTANTIATE_TEST_SUITE_P(ByWeighting, Bundling,
                         ::testing::Values(Weighting::kConstant, Weighting::kInverseDepthSquared,
                                           Weighting::kInverseRangeSquared));

class BundlerTest : public ::testing::Test {
 protected:
  const IntegrationConfig config_{.min_range_m = 0.5, .max_range_m = 10.0, .weighting = Weighting::kConstant};
  ThreadPool pool_{1};
  Bundler bundler_{config_, pool_};
};

bool HasSameBits(const Bundle& a, const Bundle& b) {
  return a.linear == b.linear && a.num_points == b.num_points && std::memcmp(&a.weight, &b.weight, 4) == 0 &&
         std::memcmp(a.weighted_sum_m.data(), b.weighted_sum_m.data(), 12) == 0 &&
         std::memcmp(a.weighted_color.data(), b.weighted_color.data(), 12) == 0;
}

TEST_F(BundlerTest, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const PanopticFrame& frame : {NoisyCameraFrame(83, 61, SomePose()), NoisyLidarFrame(9000, SomePose())}) {
    const std::vector<SegmentBundles>& one = bundler_.BundleFrame(frame, SomePose(), kBundleVoxel_m);
    ThreadPool many(5);
    Bundler other(config_, many);
    const std::vector<SegmentBundles>& five = other.BundleFrame(frame, SomePose(), kBundleVoxel_m);
    ASSERT_EQ(one.size(), five.size());
    for (std::size_t s = 0; s < one.size(); ++s) {
      ASSERT_EQ(one[s].bundles.size(), five[s].bundles.size());
      for (std::size_t i = 0; i < one[s].bundles.size(); ++i) {
        ASSERT_TRUE(HasSameBits(one[s].bundles[i], five[s].bundles[i])) << i;
      }
    }
  }
}

TEST_F(BundlerTest, PutsPointsOfNoKnownObjectFirstAndThenFollowsTheTable) {
  PanopticFrame frame;
  frame.segments = Table();
  frame.segments.push_back({.id = SegmentId(3), .class_id = ClassId(1)});  // without a point
  frame.lidar.emplace();
  frame.lidar->points_m = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  frame.lidar->segments = {4, 9, 5, 0};
  const auto& segments = bundler_.BundleFrame(frame, Transform::Identity(), kBundleVoxel_m);
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[0].row, -1);
  EXPECT_EQ(segments[0].num_points, 2) << "0, and 5, which has no row";
  EXPECT_EQ(segments[1].row, 0);
  EXPECT_EQ(segments[2].row, 1);
}

TEST_F(BundlerTest, TakesAFrameWithoutLabelsAndColoursAsUnknownAndGrey) {
  PanopticFrame lidar;
  lidar.lidar.emplace().points_m = {{1.01f, 0.01f, 0.01f}, {1.02f, 0.01f, 0.01f}};
  PanopticFrame camera;
  camera.camera = {.camera = {.width_px = 2, .height_px = 1, .fx_px = 1000, .fy_px = 1000, .cx_px = -1, .cy_px = -1},
                   .depth_m = {1.01f, 1.01f}};
  for (const PanopticFrame& frame : {lidar, camera}) {
    const auto& segments = bundler_.BundleFrame(frame, Transform::Identity(), kBundleVoxel_m);
    ASSERT_EQ(segments.size(), 1u);
    EXPECT_EQ(segments[0].row, -1);
    ASSERT_EQ(segments[0].bundles.size(), 1u);
    EXPECT_EQ(segments[0].bundles[0].num_points, 2u);
    EXPECT_EQ(segments[0].bundles[0].weighted_color, Eigen::Vector3f(256, 256, 256));
  }
}

TEST_F(BundlerTest, LeavesOutWhatIsNoReturnOrOutOfRange) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  PanopticFrame frame;
  frame.camera = {.camera = {.width_px = 8, .height_px = 1, .fx_px = 1e4, .fy_px = 1e4, .cx_px = 3.5, .cy_px = 0},
                  .depth_m = {0, -1, kNan, kInf, -kInf, 0.49f, 10.01f, 1e-38f}};
  EXPECT_TRUE(bundler_.BundleFrame(frame, SomePose(), kBundleVoxel_m).empty());
  frame.camera->depth_m = {0, -1, 0.51f, kInf, -kInf, 0.49f, 9.99f, 1e38f};
  const auto& segments = bundler_.BundleFrame(frame, SomePose(), kBundleVoxel_m);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].num_points, 2);
}

TEST_F(BundlerTest, PointsOnAllSidesOfTheSensorStillEndSomewhere) {
  PanopticFrame frame;
  frame.lidar.emplace().points_m = {{0.2f, 0, 0}, {-0.2f, 0, 0}, {0, 0.2f, 0}, {0, -0.2f, 0}};
  Transform pose = Transform::Identity();
  pose.translation() = Eigen::Vector3d(0.25, 0.25, 0.25);
  Bundler near({.min_range_m = 0.1, .max_range_m = 10.0}, pool_);
  const auto& segments = near.BundleFrame(frame, pose, 0.5);
  ASSERT_EQ(segments.size(), 1u);
  ASSERT_EQ(segments[0].bundles.size(), 1u);
  const Bundle& bundle = segments[0].bundles[0];
  EXPECT_EQ(bundle.num_points, 4u);
  const float range_m = (bundle.weighted_sum_m / bundle.weight).norm();
  EXPECT_GT(range_m, 0.0f);
  EXPECT_LT(range_m, 0.01f);
  EXPECT_TRUE(bundle.plane.normal.allFinite());
}

TEST_F(BundlerTest, CountsTheBuffersThatItKeeps) {
  const auto counted = [] { return CountOf(MemoryKind::kFusion).now_bytes(); };
  ASSERT_EQ(counted(), 0u);
  {
    ThreadPool pool(1);
    Bundler bundler(IntegrationConfig(), pool);
    const PanopticFrame frame = NoisyCameraFrame(40, 30, SomePose());
    std::size_t least = 0;
    for (const SegmentBundles& segment : bundler.BundleFrame(frame, SomePose(), kBundleVoxel_m)) {
      least += segment.cells.size() * sizeof(BundleCell) + segment.bundles.size() * sizeof(Bundle);
    }
    EXPECT_GT(least, 0u);
    EXPECT_GE(counted(), least);
    const std::size_t after_one = counted();
    (void)bundler.BundleFrame(frame, SomePose(), kBundleVoxel_m);
    EXPECT_EQ(counted(), after_one) << "they are used again";
    bundler.GiveBuffersBack();
    EXPECT_EQ(counted(), 0u);
    (void)bundler.BundleFrame(frame, SomePose(), kBundleVoxel_m);
    EXPECT_GE(counted(), least);
  }
  EXPECT_EQ(counted(), 0u);
}

TEST_F(BundlerTest, KeepsNothingOfTheFrameBefore) {
  (void)bundler_.BundleFrame(NoisyLidarFrame(9000, SomePose()), SomePose(), kBundleVoxel_m);
  const PanopticFrame small = NoisyCameraFrame(20, 17, SomePose());
  ExpectSame(SlowSums(small, SomePose(), config_), SumsOf(bundler_.BundleFrame(small, SomePose(), kBundleVoxel_m)));
  PanopticFrame nothing;
  nothing.lidar.emplace();
  EXPECT_TRUE(bundler_.BundleFrame(nothing, SomePose(), kBundleVoxel_m).empty());
}

TEST_F(BundlerTest, IsAsExactFarFromTheOriginAsNearIt) {
  constexpr int kShift_vox = 4'000'000;  // 500 km, a whole number of blocks
  Transform near = Transform::Identity();
  near.translation() = Eigen::Vector3d(0.5, 0.25, 1.75);  // exact in both places
  Transform far = near;
  far.translation().x() += kShift_vox * kBundleVoxel_m;
  for (const PanopticFrame& frame : {NoisyCameraFrame(40, 30, near), NoisyLidarFrame(500, near)}) {
    Sums expected;
    for (const auto& [key, sum] : SumsOf(bundler_.BundleFrame(frame, near, kBundleVoxel_m))) {
      expected[{key.first, {key.second.x + kShift_vox, key.second.y, key.second.z}}] = sum;
    }
    const Sums there = SumsOf(bundler_.BundleFrame(frame, far, kBundleVoxel_m));
    ASSERT_EQ(there.size(), expected.size());
    for (const auto& [key, sum] : expected) {
      const auto found = there.find(key);
      ASSERT_NE(found, there.end());
      ASSERT_EQ(found->second.weighted_sum_m, sum.weighted_sum_m);
    }
  }
}

}  // namespace
}  // namespace dhpmap
