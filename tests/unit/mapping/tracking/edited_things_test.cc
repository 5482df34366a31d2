// SPDX-License-Identifier: BSD-3-Clause
// Where segments go that show what somebody has merged, split or relabelled.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mapping/fusion/bundler.h"
#include "mapping/fusion/integrator.h"
#include "mapping/map/map_grid.h"
#include "mapping/tracking/tracker.h"
#include "mapping/tracking/visibility.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

constexpr ClassId kCupboard{1}, kSofa{2}, kBackdrop{3}, kCurtain{4};

/// Two boxes with sides of twice `size_m`, `apart_m` from centre to centre, before a wall; segments 1, 2 and 3. The
/// sensor looks along x.
PanopticFrame FrameOfCupboards(double apart_m, double size_m, const Eigen::Vector3d& sensor_m) {
  using Shape = testing::Solid::Shape;
  const Eigen::Vector3d half_m(size_m, size_m, size_m);
  const testing::Scene scene{{{.shape = Shape::kBox, .center_m = {2, -apart_m / 2, 1}, .size_m = half_m, .segment = 1},
                              {.shape = Shape::kBox, .center_m = {2, apart_m / 2, 1}, .size_m = half_m, .segment = 2},
                              {.shape = Shape::kHalfSpace, .center_m = {3, 0, 0}, .size_m = {-1, 0, 0}, .segment = 3}}};
  PanopticFrame frame =
      Render(scene, testing::SmallCamera(), testing::LookAt(sensor_m, sensor_m + Eigen::Vector3d(2, 0, 0)));
  frame.segments = {{.id = SegmentId(1), .class_id = kCupboard},
                    {.id = SegmentId(2), .class_id = kCupboard},
                    {.id = SegmentId(3), .class_id = kBackdrop}};
  return frame;
}

void Rename(std::uint32_t from, std::uint32_t to, PanopticFrame& frame) {
  for (std::uint32_t& id : frame.camera->segments) id = id == from ? to : id;
}

class EditedThings : public ::testing::TestWithParam<bool> {
 protected:
  static MapInfo InfoOfCupboards() {
    MapInfo info = testing::NamedMap("m", 2, 2);
    info.config.tracking.min_points_stuff = 100;
    info.config.tracking.min_points_medium = 100;
    return info;
  }

  static PanopticFrame Frame(double apart_m, const Eigen::Vector3d& sensor_m = {0, 0.01, 1.02}) {
    PanopticFrame frame = FrameOfCupboards(apart_m, 0.25, sensor_m);
    frame.has_persistent_ids = GetParam();
    return frame;
  }

  /// Tracks and fuses a frame as a map does; answers where the points of segments went, by row, each once.
  std::vector<std::vector<SubmapId>> Feed(const PanopticFrame& frame) {
    const MapConfig& config = map_.info().config;
    auto segments = bundler_.BundleFrame(frame, frame.T_map_sensor, config.voxel_size_m);
    Tracker tracker(config, pool_);
    tracker.CutAtSplits(frame, map_, segments);
    const std::vector<Assignment> assignments = tracker.Assign(frame, segments, map_);
    const RayOrigin origin(frame.T_map_sensor.translation(), config.voxel_size_m);
    std::vector<std::vector<SubmapId>> by_row(frame.segments.size());
    num_segments_ = segments.size();
    num_new_ = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      if (segments[s].row < 0) continue;
      const auto row = static_cast<std::size_t>(segments[s].row);
      std::vector<SubmapId>& of_row = by_row[row];
      const SubmapId id = assignments[s].submap;
      if (std::find(of_row.begin(), of_row.end(), id) == of_row.end()) of_row.push_back(id);
      num_new_ += assignments[s].is_new;
      Submap& submap = *map_.FindMutable(id);
      IntegrateSegment(segments[s], origin, frame.segments[row].class_id, config.integration, submap);
      submap.UpdateBoundingSphere();
    }
    for (std::vector<SubmapId>& of_row : by_row) std::sort(of_row.begin(), of_row.end());
    return by_row;
  }

  /// As if somebody had merged another object into it, to which the session without a name gave that id.
  void NoteMergedInto(SubmapId whole, std::uint32_t track_id) {
    SubmapInfo info;
    info.panoptic = Panoptic::kThing;
    info.class_id = kCupboard;
    const SubmapId part = map_.Create(std::move(info)).id();
    map_.Remove(part);
    map_.mutable_info().merged.Add(part, whole);
    map_.mutable_info().pairs.SetVerdict(part, whole, PairVerdict::kMustBeOne);
    if (GetParam()) map_.FindMutable(whole)->mutable_info().sightings.AddTrack("", track_id);
  }
  /// Both boxes as one object, although nothing connects them.
  SubmapId BothAsOne() {
    PanopticFrame frame = Frame(0.8);
    Rename(2, 1, frame);
    return Feed(frame)[0].at(0);
  }

  /// As if both were parts of what is known as segment 1, of which somebody has split segment 2 off.
  void NoteSplit(SubmapId rest, SubmapId part) {
    map_.mutable_info().pairs.SetVerdict(rest, part, PairVerdict::kMustBeTwo);
    map_.FindMutable(part)->mutable_info().sightings = {};
    map_.FindMutable(part)->mutable_info().track_id = 0;
  }

  Map map_{InfoOfCupboards()};
  ThreadPool pool_{1};
  Bundler bundler_{map_.info().config.integration, pool_};
  std::size_t num_segments_ = 0;
  int num_new_ = 0;
};

