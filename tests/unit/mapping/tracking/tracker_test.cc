// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "mapping/fusion/bundler.h"
#include "mapping/fusion/integrator.h"
#include "mapping/fusion/segment_parts.h"
#include "mapping/tracking/activity.h"
#include "mapping/tracking/visibility.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::LookAt;
using testing::Render;
using testing::Scene;
using testing::SmallCamera;
using testing::Solid;

constexpr ClassId kBox{1}, kChair{2}, kWall{3};

/// Two boxes side by side, 20 cm apart, before a wall; segments 1, 2 and 3.
Scene TwoBoxes() {
  return {{{.shape = Solid::Shape::kBox, .center_m = {2, -0.4, 1}, .size_m = {0.3, 0.3, 0.3}, .segment = 1},
           {.shape = Solid::Shape::kBox, .center_m = {2, 0.4, 1}, .size_m = {0.3, 0.3, 0.3}, .segment = 2},
           {.shape = Solid::Shape::kHalfSpace, .center_m = {3, 0, 0}, .size_m = {-1, 0, 0}, .segment = 3}}};
}

PanopticFrame FrameOf(const Scene& scene) {
  PanopticFrame frame = Render(scene, SmallCamera(), LookAt({0, 0.01, 1.02}, {2, 0.01, 1.02}));
  frame.segments = {{.id = SegmentId(1), .class_id = kBox},
                    {.id = SegmentId(2), .class_id = kBox},
                    {.id = SegmentId(3), .class_id = kWall}};
  return frame;
}

class TrackerTest : public ::testing::Test {
 protected:
  TrackerTest() : map_(Info()) {}

  static MapInfo Info() {
    MapInfo info = testing::NamedMap("m", 2, 1);
    info.config.tracking.min_points_stuff = 100;
    info.config.tracking.min_points_medium = 100;
    return info;
  }

  /// Tracks and fuses a frame; answers where each segment (1..3) went.
  std::vector<Assignment> Feed(const PanopticFrame& frame) {
    const MapConfig& config = map_.info().config;
    const auto& segments = bundler_.BundleFrame(frame, frame.T_map_sensor, config.voxel_size_m);
    Tracker tracker(config, pool_);
    const std::vector<Assignment> assignments = tracker.Assign(frame, segments, map_);
    const RayOrigin origin(frame.T_map_sensor.translation(), config.voxel_size_m);
    std::vector<Assignment> by_row(frame.segments.size());
    for (std::size_t s = 0; s < segments.size(); ++s) {
      if (segments[s].row < 0) continue;
      const auto row = static_cast<std::size_t>(segments[s].row);
      by_row[row] = assignments[s];
      Submap& submap = *map_.FindMutable(assignments[s].submap);
      IntegrateSegment(segments[s], origin, frame.segments[row].class_id, config.integration, submap);
      submap.UpdateBoundingSphere();
      submap.mutable_info().num_frames_observed += 1;
    }
    return by_row;
  }

  Map map_;
  ThreadPool pool_{1};
  Bundler bundler_{map_.info().config.integration, pool_};
};

TEST_F(TrackerTest, FirstFrameMakesASubmapASegment) {
  const auto assignments = Feed(FrameOf(TwoBoxes()));
  for (const Assignment& assignment : assignments) EXPECT_TRUE(assignment.is_new);
  EXPECT_EQ(map_.submaps().size(), 4u);
}

TEST_F(TrackerTest, SwappedIdsStillFindTheirSubmaps) {
  const auto first = Feed(FrameOf(TwoBoxes()));
  PanopticFrame swapped = FrameOf(TwoBoxes());
  for (std::uint32_t& id : swapped.camera->segments) id = id == 1 ? 2 : (id == 2 ? 1 : id);
  const auto second = Feed(swapped);
  EXPECT_EQ(second[0].submap, first[1].submap);
  EXPECT_EQ(second[1].submap, first[0].submap);
  EXPECT_GT(second[0].iou, 0.9f);
  EXPECT_EQ(second[2].submap, first[2].submap);
}

