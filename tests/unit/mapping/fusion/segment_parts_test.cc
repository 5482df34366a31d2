// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/segment_parts.h"

#include <gtest/gtest.h>

#include <map>

#include "mapping/fusion/bundler.h"

namespace dhpmap {
namespace {

constexpr double kPartVoxel_m = 0.1;

/// Clusters of points, three voxels long each, that begin at these places; one segment, one point a voxel.
std::vector<SegmentBundles> Bundles(const std::vector<Eigen::Vector3f>& places_m, Bundler& bundler) {
  PanopticFrame frame;
  frame.lidar.emplace();
  for (const Eigen::Vector3f& place : places_m) {
    for (int i = 0; i < 3; ++i) {
      frame.lidar->points_m.push_back(place + Eigen::Vector3f(0.05f + 0.1f * static_cast<float>(i), 0.05f, 0.05f));
      frame.lidar->segments.push_back(7);
    }
  }
  frame.segments = {{.id = SegmentId(7), .class_id = ClassId(1)}};
  return bundler.BundleFrame(frame, Transform::Identity(), kPartVoxel_m);
}

class SegmentParts : public ::testing::Test {
 protected:
  ThreadPool pool_{1};
  IntegrationConfig config_{.max_range_m = 100.0, .weighting = Weighting::kConstant};
  Bundler bundler_{config_, pool_};
};

TEST_F(SegmentParts, StayTogetherWhereTheyTouch) {
  auto segments = Bundles({{2, 0, 0}, {2.3f, 0, 0}, {2.6f, 0.1f, 0}}, bundler_);
  SplitIntoParts({true}, 3, segments);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].num_points, 9);
}

TEST_F(SegmentParts, AreCutWhereTheyLieApart) {
  auto segments = Bundles({{2, 0, 0}, {5, 0, 0}, {5.3f, 0, 0}, {-4, -7, 1}}, bundler_);
  SplitIntoParts({true}, 3, segments);
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[0].num_points, 6) << "the largest comes first";
  for (const SegmentBundles& part : segments) EXPECT_EQ(part.row, 0);
}

TEST_F(SegmentParts, OfBackgroundStayTogether) {
  auto segments = Bundles({{2, 0, 0}, {5, 0, 0}}, bundler_);
  SplitIntoParts({false}, 3, segments);
  EXPECT_EQ(segments.size(), 1u);
}

TEST_F(SegmentParts, HoldEveryBundleOnceAndFindItByItsVoxel) {
  const auto whole = Bundles({{2, 0, 0}, {5, 0, 0}, {-4, -7, 1}, {2, 3, 0}}, bundler_);
  auto parts = whole;
  SplitIntoParts({true}, 2, parts);
  ASSERT_EQ(parts.size(), 4u);
  std::map<VoxelIndex, int> seen;
  std::int64_t num_points = 0;
  for (const SegmentBundles& part : parts) {
    num_points += part.num_points;
    for (const BundleCell& cell : part.cells) {
      for (std::uint32_t b = 0; b < cell.num_bundles; ++b) {
        const Bundle& bundle = part.bundles[cell.first_bundle + b];
        const VoxelIndex voxel = VoxelIn(cell.block, bundle.linear);
        ++seen[voxel];
        EXPECT_TRUE(part.EndsIn(voxel));
        EXPECT_EQ(cell.BundleAt(bundle.linear), cell.first_bundle + b);
      }
    }
  }
  EXPECT_EQ(num_points, whole[0].num_points);
  EXPECT_EQ(seen.size(), whole[0].bundles.size());
  for (const auto& [voxel, count] : seen) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace dhpmap