using Ids = std::vector<SubmapId>;

TEST_P(EditedThings, SegmentsOfWhatSomebodyHasMergedGoToTheWholeThoughTheyStandApart) {
  const SubmapId whole = BothAsOne();
  NoteMergedInto(whole, 2);
  for (int i = 0; i < 3; ++i) {
    const auto assigned = Feed(Frame(0.8));
    EXPECT_EQ(assigned[0], Ids{whole});
    EXPECT_EQ(assigned[1], Ids{whole});
    EXPECT_EQ(num_new_, 0);
  }
}

TEST_P(EditedThings, AnIdThatNobodyHasGivenBeforeGoesToWhatSomebodyHasMergedWhereItLiesOnIt) {
  const SubmapId whole = BothAsOne();
  NoteMergedInto(whole, 9);
  PanopticFrame frame = Frame(0.8);
  frame.session = GetParam() ? "another" : "";
  EXPECT_EQ(Feed(frame)[0], Ids{whole});
  EXPECT_EQ(Feed(frame)[1], Ids{whole});
  Rename(2, 12, frame);
  frame.segments[1].id = SegmentId(12);
  EXPECT_EQ(Feed(frame)[1], Ids{whole});
  if (!GetParam()) return;
  for (const std::uint32_t id : {1u, 2u, 12u}) {
    EXPECT_TRUE(map_.Find(whole)->info().sightings.IsTrackedAs("another", id)) << id;
  }
}

TEST_P(EditedThings, ASmallPartOfWhatSomebodyHasMergedGoesToItThoughItIsLittleOfTheWhole) {
  map_.mutable_info().config.tracking.iou_threshold = 0.9;
  const SubmapId whole = BothAsOne();
  NoteMergedInto(whole, 2);
  EXPECT_EQ(Feed(Frame(0.8))[1], Ids{whole});
}

TEST_P(EditedThings, ASegmentThatShowsBothPartsOfASplitFeedsBoth) {
  const auto first = Feed(Frame(0.5));  // side by side, touching
  const SubmapId rest = first[0].at(0), part = first[1].at(0);
  NoteSplit(rest, part);
  PanopticFrame as_one = Frame(0.5);
  Rename(2, 1, as_one);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(Feed(as_one)[0], (Ids{rest, part}));
    EXPECT_EQ(num_new_, 0);
  }
}

TEST_P(EditedThings, ASegmentOfTheWholeThatShowsOnlyWhatWasSplitOffGoesToThat) {
  const auto first = Feed(Frame(0.5));
  const SubmapId rest = first[0].at(0), part = first[1].at(0);
  NoteSplit(rest, part);
  PanopticFrame frame = Frame(0.5);
  Rename(1, 0, frame);
  Rename(2, 1, frame);
  EXPECT_EQ(Feed(frame)[0], Ids{part});
  EXPECT_EQ(num_new_, 0);
}

TEST_P(EditedThings, ASegmentOfTheWholeGoesToWhatWasSplitOffThoughTheRestIsOutOfView) {
  const auto first = Feed(Frame(2.4));
  const SubmapId rest = first[0].at(0), part = first[1].at(0);
  NoteSplit(rest, part);
  PanopticFrame frame = Frame(2.4, {1.2, 1.21, 1.02});
  ASSERT_EQ(std::count(frame.camera->segments.begin(), frame.camera->segments.end(), 1u), 0);
  ASSERT_FALSE(MayBeInView(frame, map_.info().config.integration.max_range_m, map_.Find(rest)->BoundingSphereInMap()));
  Rename(2, 1, frame);
  EXPECT_EQ(Feed(frame)[0], Ids{part});
  EXPECT_EQ(num_new_, 0);
}