TEST_F(TrackerTest, PersistentIdsMeanWhatTheirSessionSays) {
  PanopticFrame a = FrameOf(TwoBoxes());
  a.has_persistent_ids = true;
  a.session = "a";
  const auto of_a = Feed(a);
  ASSERT_TRUE(of_a[0].is_new && of_a[1].is_new);

  // Another robot calls the left box 2 and the right one 1.
  PanopticFrame b = a;
  b.session = "b";
  for (std::uint32_t& id : b.camera->segments) id = id == 1 ? 2 : id == 2 ? 1 : id;
  const auto of_b = Feed(b);
  EXPECT_FALSE(of_b[0].is_new || of_b[1].is_new);
  EXPECT_EQ(of_b[0].submap, of_a[1].submap);
  EXPECT_EQ(of_b[1].submap, of_a[0].submap);
  const Sightings& sightings = map_.Find(of_a[0].submap)->info().sightings;
  EXPECT_EQ(sightings.TrackOf("a"), 1u);
  EXPECT_EQ(sightings.TrackOf("b"), 2u);

  // From then on the ids count, wherever the boxes are seen.
  Scene moved = TwoBoxes();
  for (const std::size_t i : {0u, 1u}) moved.solids[i].center_m.z() += 0.3;
  for (const bool is_b : {false, true}) {
    PanopticFrame later = FrameOf(moved);
    later.has_persistent_ids = true;
    later.session = is_b ? "b" : "a";
    const auto assigned = Feed(later);
    EXPECT_EQ(assigned[0].submap, of_a[is_b ? 1 : 0].submap);
    EXPECT_EQ(assigned[1].submap, of_a[is_b ? 0 : 1].submap);
  }
}

TEST_F(TrackerTest, AnIdThatASessionHasGivenToAnotherThingIsNoCandidate) {
  PanopticFrame frame = FrameOf(TwoBoxes());
  frame.has_persistent_ids = true;
  frame.session = "a";
  const auto first = Feed(frame);
  // The same robot sees new ids where its own things are: it says that they are others.
  for (std::uint32_t& id : frame.camera->segments) id = id == 1 || id == 2 ? id + 10 : id;
  frame.segments[0].id = SegmentId(11);
  frame.segments[1].id = SegmentId(12);
  const auto second = Feed(frame);
  EXPECT_TRUE(second[0].is_new && second[1].is_new);
}

TEST_F(TrackerTest, ATrackOfWhichNobodyKnowsWhoseItIsBelongsToWhoNamesIt) {
  PanopticFrame frame = FrameOf(TwoBoxes());
  frame.has_persistent_ids = true;
  const auto first = Feed(frame);
  for (const std::size_t i : {0u, 1u})
    map_.FindMutable(first[i].submap)->mutable_info().sightings = {};  // as of schema 7
  frame.session = "robot";
  const auto again = Feed(frame);
  EXPECT_EQ(again[0].submap, first[0].submap);
  EXPECT_EQ(map_.Find(first[0].submap)->info().sightings.TrackOf("robot"), 1u);
}

TEST_F(TrackerTest, OverlapCountsAreThoseOfAPointByPointTest) {
  const PanopticFrame frame = FrameOf(TwoBoxes());
  Feed(frame);
  const MapConfig& config = map_.info().config;
  const auto& segments = bundler_.BundleFrame(frame, frame.T_map_sensor, config.voxel_size_m);
  const OverlapTable table = CountOverlaps(frame, segments, map_, pool_);
  ASSERT_EQ(table.candidates.size(), 2u);
  const PinholeCamera& camera = frame.camera->camera;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    for (std::size_t c = 0; c < 2; ++c) {
      const Submap& submap = *map_.Find(table.candidates[c]);
      std::int64_t hits = 0;
      for (int v = 0; v < camera.height_px; ++v) {
        for (int u = 0; u < camera.width_px; ++u) {
          const auto i = static_cast<std::size_t>(v * camera.width_px + u);
          const double depth = frame.camera->depth_m[i];
          if (frame.camera->segments[i] != static_cast<std::uint32_t>(segments[s].row + 1) || depth <= 0) continue;
          const Eigen::Vector3d p =
              frame.T_map_sensor * Eigen::Vector3d((u - camera.cx_px) / camera.fx_px * depth,
                                                   (v - camera.cy_px) / camera.fy_px * depth, depth);
          const VoxelIndex voxel = VoxelAt(p, config.voxel_size_m);
          const BlockEntry* entry = submap.blocks().Find(BlockOf(voxel));
          const auto linear = static_cast<std::size_t>(LinearIndex(voxel));
          if (entry && entry->tsdf->IsObserved(static_cast<int>(linear)) &&
              std::abs(entry->tsdf->distance_m[linear]) < config.voxel_size_m)
            ++hits;
        }
      }
      // Points within single precision of a voxel's face may fall on either side.
      EXPECT_NEAR(static_cast<double>(table.hits[s][c]), static_cast<double>(hits),
                  0.01 * static_cast<double>(hits) + 2);
    }
  }
}

