// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <set>
#include <vector>

#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::LookAt;
using testing::MapsAreEqual;
using testing::Render;
using testing::Scene;
using testing::SmallCamera;
using testing::Solid;

constexpr ClassId kCrateClass{1}, kFloorClass{3};
constexpr std::uint32_t kCrateId = 12, kFloorId = 13;

MapInfo CrateInfo(int every_frames) {
  MapInfo info = testing::NamedMap("room", 2, 1);
  info.config.tracking.min_points_stuff = 100;
  info.config.tracking.min_points_medium = 50;
  info.config.refinement.every_frames = every_frames;
  return info;
}

/// A crate on the floor; in every third frame the segmentation takes a strip of it for floor.
PanopticFrame CrateFrame(int i, const Eigen::Vector3d& target_m = {2.1, 0, 0.3}) {
  const Scene scene{{{.shape = Solid::Shape::kBox,
                      .center_m = {2.2, 0, 0.3},
                      .size_m = {0.3, 0.3, 0.3},
                      .segment = kCrateId,
                      .color = {0, 200, 0}},
                     {.shape = Solid::Shape::kHalfSpace,
                      .center_m = {0, 0, 0},
                      .size_m = {0, 0, 1},
                      .segment = kFloorId,
                      .color = {90, 90, 90}}}};
  PanopticFrame frame = Render(scene, SmallCamera(), LookAt({0, -0.5 + 0.08 * i, 1.2}, target_m));
  frame.stamp_ns = i;
  frame.segments = {{.id = SegmentId(kCrateId), .class_id = kCrateClass},
                    {.id = SegmentId(kFloorId), .class_id = kFloorClass}};
  std::vector<std::uint32_t>& segments = frame.camera->segments;
  for (std::size_t p = 0; i % 3 == 0 && p < segments.size(); ++p) {
    if (segments[p] == kCrateId && p % 7 < 2) segments[p] = kFloorId;
  }
  return frame;
}

void MapFrames(int begin, int end, MapBuilder& builder) {
  for (int i = begin; i < end; ++i) ASSERT_TRUE(builder.Integrate(CrateFrame(i)).ok());
}

/// The robot looks away: the crate settles, and nobody writes to the floor below it.
void LookAway(int num_frames, MapBuilder& builder) {
  for (int i = 0; i < num_frames; ++i) ASSERT_TRUE(builder.Integrate(CrateFrame(i, {-2.1, 0, 0.3})).ok());
}

int NumPositionsHeldTwice(const MapSnapshot& map) {
  std::set<VoxelIndex> held;
  int num_twice = 0;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (entry.tsdf->IsObserved(i)) num_twice += held.insert(VoxelIn(entry.index, i)).second ? 0 : 1;
      }
    }
  }
  return num_twice;
}

TEST(Refinement, FinishLeavesEachPositionToOneSubmap) {
  MapBuilder builder(CrateInfo(0), 2);
  MapFrames(0, 8, builder);
  EXPECT_GT(NumPositionsHeldTwice(*builder.map().Freeze()), 0);
  const RefinementReport report = builder.Finish();
  EXPECT_GT(report.management.num_shared_voxels, 0);
  EXPECT_GT(report.crf.num_voxels, 0);
  EXPECT_EQ(NumPositionsHeldTwice(*builder.map().Freeze()), 0);
}

TEST(Refinement, OnTheSideIsTheSameForAnyNumberOfThreads) {
  MapBuilder one(CrateInfo(2), 1), three(CrateInfo(2), 3);
  for (MapBuilder* builder : {&one, &three}) {
    MapFrames(0, 4, *builder);
    LookAway(8, *builder);
    MapFrames(4, 7, *builder);
  }
  EXPECT_GT(one.refinement_total().crf.num_voxels, 0);
  EXPECT_TRUE(MapsAreEqual(*one.map().Freeze(), *three.map().Freeze()));
  one.Finish();
  three.Finish();
  EXPECT_TRUE(MapsAreEqual(*one.map().Freeze(), *three.map().Freeze()));
}