TEST_P(EditedThings, AnIdThatNobodyHasGivenBeforeGoesToWhatWasSplitOffWhereItLiesOnIt) {
  const auto first = Feed(Frame(0.5));
  const SubmapId rest = first[0].at(0), part = first[1].at(0);
  NoteSplit(rest, part);
  PanopticFrame frame = Frame(0.5);
  Rename(2, 12, frame);
  frame.segments[1].id = SegmentId(12);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(Feed(frame)[1], Ids{part});
    EXPECT_EQ(num_new_, 0);
  }
  EXPECT_EQ(map_.Find(part)->info().sightings.IsTrackedAs("", 12), GetParam());
}

TEST_P(EditedThings, WhatIsOfAnotherClassIsNotOfTheMergedThingThatItLiesOn) {
  map_.mutable_info().config.tracking.match_requires_class = true;
  const SubmapId whole = BothAsOne();
  NoteMergedInto(whole, 9);
  PanopticFrame frame = Frame(0.8);
  Rename(2, 12, frame);
  frame.segments[1] = {.id = SegmentId(12), .class_id = kSofa};
  const auto assigned = Feed(frame);
  EXPECT_EQ(assigned[0], Ids{whole});
  EXPECT_NE(assigned[1], Ids{whole});
  EXPECT_EQ(num_new_, 1);
  EXPECT_FALSE(map_.Find(whole)->info().sightings.IsTrackedAs("", 12));
}

TEST_P(EditedThings, AFewPointsOnWhatWasSplitOffAreNoSightOfIt) {
  const auto first = Feed(Frame(0.6));
  const SubmapId rest = first[0].at(0), part = first[1].at(0);
  NoteSplit(rest, part);
  PanopticFrame frame = Frame(0.6);
  int num_stray = 0;
  for (std::size_t i = 0; i < frame.camera->segments.size(); ++i) {
    std::uint32_t& segment = frame.camera->segments[i];
    if (segment != 2) continue;
    const bool is_inside = frame.camera->segments[i + 3] == 2 && frame.camera->segments[i + 160] == 2;
    if (is_inside && num_stray < 3) {
      segment = 1;
      ++num_stray;
    } else {
      frame.camera->depth_m[i] = 0;  // hidden
    }
  }
  ASSERT_EQ(num_stray, 3);
  EXPECT_EQ(Feed(frame)[0], Ids{rest});
}

TEST_P(EditedThings, ASegmentOfAWholeThatWasMovedIsNotCut) {
  const auto first = Feed(Frame(0.5));
  for (int i = 0; i < 2; ++i) Feed(Frame(0.5));
  const SubmapId rest = first[0].at(0), part = first[1].at(0);
  PanopticFrame as_one = Frame(0.5);
  Rename(2, 1, as_one);
  Feed(as_one);
  const std::size_t num_uncut = num_segments_;
  NoteSplit(rest, part);
  map_.FindMutable(rest)->mutable_info().T_map_submap.translation().z() = 0.001;
  ASSERT_FALSE(IsOnMapGrid(map_.Find(rest)->info(), map_.info().config));
  Feed(as_one);
  EXPECT_EQ(num_segments_, num_uncut) << "it would be fused as a whole into what was moved, and in part once more";
}

TEST_P(EditedThings, WhatNobodyHasSplitIsNotCut) {
  const auto first = Feed(Frame(0.5));
  for (int i = 0; i < 2; ++i) Feed(Frame(0.5));
  PanopticFrame as_one = Frame(0.5);
  Rename(2, 1, as_one);
  EXPECT_EQ(Feed(as_one)[0].size(), 1u);
  map_.mutable_info().pairs.SetVerdict(first[0].at(0), first[1].at(0), PairVerdict::kMustBeTwo);
  const std::size_t num_before = num_segments_;
  Feed(as_one);
  EXPECT_EQ(num_segments_, num_before + 1);
}

