// SPDX-License-Identifier: BSD-3-Clause
// What a frame may take while it is bundled and cut into parts, before anything is fused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "mapping/fusion/band_size.h"
#include "mapping/fusion/bundler.h"
#include "mapping/fusion/integrator.h"
#include "mapping/fusion/segment_parts.h"
#include "mapping/map/map.h"

namespace dhpmap {
namespace {

constexpr double kLimitVoxel_m = 0.125;  // exact, and so is a block of 1 m
constexpr double kLimitBlock_m = kLimitVoxel_m * kBlockSide;
constexpr double kTwoVoxels_m = 2 * kLimitVoxel_m;

IntegrationConfig LimitConfig() {
  return {.min_range_m = 0.01, .max_range_m = 1000.0, .weighting = Weighting::kConstant};
}

/// A scan of points in the middles of voxels that lie `spacing_m` apart, in a cuboid of 64 x 64 columns, given to the
/// objects of the table in turn.
PanopticFrame LatticeScan(std::size_t num_points, double spacing_m, std::uint32_t num_objects) {
  PanopticFrame frame;
  frame.segments.reserve(num_objects);
  for (std::uint32_t i = 1; i <= num_objects; ++i) {
    frame.segments.push_back({.id = SegmentId(i), .class_id = ClassId(1)});
  }
  LidarData& data = frame.lidar.emplace();
  data.points_m.reserve(num_points);
  data.segments.reserve(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    const Eigen::Vector3d place(static_cast<double>(i % 64), static_cast<double>(i / 64 % 64),
                                static_cast<double>(i / 4096));
    const Eigen::Vector3d point_m = place * spacing_m + Eigen::Vector3d::Constant(kLimitVoxel_m / 2);
    data.points_m.push_back(point_m.cast<float>());
    data.segments.push_back(1 + static_cast<std::uint32_t>(i % num_objects));
  }
  return frame;
}

std::size_t NumCells(const std::vector<SegmentBundles>& segments) {
  std::size_t num_cells = 0;
  for (const SegmentBundles& segment : segments) num_cells += segment.cells.size();
  return num_cells;
}

bool AnyIsCutShort(const std::vector<SegmentBundles>& segments) {
  return std::any_of(segments.begin(), segments.end(), [](const SegmentBundles& s) { return s.is_cut_short; });
}

/// Nothing but rows, each marked, which no limit lets pass.
void ExpectAllCutShort(const std::vector<SegmentBundles>& segments, std::size_t num_rows) {
  ASSERT_EQ(segments.size(), num_rows + 1);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    EXPECT_EQ(segments[i].row, static_cast<int>(i) - 1);
    EXPECT_TRUE(segments[i].is_cut_short);
    EXPECT_EQ(segments[i].cells.capacity(), 0u);
    EXPECT_EQ(segments[i].bundles.capacity(), 0u);
  }
  const RayOrigin origin(Eigen::Vector3d::Zero(), kLimitVoxel_m);
  EXPECT_GT(CountBandBlocks(segments, origin, kLimitVoxel_m, kLimitVoxel_m, kMaxBlocksAFrame), kMaxBlocksAFrame);
}

void ExpectSameBits(const std::vector<SegmentBundles>& a, const std::vector<SegmentBundles>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t s = 0; s < a.size(); ++s) {
    EXPECT_FALSE(a[s].is_cut_short);
    EXPECT_EQ(a[s].row, b[s].row);
    EXPECT_EQ(a[s].num_points, b[s].num_points);
    ASSERT_EQ(a[s].cells.size(), b[s].cells.size());
    ASSERT_EQ(a[s].bundles.size(), b[s].bundles.size());
    for (std::size_t c = 0; c < a[s].cells.size(); ++c) ASSERT_EQ(a[s].cells[c].block, b[s].cells[c].block);
    for (std::size_t i = 0; i < a[s].bundles.size(); ++i) {
      const Bundle &of_a = a[s].bundles[i], &of_b = b[s].bundles[i];
      ASSERT_EQ(of_a.linear, of_b.linear);
      ASSERT_EQ(std::memcmp(of_a.weighted_sum_m.data(), of_b.weighted_sum_m.data(), 3 * sizeof(float)), 0);
      ASSERT_EQ(std::memcmp(of_a.plane.normal.data(), of_b.plane.normal.data(), 3 * sizeof(float)), 0);
    }
  }
}

class FrameLimits : public ::testing::TestWithParam<int> {
 protected:
  ThreadPool pool_{GetParam()};
  Bundler bundler_{LimitConfig(), pool_};