TEST(Refinement, OnTheSideTakesOverWhatNobodyWrote) {
  MapBuilder builder(CrateInfo(4), 2);
  MapFrames(0, 4, builder);
  const int before = NumPositionsHeldTwice(*builder.map().Freeze());
  ASSERT_GT(before, 0);
  LookAway(8, builder);  // settles, is refined at the turn after 8 frames, and taken over at that after 12
  EXPECT_GT(builder.refinement_total().management.num_shared_voxels, 0);
  EXPECT_LT(NumPositionsHeldTwice(*builder.map().Freeze()), before / 10);
}

TEST(Refinement, OfTheStatesThatItBeganWithOnlyMarksAreLeftOnceItIsTakenOver) {
  MapBuilder builder(CrateInfo(4), 2);
  std::vector<std::weak_ptr<const TsdfBlock>> began_with;
  for (int i = 0; i < 12; ++i) {  // begins after frames 4, 8, 12; is taken over after 8, 12
    MapFrames(i, i + 1, builder);
    if (i != 3 && i != 7) continue;
    for (const auto& submap : builder.map().submaps()) {
      for (const BlockEntry& entry : submap->blocks().entries()) began_with.emplace_back(entry.tsdf);
    }
  }
  std::set<const TsdfBlock*> present;
  for (const auto& submap : builder.map().submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) present.insert(entry.tsdf.get());
  }
  int num_written = 0;
  for (const auto& block : began_with) {
    num_written += block.expired();
    EXPECT_TRUE(block.expired() || present.contains(block.lock().get()));
  }
  EXPECT_GT(num_written, 100);
}

TEST(Refinement, TheFrameThatTakesOverSaysWhatWasDone) {
  MapBuilder builder(CrateInfo(4), 2);
  RefinementReport sum;
  int num_reports = 0;
  for (int i = 0; i < 16; ++i) {
    const auto report = builder.Integrate(i < 4 ? CrateFrame(i) : CrateFrame(i, {-2.1, 0, 0.3}));
    ASSERT_TRUE(report.ok());
    if (!report->refinement) continue;
    sum += *report->refinement;
    ++num_reports;
  }
  EXPECT_GE(num_reports, 3) << "rounds begin after frames 4, 8, 12, and are through before the next";
  EXPECT_LE(num_reports, 12) << "a step a frame";
  EXPECT_GT(sum.management.num_shared_voxels, 0);
  EXPECT_EQ(sum.management.num_shared_voxels, builder.refinement_total().management.num_shared_voxels);
  EXPECT_EQ(sum.crf_s, builder.refinement_total().crf_s);
}

TEST(Refinement, AServerThatNeverWaitsEndsWithAnExclusiveMapToo) {
  MapBuilder builder(CrateInfo(1), 2, RefinementTiming::kNeverWait);
  MapFrames(0, 9, builder);
  builder.Finish();
  EXPECT_EQ(NumPositionsHeldTwice(*builder.map().Freeze()), 0);
}

TEST(Refinement, AFinishThatIsCancelledLeavesTheMapAsItWas) {
  MapBuilder builder(CrateInfo(0), 2), untouched(CrateInfo(0), 2);
  for (MapBuilder* each : {&builder, &untouched}) MapFrames(0, 8, *each);
  std::atomic<int> num_questions = 0;                     // several threads ask
  for (int patience = 0;; patience = 2 * patience + 1) {  // cancelled at the first question, later ones, not at all
    num_questions = 0;
    const auto is_cancelled = [&] { return num_questions++ >= patience; };
    MapBuilder copy(builder.map().Freeze(), 2);
    if (copy.Finish(is_cancelled)) {
      EXPECT_EQ(NumPositionsHeldTwice(*copy.map().Freeze()), 0);
      break;
    }
    EXPECT_TRUE(MapsAreEqual(*copy.map().Freeze(), *untouched.map().Freeze())) << "after question " << patience;
  }
  EXPECT_GT(num_questions, 1);
  EXPECT_FALSE(builder.Finish([] { return true; }));
  builder.Finish();
  untouched.Finish();
  EXPECT_TRUE(MapsAreEqual(*builder.map().Freeze(), *untouched.map().Freeze())) << "and it can be finished later";
}