TEST_P(EditedThings, TwoThatFramesHaveShownApartMoreThanOnceAreCutWhereOneShowsThemAsOneUnlessIdsTellThemApart) {
  const auto first = Feed(Frame(0.5));
  const SubmapId a = first[0].at(0), b = first[1].at(0);
  for (int i = 0; i < 2; ++i) Feed(Frame(0.5));
  PanopticFrame as_one = Frame(0.5);
  Rename(2, 1, as_one);
  const auto say = [&](std::int32_t evidence) { map_.mutable_info().pairs.AddEvidence(a, b, evidence, -120, 60); };
  say(ObjectPair::kSpeaksForTwo + 1);
  EXPECT_EQ(Feed(as_one)[0].size(), 1u);
  say(-1);
  EXPECT_EQ(Feed(as_one)[0], GetParam() ? Ids{a} : (Ids{a, b}));
  map_.mutable_info().pairs.SetVerdict(a, b, PairVerdict::kMustBeOne);
  EXPECT_EQ(Feed(as_one)[0].size(), 1u) << "somebody has said otherwise";
}

TEST_P(EditedThings, PartsOfASplitThatFramesTellApartAreNotCutWhereTheirMasksMeet) {
  const auto first = Feed(Frame(0.5));
  map_.mutable_info().pairs.SetVerdict(first[0].at(0), first[1].at(0), PairVerdict::kMustBeTwo);
  PanopticFrame shifted = Frame(0.5);
  const std::size_t num_before = num_segments_;
  std::vector<std::uint32_t>& pixels = shifted.camera->segments;
  const std::vector<std::uint32_t> before = pixels;
  int num_shifted = 0;
  for (std::size_t i = 1; i + 1 < before.size(); ++i) {  // a column of one mask is the other's
    if (before[i] == 1 && (before[i - 1] == 2 || before[i + 1] == 2)) pixels[i] = 2, ++num_shifted;
  }
  ASSERT_GT(num_shifted, 10);
  const auto assigned = Feed(shifted);
  EXPECT_EQ(num_segments_, num_before);
  EXPECT_EQ(assigned[0], first[0]);
  EXPECT_EQ(assigned[1], first[1]);
}

TEST_P(EditedThings, ARelabelledBackgroundGetsWhatFramesStillCallByItsOldClass) {
  const SubmapId wall = Feed(Frame(0.8))[2].at(0);
  SubmapInfo& info = map_.FindMutable(wall)->mutable_info();
  info.class_counts = {{kBackdrop, 50'000'000}};
  info.class_id = kCurtain;
  info.class_is_fixed = true;
  EXPECT_EQ(Feed(Frame(0.8))[2], Ids{wall});
  PanopticFrame frame = Frame(0.8);
  frame.segments[2].class_id = kCurtain;
  EXPECT_EQ(Feed(frame)[2], Ids{wall}) << "there is no other of its class";

  const SubmapId curtain = map_.Create(testing::InfoOn(map_, Panoptic::kStuff, kCurtain)).id();
  EXPECT_EQ(Feed(frame)[2], Ids{curtain}) << "what was seen as that class comes first";
  EXPECT_EQ(Feed(Frame(0.8))[2], Ids{wall});
}

TEST_P(EditedThings, ABackgroundOfAClassComesBeforeARelabelledOneThatFramesHaveCalledSoToo) {
  const SubmapId wall = Feed(Frame(0.8))[2].at(0);
  PanopticFrame frame = Frame(0.8);
  frame.segments[2].class_id = kCurtain;
  const SubmapId curtain = Feed(frame)[2].at(0);
  ASSERT_NE(curtain, wall);
  SubmapInfo& info = map_.FindMutable(wall)->mutable_info();
  info.class_counts = {{kBackdrop, 50}, {kCurtain, 40}};
  info.class_id = ClassId(9);
  info.class_is_fixed = true;
  EXPECT_EQ(Feed(frame)[2], Ids{curtain});
  EXPECT_EQ(Feed(Frame(0.8))[2], Ids{wall});
}

TEST_P(EditedThings, ARelabelledThingIsMatchedByItsOldClassWhereClassesMustMatchAndComesBack) {
  map_.mutable_info().config.tracking.match_requires_class = true;
  const SubmapId cupboard = Feed(Frame(0.8))[0].at(0);
  SubmapInfo& info = map_.FindMutable(cupboard)->mutable_info();
  info.class_counts = {{kCupboard, 50'000'000}};
  info.class_id = kSofa;
  info.class_is_fixed = true;
  EXPECT_EQ(Feed(Frame(0.8))[0], Ids{cupboard});
  map_.FindMutable(cupboard)->mutable_info().presence = Presence::kAbsent;
  EXPECT_EQ(Feed(Frame(0.8))[0], Ids{cupboard});
}

INSTANTIATE_TEST_SUITE_P(Ids, EditedThings, ::testing::Bool(),
                         [](const auto& ids) { return ids.param ? "Persistent" : "PerFrame"; });

}  // namespace
}  // namespace dhpmap