TEST_F(TrackerTest, PointsCountForTheThingThatWasObservedMostThere) {
  const PanopticFrame frame = FrameOf(TwoBoxes());
  const SubmapId box = Feed(frame)[0].submap;
  Feed(frame);
  const auto& segments = bundler_.BundleFrame(frame, frame.T_map_sensor, map_.info().config.voxel_size_m);
  const std::int64_t hits_alone = CountOverlaps(frame, segments, map_, pool_).candidate_hits[0];
  ASSERT_GT(hits_alone, 100);

  // Another thing has the same surface, seen half as often: it is no part of what is in view.
  const SubmapId smear = map_.Clone(box)->id();
  std::vector<BlockIndex> blocks;
  for (const BlockEntry& entry : map_.Find(smear)->blocks().entries()) blocks.push_back(entry.index);
  const auto scale_weights = [&](float factor) {
    for (const BlockIndex index : blocks) {
      for (float& weight : map_.FindMutable(smear)->MutableTsdf(index).weight) weight *= factor;
    }
  };
  scale_weights(0.5f);
  const OverlapTable less = CountOverlaps(frame, segments, map_, pool_);
  ASSERT_EQ(less.candidates, (std::vector<SubmapId>{box, SubmapId(box.value + 1), smear}));
  EXPECT_EQ(less.candidate_hits[0], hits_alone);
  EXPECT_EQ(less.candidate_hits[2], 0);

  // Of equals, the older; and seen more often, it takes all.
  scale_weights(2.0f);
  EXPECT_EQ(CountOverlaps(frame, segments, map_, pool_).candidate_hits[0], hits_alone);
  scale_weights(2.0f);
  const OverlapTable more = CountOverlaps(frame, segments, map_, pool_);
  EXPECT_EQ(more.candidate_hits[0], 0);
  EXPECT_EQ(more.candidate_hits[2], hits_alone);
}

TEST_F(TrackerTest, BorderOfAMaskOnWhatIsBehindItMakesNoObject) {
  // Columns of the wall beside the first box belong to its mask.
  const auto with_border = [](int num_columns) {
    PanopticFrame frame = FrameOf(TwoBoxes());
    const auto width = static_cast<std::size_t>(frame.camera->camera.width_px);
    std::vector<std::uint32_t>& segments = frame.camera->segments;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const std::size_t row_begin = i - i % width;
      const bool is_beside = std::find(segments.begin() + static_cast<std::ptrdiff_t>(row_begin),
                                       segments.begin() + static_cast<std::ptrdiff_t>(row_begin + width),
                                       1u) != segments.begin() + static_cast<std::ptrdiff_t>(row_begin + width);
      if (is_beside && segments[i] == 3 && static_cast<int>(i % width) < num_columns) segments[i] = 1;
    }
    return frame;
  };
  map_.mutable_info().config.tracking.min_points_medium = 10;
  const auto num_new = [&](const PanopticFrame& frame) {
    auto segments = bundler_.BundleFrame(frame, frame.T_map_sensor, map_.info().config.voxel_size_m);
    SplitIntoParts({true, true, false}, map_.info().config.tracking.split_gap_vox, segments);
    Map map = map_.Fork();
    const auto assignments = Tracker(map.info().config, pool_).Assign(frame, segments, map);
    return std::count_if(assignments.begin(), assignments.end(), [](const Assignment& a) { return a.is_new; });
  };
  EXPECT_EQ(num_new(with_border(1)), 3);
  EXPECT_EQ(num_new(with_border(10)), 4);  // two parked cars may be one mask, too
}