TEST(Refinement, WhatWasRefinedIsNotKeptOnceItIsWrittenAnew) {
  MapBuilder builder(CrateInfo(0), 1);
  MapFrames(0, 3, builder);
  builder.Finish();
  std::vector<std::weak_ptr<const TsdfBlock>> before;
  for (const auto& submap : builder.map().Publish(0)->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) before.push_back(entry.tsdf);
  }
  MapFrames(0, 3, builder);  // the same places
  builder.map().Publish(1);
  std::set<const TsdfBlock*> now;
  for (const auto& submap : builder.map().submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) now.insert(entry.tsdf.get());
  }
  int num_written = 0;
  for (const auto& layer : before) {
    if (now.contains(layer.lock().get())) continue;
    ++num_written;
    EXPECT_TRUE(layer.expired()) << "something holds a state that nobody can ask for";
  }
  EXPECT_GT(num_written, 10);
}

TEST(Refinement, WaitsForASlotThatOtherMapsHold) {
  const auto slots = std::make_shared<RefinementSlots>(1);
  MapBuilder empty(CrateInfo(4), 1);
  MapBuilder builder(empty.map().Freeze(), std::make_shared<ThreadPool>(1), RefinementTiming::kReproducible, slots);
  auto held = RefinementSlots::TryTake(slots);
  MapFrames(0, 4, builder);
  LookAway(8, builder);
  EXPECT_EQ(builder.refinement_total().crf.num_voxels, 0) << "others refine";
  held.reset();
  LookAway(1, builder);  // begins now, out of turn
  LookAway(7, builder);
  EXPECT_GT(builder.refinement_total().crf.num_voxels, 0);
  builder.Finish();
  EXPECT_TRUE(RefinementSlots::TryTake(slots)) << "and it is given back";
}

TEST(Refinement, SnapshotsDoNotChangeWhileRefinementIsUnderWay) {
  MapBuilder builder(CrateInfo(2), 2);
  MapFrames(0, 4, builder);
  const auto snapshot = builder.map().Publish(0);
  MapBuilder same(CrateInfo(2), 1);
  MapFrames(0, 4, same);
  const auto untouched = same.map().Publish(0);
  MapFrames(4, 8, builder);
  builder.Finish();
  EXPECT_TRUE(MapsAreEqual(*snapshot, *untouched));
}

TEST(Refinement, DroppedLabelsComeBackWhenMappingGoesOn) {
  MapInfo info = CrateInfo(0);
  info.config.refinement.drop_voxel_labels = true;
  MapBuilder builder(info, 2);
  MapFrames(0, 4, builder);
  EXPECT_GT(builder.Finish().num_bytes_dropped, 0);
  const auto finished = builder.map().Publish(0);
  for (const auto& submap : finished->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) EXPECT_EQ(entry.labels, nullptr);
  }
  MapBuilder next_day(finished, 2);
  MapFrames(4, 8, next_day);
  next_day.Finish();
  const auto map = next_day.map().Publish(0);
  EXPECT_EQ(NumPositionsHeldTwice(*map), 0);
  ASSERT_EQ(map->submaps().size(), finished->submaps().size());
  for (std::size_t s = 0; s < map->submaps().size(); ++s) {
    EXPECT_EQ(map->submaps()[s]->info().class_id, finished->submaps()[s]->info().class_id);
  }
}

TEST(Refinement, SwitchedOffLeavesOverlaps) {
  MapInfo info = CrateInfo(2);
  info.config.refinement.management = info.config.refinement.crf = false;
  MapBuilder builder(info, 2);
  MapFrames(0, 6, builder);
  builder.Finish();
  EXPECT_GT(NumPositionsHeldTwice(*builder.map().Freeze()), 0);
}

}  // namespace
}  // namespace dhpmap