  std::vector<SegmentBundles>& BundleScan(const PanopticFrame& frame) {
    return bundler_.BundleFrame(frame, Transform::Identity(), kLimitVoxel_m);
  }
};

TEST_P(FrameLimits, LetAFrameHaveAsManyCellsAsBlocksAndNoneMore) {
  const auto& most = BundleScan(LatticeScan(kMaxBlocksAFrame, kLimitBlock_m, 2));
  EXPECT_FALSE(AnyIsCutShort(most));
  EXPECT_EQ(NumCells(most), kMaxBlocksAFrame);
  ExpectAllCutShort(BundleScan(LatticeScan(kMaxBlocksAFrame + 1, kLimitBlock_m, 2)), 2);
}

TEST_P(FrameLimits, StopAFrameWhosePointsAllEndInBlocksOfTheirOwn) {
  ExpectAllCutShort(BundleScan(LatticeScan(3 * kMaxBlocksAFrame, kLimitBlock_m, 1)), 1);
}

TEST_P(FrameLimits, LetPassWhatHasManyRunsInFewBlocks) {
  // Every point a run, and blocks enough for the early count to begin, though not for it to stop the frame.
  const std::size_t num_points = 3 * kMaxBlocksAFrame;
  const auto& segments = BundleScan(LatticeScan(num_points, kTwoVoxels_m, 3));
  EXPECT_FALSE(AnyIsCutShort(segments));
  std::size_t num_bundles = 0;
  for (const SegmentBundles& segment : segments) num_bundles += segment.bundles.size();
  EXPECT_EQ(num_bundles, num_points);
  EXPECT_EQ(NumCells(segments), 3 * num_points / 64) << "64 points a block, of three objects";
}

TEST_P(FrameLimits, LeaveNothingOfAFrameThatIsCutShortInTheNext) {
  const PanopticFrame small = LatticeScan(5000, kTwoVoxels_m, 3);
  Bundler fresh(LimitConfig(), pool_);
  const auto& expected = fresh.BundleFrame(small, Transform::Identity(), kLimitVoxel_m);
  for (const std::size_t num_points : {kMaxBlocksAFrame + 1, 3 * kMaxBlocksAFrame}) {
    ASSERT_TRUE(AnyIsCutShort(BundleScan(LatticeScan(num_points, kLimitBlock_m, 2))));
    ExpectSameBits(BundleScan(small), expected);
  }
}

TEST_P(FrameLimits, KeepTheBuffersOfAFrameThatIsTaken) {
  const PanopticFrame small = LatticeScan(5000, kTwoVoxels_m, 1);
  const BundleCell* cells = BundleScan(small).front().cells.data();
  const auto& again = BundleScan(small);
  EXPECT_EQ(again.front().cells.data(), cells);
}

INSTANTIATE_TEST_SUITE_P(ByThreads, FrameLimits, ::testing::Values(1, 4));

TEST(FrameLimitsOfParts, LetAThingHaveAsManyPartsAsBlocksAndNoneMore) {
  ThreadPool pool(1);
  Bundler bundler(LimitConfig(), pool);
  for (const std::size_t num_points : {kMaxBlocksAFrame, kMaxBlocksAFrame + 1}) {
    const PanopticFrame scan = LatticeScan(num_points, kTwoVoxels_m, 1);
    auto& segments = bundler.BundleFrame(scan, Transform::Identity(), kLimitVoxel_m);
    ASSERT_EQ(segments.size(), 1u);
    ASSERT_LT(segments[0].cells.size(), kMaxBlocksAFrame / 32);
    SplitIntoParts({true}, 1, segments);
    if (num_points == kMaxBlocksAFrame) {
      EXPECT_FALSE(AnyIsCutShort(segments));
      EXPECT_EQ(segments.size(), num_points) << "every second voxel is a part";
    } else {
      ExpectAllCutShort(segments, 1);
    }
  }
}

TEST(FrameLimitsOfParts, LeaveWhatIsCutShortAsItIs) {
  std::vector<SegmentBundles> segments = CutShortSegments(3);
  SplitIntoParts({true, false, true}, 2, segments);
  ExpectAllCutShort(segments, 3);
}

TEST(FrameLimitsOfParts, NothingThatIsCutShortIsFusedAsIfItWereWhole) {
  MapInfo info;
  Map map(info);
  const std::vector<SegmentBundles> segments = CutShortSegments(1);
  const RayOrigin origin(Eigen::Vector3d::Zero(), kLimitVoxel_m);
  EXPECT_THROW(IntegrateSegment(segments[1], origin, ClassId(1), LimitConfig(), *map.FindMutable(kUnknownSubmap)),
               std::bad_alloc);
}

}  // namespace
}  // namespace dhpmap