TEST_F(TrackerTest, PartOfASegmentThatLiesOnAnotherThingMakesNoObject) {
  map_.mutable_info().config.tracking.min_points_medium = 10;
  map_.mutable_info().config.tracking.iou_threshold = 0.5;
  Feed(FrameOf(TwoBoxes()));
  // The outer columns of the first box belong to the mask of the second one.
  PanopticFrame frame = FrameOf(TwoBoxes());
  const auto width = static_cast<std::size_t>(frame.camera->camera.width_px);
  std::vector<std::uint32_t>& pixels = frame.camera->segments;
  const bool is_left = std::find(pixels.begin(), pixels.end(), 1u) < std::find(pixels.begin(), pixels.end(), 2u);
  for (std::size_t row = 0; row < pixels.size(); row += width) {
    for (int taken = 0, i = 0; i < static_cast<int>(width) && taken < 5; ++i) {
      std::uint32_t& pixel =
          pixels[row + (is_left ? static_cast<std::size_t>(i) : width - 1 - static_cast<std::size_t>(i))];
      if (pixel == 1) pixel = 2, ++taken;
    }
  }
  auto segments = bundler_.BundleFrame(frame, frame.T_map_sensor, map_.info().config.voxel_size_m);
  SplitIntoParts({true, true, false}, map_.info().config.tracking.split_gap_vox, segments);
  const auto assignments = Tracker(map_.info().config, pool_).Assign(frame, segments, map_);
  const auto part = std::find_if(segments.rbegin(), segments.rend(), [](const auto& p) { return p.row == 1; });
  EXPECT_EQ(part->num_points, 145);
  EXPECT_EQ(assignments[static_cast<std::size_t>(segments.rend() - part) - 1].submap, kUnknownSubmap);
  for (const Assignment& assignment : assignments) EXPECT_FALSE(assignment.is_new);
}

TEST_F(TrackerTest, TwoThatDoNotTouchNeverShareASubmap) {
  // First both boxes come as one merged segment; then apart: only one may keep the merged submap.
  PanopticFrame merged = FrameOf(TwoBoxes());
  for (std::uint32_t& id : merged.camera->segments) id = id == 2 ? 1 : id;
  const auto first = Feed(merged);
  const auto second = Feed(FrameOf(TwoBoxes()));
  EXPECT_NE(second[0].submap, second[1].submap);
  EXPECT_TRUE(second[0].submap == first[0].submap || second[1].submap == first[0].submap);
}

TEST_F(TrackerTest, PartsOfASplitSegmentThatTouchShareTheirSubmap) {
  const auto whole = Feed(FrameOf(TwoBoxes()));
  // The first box is cut into an upper and a lower half.
  PanopticFrame split = FrameOf(TwoBoxes());
  const int width = split.camera->camera.width_px;
  for (std::size_t i = 0; i < split.camera->segments.size(); ++i) {
    if (split.camera->segments[i] == 1 && static_cast<int>(i) / width < 60) split.camera->segments[i] = 4;
  }
  split.segments.push_back({.id = SegmentId(4), .class_id = kBox});
  const auto parts = Feed(split);
  EXPECT_EQ(parts[0].submap, whole[0].submap);
  EXPECT_EQ(parts[3].submap, whole[0].submap);
}

TEST_F(TrackerTest, ThingNeverJoinsABackgroundSubmap) {
  Feed(FrameOf(TwoBoxes()));
  PanopticFrame relabelled = FrameOf(TwoBoxes());
  relabelled.segments[2].class_id = kChair;  // the wall is now said to be a thing
  const auto assignments = Feed(relabelled);
  EXPECT_TRUE(assignments[2].is_new);
  EXPECT_EQ(map_.Find(assignments[2].submap)->info().panoptic, Panoptic::kThing);
}

TEST_F(TrackerTest, WrongClassStillFindsTheSubmapUnlessClassesMustMatch) {
  const auto first = Feed(FrameOf(TwoBoxes()));
  PanopticFrame wrong = FrameOf(TwoBoxes());
  wrong.segments[0].class_id = kChair;
  EXPECT_EQ(Feed(wrong)[0].submap, first[0].submap);

  map_.mutable_info().config.tracking.match_requires_class = true;
  EXPECT_NE(Feed(wrong)[0].submap, first[0].submap);
}

TEST_F(TrackerTest, SmallSegmentsGoToTheUnknownSubmap) {
  map_.mutable_info().config.tracking.min_points_medium = 100000;
  const auto assignments = Feed(FrameOf(TwoBoxes()));
  EXPECT_EQ(assignments[0].submap, kUnknownSubmap);
  EXPECT_FALSE(assignments[0].is_new);
}

TEST_F(TrackerTest, WhatTheNetworkDoubtsIsGeometryOnly) {
  map_.mutable_info().config.tracking.min_score = 0.6;
  PanopticFrame frame = FrameOf(TwoBoxes());
  frame.segments[0].score = 0.59f;
  frame.segments[1].score = 0.6f;
  const auto first = Feed(frame);  // the wall has no score
  EXPECT_EQ(first[0].submap, kUnknownSubmap);
  EXPECT_TRUE(first[1].is_new);
  EXPECT_TRUE(first[2].is_new);
  frame.segments[0].score = 0.9f;
  frame.segments[1].score = 0.1f;  // nor does it say what an object is that is already there
  const auto second = Feed(frame);
  EXPECT_TRUE(second[0].is_new);
  EXPECT_EQ(second[1].submap, kUnknownSubmap);
}

