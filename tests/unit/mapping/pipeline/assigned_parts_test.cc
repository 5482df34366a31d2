// SPDX-License-Identifier: BSD-3-Clause
// What an object that somebody has moved takes of a segment that is two objects.
#include "mapping/pipeline/assigned_parts.h"

#include <gtest/gtest.h>

#include "mapping/fusion/bundler.h"
#include "mapping/fusion/segment_parts.h"
#include "mapping/pipeline/frame_fusion.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::Scene;
using testing::Solid;

constexpr std::uint32_t kBothBalls = 7, kOtherBall = 8;
const Eigen::Vector3d kLeft_m(1.5, 0.5, 1), kRight_m(1.5, -0.5, 1);

/// Two balls apart, which one segment shows, or two.
PanopticFrame TwoBalls(std::uint32_t id_of_right = kBothBalls) {
  const Scene scene{
      {{.shape = Solid::Shape::kSphere, .center_m = kLeft_m, .size_m = {0.3, 0, 0}, .segment = kBothBalls},
       {.shape = Solid::Shape::kSphere, .center_m = kRight_m, .size_m = {0.25, 0, 0}, .segment = id_of_right}}};
  PanopticFrame frame = Render(scene, testing::SmallCamera(), testing::LookAt({0, 0, 1}, {1.5, 0, 1}));
  frame.segments = {{.id = SegmentId(kBothBalls), .class_id = ClassId(1)},
                    {.id = SegmentId(kOtherBall), .class_id = ClassId(1)}};
  return frame;
}

/// The same as points of a scan.
PanopticFrame TwoScannedBalls() {
  const PanopticFrame image = TwoBalls();
  const DepthCameraData& data = *image.camera;
  PanopticFrame frame;
  frame.T_map_sensor = image.T_map_sensor;
  frame.segments = image.segments;
  LidarData& scan = frame.lidar.emplace();
  for (std::size_t i = 0; i < data.depth_m.size(); ++i) {
    if (!(data.depth_m[i] > 0)) continue;
    const auto width = static_cast<std::size_t>(data.camera.width_px);
    const auto u = static_cast<double>(i % width), v = static_cast<double>(i / width);
    const Eigen::Vector3d ray((u - data.camera.cx_px) / data.camera.fx_px, (v - data.camera.cy_px) / data.camera.fy_px,
                              1);
    scan.points_m.push_back((static_cast<double>(data.depth_m[i]) * ray).cast<float>());
    scan.segments.push_back(data.segments[i]);
  }
  return frame;
}

/// A map with an object that somebody has moved by no multiple of a voxel, and one that nobody has.
class AssignedParts : public ::testing::Test {
 protected:
  AssignedParts() : map_(Info()) {
    SubmapInfo info = testing::InfoOn(map_, Panoptic::kThing, ClassId(1));
    still_ = map_.Create(info).id();
    info.T_map_submap.translation() = Eigen::Vector3d(0.013, -0.537, 0.1);
    info.T_map_submap.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    moved_ = map_.Create(info).id();
  }

  static MapInfo Info() {
    MapInfo info = testing::NamedMap("m", 1, 1);
    info.config = IndoorConfig();
    return info;
  }

  std::vector<SegmentBundles> Parts(const PanopticFrame& frame) {
    const MapConfig& config = map_.info().config;
    Bundler bundler(config.integration, pool_);
    std::vector<SegmentBundles> segments = bundler.BundleFrame(frame, frame.T_map_sensor, config.voxel_size_m);
    SplitIntoParts({true, true}, 3, segments);
    return segments;
  }

  void Fuse(const PanopticFrame& frame, const std::vector<SubmapId>& to) {
    const std::vector<SegmentBundles> segments = Parts(frame);
    std::vector<Assignment> assignments;
    for (const SubmapId id : to) assignments.push_back({.submap = id});
    ASSERT_EQ(segments.size(), assignments.size());
    FrameJournal journal;
    FuseFrame(frame, segments, assignments, map_, pool_, journal);
  }

  /// Observed voxels around the left ball and around the right one.
  std::pair<int, int> CountVoxels(SubmapId id) const {
    const Submap& submap = *map_.Find(id);
    std::pair<int, int> counts;
    for (const BlockEntry& entry : submap.blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i)) continue;
        const Eigen::Vector3d p_m =
            submap.info().T_map_submap * VoxelCentre(VoxelIn(entry.index, i), submap.info().voxel_size_m);
        ++(p_m.y() > 0 ? counts.first : counts.second);
      }
    }
    return counts;
  }

  ThreadPool pool_{1};
  Map map_;
  SubmapId still_, moved_;
};

TEST_F(AssignedParts, AMovedObjectTakesOnlyThePartThatIsItsOwn) {
  for (const PanopticFrame& frame : {TwoBalls(), TwoScannedBalls()}) {
    Fuse(frame, {moved_, still_});  // the left ball has more points
    EXPECT_GT(CountVoxels(moved_).first, 300);
    EXPECT_EQ(CountVoxels(moved_).second, 0);
    EXPECT_EQ(CountVoxels(still_).first, 0);
    EXPECT_GT(CountVoxels(still_).second, 200);
  }
}

TEST_F(AssignedParts, ItTakesTheSameAsOfASegmentOfItsOwn) {
  Map other(map_.Freeze());
  Fuse(TwoBalls(), {moved_, still_});
  std::swap(map_, other);
  Fuse(TwoBalls(kOtherBall), {moved_, still_});
  EXPECT_TRUE(testing::MapsAreEqual(*map_.Freeze(), *other.Freeze()));
}

TEST_F(AssignedParts, ItTakesTheWholeSegmentWhereAllPartsAreItsOwn) {
  const PanopticFrame frame = TwoBalls();
  EXPECT_FALSE(WithoutPartsOfOthers(frame, Parts(frame), std::vector<std::size_t>{0, 1}, 0.04));
  Fuse(frame, {moved_, moved_});
  EXPECT_GT(CountVoxels(moved_).first, 300);
  EXPECT_GT(CountVoxels(moved_).second, 200);
}

TEST_F(AssignedParts, OtherSegmentsAreLeftAlone) {
  const PanopticFrame frame = TwoBalls(kOtherBall);
  EXPECT_FALSE(WithoutPartsOfOthers(frame, Parts(frame), std::vector<std::size_t>{0}, 0.04));
}

TEST_F(AssignedParts, WhatGoesToNobodyIsNotTakenEither) {
  Fuse(TwoBalls(), {kUnknownSubmap, moved_});
  EXPECT_EQ(CountVoxels(moved_).first, 0);
  EXPECT_GT(CountVoxels(moved_).second, 200);
  EXPECT_GT(CountVoxels(kUnknownSubmap).first, 300);
}

}  // namespace
}  // namespace dhpmap