/// A block with a thin slab on it, which most frames take for a part of the block; segments 1 and 2.
Scene SlabOnBlock() {
  return {{{.shape = Solid::Shape::kBox, .center_m = {2, 0, 0.3}, .size_m = {0.6, 0.6, 0.3}, .segment = 1},
           {.shape = Solid::Shape::kBox, .center_m = {1.9, 0.1, 0.6}, .size_m = {0.12, 0.12, 0.005}, .segment = 2}}};
}

PanopticFrame FrameOfSlab(int i, ClassId class_of_slab) {
  PanopticFrame frame = Render(SlabOnBlock(), SmallCamera(), LookAt({0.6, 0.02 * i, 1.6}, {2, 0, 0.6}));
  frame.stamp_ns = i;
  frame.segments = {{.id = SegmentId(1), .class_id = kBox}, {.id = SegmentId(2), .class_id = class_of_slab}};
  return frame;
}

/// The slab is taken for a part of the block.
PanopticFrame FrameOfBlockAlone(int i) {
  PanopticFrame frame = FrameOfSlab(i, kChair);
  std::replace(frame.camera->segments.begin(), frame.camera->segments.end(), 2u, 1u);
  return frame;
}

TEST_F(TrackerTest, WhatLiesFlatOnALargerThingIsFoundAgain) {
  map_.mutable_info().config.tracking.min_points_medium = 20;
  for (int i = 0; i < 6; ++i) ASSERT_NE(Feed(FrameOfBlockAlone(i))[0].submap, kUnknownSubmap);
  const std::size_t num_before = map_.submaps().size();
  const Assignment first = Feed(FrameOfSlab(6, kChair))[1];
  ASSERT_TRUE(first.is_new);
  for (int i = 7; i < 12; ++i) {
    const Assignment again = Feed(FrameOfSlab(i, kChair))[1];
    EXPECT_EQ(again.submap, first.submap) << i;
    EXPECT_GT(again.iou, map_.info().config.tracking.iou_threshold);
  }
  EXPECT_EQ(map_.submaps().size(), num_before + 1);
}

TEST_F(TrackerTest, OfSegmentsThatLieOnOneCoveredThingTheBestIsIt) {
  map_.mutable_info().config.tracking.min_points_medium = 5;
  for (int i = 0; i < 6; ++i) Feed(FrameOfBlockAlone(i));
  const Assignment slab = Feed(FrameOfSlab(6, kChair))[1];
  ASSERT_TRUE(slab.is_new);
  // A few pixels of it come first in the table, apart from the rest.
  PanopticFrame frame = FrameOfSlab(7, kChair);
  frame.segments.insert(frame.segments.begin(), {.id = SegmentId(3), .class_id = kChair});
  std::vector<std::uint32_t>& ids = frame.camera->segments;
  const auto first = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), 2u) - ids.begin());
  const auto width = static_cast<std::size_t>(frame.camera->camera.width_px);
  for (std::size_t p = first; p < ids.size(); ++p) {
    if (ids[p] != 2) continue;
    if (p < first + width) ids[p] = 3;
    else if (p < first + 4 * width) ids[p] = 1;
  }
  const auto at = Feed(frame);
  EXPECT_EQ(at[2].submap, slab.submap);
  EXPECT_NE(at[0].submap, slab.submap);
}

TEST_F(TrackerTest, WhatIsCoveredByItsOwnClassIsNotFoundBelow) {
  map_.mutable_info().config.tracking.min_points_medium = 20;
  SubmapId block;
  for (int i = 0; i < 6; ++i) block = Feed(FrameOfBlockAlone(i))[0].submap;
  const Assignment slab = Feed(FrameOfSlab(6, kChair))[1];
  ASSERT_TRUE(slab.is_new);
  SubmapInfo& info = map_.FindMutable(block)->mutable_info();
  info.class_id = kChair;  // then it is rather a part of that
  info.class_is_fixed = true;
  info.class_counts = {{kChair, 1000}};
  EXPECT_NE(Feed(FrameOfSlab(7, kChair))[1].submap, slab.submap);
}

TEST_F(TrackerTest, WhatIsAbsentIsNotFoundBelow) {
  map_.mutable_info().config.tracking.min_points_medium = 20;
  for (int i = 0; i < 6; ++i) Feed(FrameOfBlockAlone(i));
  const Assignment slab = Feed(FrameOfSlab(6, kChair))[1];
  ASSERT_TRUE(slab.is_new);
  map_.FindMutable(slab.submap)->mutable_info().presence = Presence::kAbsent;
  EXPECT_NE(Feed(FrameOfSlab(7, kChair))[1].submap, slab.submap);
}

TEST_F(TrackerTest, WhatIsOfAnotherClassThanWhatLiesThereIsNew) {
  map_.mutable_info().config.tracking.min_points_medium = 20;
  map_.mutable_info().label_set = testing::MakeLabelSet(3, 1);
  for (int i = 0; i < 6; ++i) Feed(FrameOfBlockAlone(i));
  const Assignment chair = Feed(FrameOfSlab(6, kChair))[1];
  const Assignment other = Feed(FrameOfSlab(7, ClassId(3)))[1];
  EXPECT_TRUE(other.is_new);
  EXPECT_NE(other.submap, chair.submap);
}

TEST_F(TrackerTest, ThingThatIsNotSeenAgainDissolvesAndItsGeometryStays) {
  const auto first = Feed(FrameOf(TwoBoxes()));
  const auto count_observed = [this] {
    std::set<std::tuple<int, int, int, int>> voxels;
    for (const auto& submap : map_.submaps()) {
      for (const BlockEntry& entry : submap->blocks().entries()) {
        for (int i = 0; i < kBlockVoxels; ++i) {
          if (entry.tsdf->IsObserved(i)) voxels.insert({entry.index.x, entry.index.y, entry.index.z, i});
        }
      }
    }
    return voxels.size();
  };
  const std::size_t before = count_observed();
  // The segmentation never reports the first box again, though it is in plain view.
  PanopticFrame without = FrameOf(TwoBoxes());
  for (std::uint32_t& id : without.camera->segments) id = id == 1 ? 0 : id;
  int num_dissolved = 0;
  for (int i = 0; i < 3; ++i) num_dissolved += UpdateActivity(without, {first[1].submap, first[2].submap}, map_);
  EXPECT_EQ(num_dissolved, 1);
  EXPECT_EQ(map_.Find(first[0].submap), nullptr);
  EXPECT_NE(map_.Find(first[1].submap), nullptr);
  EXPECT_EQ(count_observed(), before);
}

TEST_F(TrackerTest, ThingsOutOfViewBecomeInactiveButStay) {
  const auto first = Feed(FrameOf(TwoBoxes()));
  PanopticFrame elsewhere = FrameOf(TwoBoxes());
  elsewhere.T_map_sensor = LookAt({0, 0, 1}, {-2, 0, 1});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(UpdateActivity(elsewhere, {}, map_), 0);
  EXPECT_EQ(map_.Find(first[0].submap)->info().activity, Activity::kInactive);
  UpdateActivity(FrameOf(TwoBoxes()), {first[0].submap}, map_);
  EXPECT_EQ(map_.Find(first[0].submap)->info().activity, Activity::kActive);
}

TEST(Visibility, SphereBehindTheCameraOrBeyondABorderIsNotInView) {
  PanopticFrame frame = FrameOf(TwoBoxes());
  EXPECT_TRUE(MayBeInView(frame, 5.0, {{2, 0, 1}, 0.1}));
  EXPECT_FALSE(MayBeInView(frame, 5.0, {{-1, 0, 1}, 0.5}));
  EXPECT_TRUE(MayBeInView(frame, 5.0, {{-0.2, 0, 1}, 0.5}));
  EXPECT_FALSE(MayBeInView(frame, 5.0, {{1, 3, 1}, 0.5}));
  EXPECT_FALSE(MayBeInView(frame, 5.0, {{9, 0, 1}, 0.5}));
  EXPECT_TRUE(MayBeInView(frame, 5.0, {{5.3, 0, 1}, 0.5}));
}

TEST(Visibility, HiddenThingsNeedNotBeSeen) {
  const PanopticFrame frame = FrameOf(TwoBoxes());
  FrameSight sight(frame, 5.0);
  EXPECT_TRUE(sight.ShouldBeSeen({{2, 0.4, 1}, 0.4}));
  EXPECT_FALSE(sight.ShouldBeSeen({{3.9, 0.4, 1}, 0.4}));  // behind the wall
}

}  // namespace
}  // namespace dhpmap
