// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/activity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

/// Beams of a degree all around that end far behind everything.
LidarData ScanOfOpenSpace() {
  LidarData scan;
  for (int elevation = -80; elevation <= 80; ++elevation) {
    for (int azimuth = 0; azimuth < 360; ++azimuth) {
      const double e = elevation * M_PI / 180, a = azimuth * M_PI / 180;
      scan.points_m.push_back(
          20 * Eigen::Vector3d(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)).cast<float>());
    }
  }
  return scan;
}

/// A map whose submaps are single blocks, before a scanner that looks past them and is far away in the other frame.
class ActivityTest : public ::testing::Test {
 protected:
  ActivityTest() : map_(Info()) {
    here_.lidar = ScanOfOpenSpace();
    away_ = here_;
    away_.T_map_sensor.translation().x() = 100;
  }

  static MapInfo Info() {
    MapInfo info = testing::NamedMap("m", 1, 1);
    info.config.voxel_size_m = 0.1;
    info.config.truncation_m = 0.2;
    info.config.integration.max_weight = 100;
    info.config.activity = {.required_reobservations = 3, .deactivate_after_missed = 3};
    return info;
  }

  SubmapInfo Thing(bool is_confirmed) const {
    SubmapInfo info = testing::InfoOn(map_, Panoptic::kThing, ClassId(1));
    info.is_confirmed = is_confirmed;
    return info;
  }

  /// A submap with one observed voxel, the first of `block`.
  SubmapId Add(const SubmapInfo& info, BlockIndex block = {2, 0, 0}) {
    Submap& submap = map_.Create(info);
    submap.MutableTsdf(block).weight[0] = 1;
    submap.UpdateBoundingSphere();
    return submap.id();
  }

  int Miss(SubmapId id, int times, const PanopticFrame& frame) {
    int num_dissolved = 0;
    for (int i = 0; i < times && map_.Find(id) != nullptr; ++i) num_dissolved += UpdateActivity(frame, {}, map_);
    return num_dissolved;
  }
  Activity ActivityOf(SubmapId id) const { return map_.Find(id)->info().activity; }

  Map map_;
  PanopticFrame here_, away_;
};

TEST_F(ActivityTest, AThingSettlesInTheFrameThatMakesItsMissesEnough) {
  const SubmapId id = Add(Thing(true));
  EXPECT_EQ(Miss(id, 2, here_), 0);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
  EXPECT_EQ(Miss(id, 1, here_), 0);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive);
}

TEST_F(ActivityTest, AnObservationBeginsTheCountAnewAndWakesWhatHasSettled) {
  const SubmapId id = Add(Thing(true));
  Miss(id, 2, away_);
  UpdateActivity(here_, {id}, map_);
  EXPECT_EQ(map_.Find(id)->info().num_frames_missed, 0);
  Miss(id, 2, away_);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
  Miss(id, 1, away_);
  ASSERT_EQ(ActivityOf(id), Activity::kInactive);
  UpdateActivity(here_, {id}, map_);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
}

TEST_F(ActivityTest, AConfirmedThingIsNeverDissolvedAndNotTouchedOnceSettled) {
  const SubmapId id = Add(Thing(true));
  EXPECT_EQ(Miss(id, 3, here_), 0);
  const auto settled = map_.Publish(1);
  EXPECT_EQ(Miss(id, 20, here_), 0);
  EXPECT_EQ(map_.Publish(2), settled) << "nothing was written";
}

TEST_F(ActivityTest, AThingIsConfirmedOnceItWasObservedOftenEnoughAfterTheFirstTime) {
  const SubmapId id = Add(Thing(false));
  map_.FindMutable(id)->mutable_info().num_frames_observed = 3;  // the first time, and again twice
  UpdateActivity(here_, {id}, map_);
  EXPECT_FALSE(map_.Find(id)->info().is_confirmed);
  map_.FindMutable(id)->mutable_info().num_frames_observed = 4;
  UpdateActivity(here_, {id}, map_);
  EXPECT_TRUE(map_.Find(id)->info().is_confirmed);
}

TEST_F(ActivityTest, AnUnconfirmedThingIsDissolvedWhenOverlookedOftenEnoughWithFramesElsewhereBetween) {
  const SubmapId id = Add(Thing(false));
  EXPECT_EQ(Miss(id, 2, here_), 0);
  EXPECT_EQ(Miss(id, 10, away_), 0);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive);
  EXPECT_EQ(map_.Find(id)->info().num_frames_overlooked, 2);
  EXPECT_EQ(Miss(id, 1, here_), 1);
  EXPECT_EQ(map_.Find(id), nullptr);
  EXPECT_TRUE(map_.Find(kUnknownSubmap)->blocks().Find({2, 0, 0})->tsdf->IsObserved(0));
}

TEST_F(ActivityTest, AnUnconfirmedThingThatLeavesTheImageToWhichScansAreCroppedStays) {
  const SubmapId id = Add(Thing(false));
  std::vector<Eigen::Vector3f>& points_m = here_.lidar->points_m;
  const Eigen::Vector3f to_thing = map_.Find(id)->BoundingSphereInMap().center_m.cast<float>();
  std::erase_if(points_m, [&](const Eigen::Vector3f& p) { return p.normalized().dot(to_thing.normalized()) > 0.8f; });
  EXPECT_EQ(Miss(id, 20, here_), 0);
  ASSERT_NE(map_.Find(id), nullptr);
  EXPECT_EQ(map_.Find(id)->info().num_frames_overlooked, 0);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive) << "it was not seen for a while, for whatever reason";
}

TEST_F(ActivityTest, AnUnconfirmedThingThatIsHiddenFromAScannerStays) {
  const SubmapId id = Add(Thing(false));
  for (Eigen::Vector3f& p : here_.lidar->points_m) p *= 0.02f;  // something is around the scanner, at 40 cm
  EXPECT_EQ(Miss(id, 20, here_), 0);
  EXPECT_NE(map_.Find(id), nullptr);
}

TEST_F(ActivityTest, WhatAPersonHasEditedIsNotDissolvedThoughItIsOverlookedAndNotConfirmed) {
  const auto edits = {+[](SubmapInfo& info) { info.display_name = "throne"; },
                      +[](SubmapInfo& info) { info.class_is_fixed = true; }};
  for (const auto edit : edits) {
    SubmapInfo info = Thing(false);
    edit(info);
    const SubmapId id = Add(info);
    EXPECT_EQ(Miss(id, 10, here_), 0);
    ASSERT_NE(map_.Find(id), nullptr);
    EXPECT_EQ(ActivityOf(id), Activity::kInactive);
    map_.Remove(id);
  }
}

TEST_F(ActivityTest, WhatOneRobotLooksAtDoesNotSettleForAnothersFrames) {
  const SubmapId id = Add(Thing(true));
  PanopticFrame a = here_, b = away_;
  a.session = "a", b.session = "b";
  for (int round = 0; round < 4; ++round) {
    UpdateActivity(a, {id}, map_);
    EXPECT_EQ(Miss(id, 50, b), 0);
    EXPECT_EQ(ActivityOf(id), Activity::kActive);
    EXPECT_EQ(map_.Find(id)->info().num_frames_missed, 0);
  }
  const auto before = map_.Publish(1);
  Miss(id, 20, b);
  EXPECT_EQ(map_.Publish(2), before) << "frames that say nothing of it write nothing";
  Miss(id, 2, a);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
  Miss(id, 5, b);
  Miss(id, 1, a);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive) << "a has missed it three times";
}

TEST_F(ActivityTest, WhatSeveralLookAtSettlesWhenTheLastHasLookedAway) {
  const SubmapId id = Add(Thing(true));
  PanopticFrame a = here_, b = here_;
  a.session = "a", b.session = "b";
  UpdateActivity(a, {id}, map_);
  UpdateActivity(b, {id}, map_);
  Miss(id, 10, b);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
  Miss(id, 3, a);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive);
}

TEST_F(ActivityTest, WhatASilentRobotHasSeenLastSettlesAllTheSame) {
  const SubmapId id = Add(Thing(true));
  PanopticFrame a = here_, b = away_;
  a.session = "a", b.session = "b";
  UpdateActivity(a, {id}, map_);
  map_.mutable_info().num_frames = 1 + kMaxSilentFrames - 1;
  Miss(id, 1, b);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
  map_.mutable_info().num_frames += 1;
  Miss(id, 1, b);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive);
  EXPECT_TRUE(map_.Find(id)->info().sightings.all().empty());
}

TEST_F(ActivityTest, WhatAnotherRobotOverlooksIsNotDissolvedWhileOneLooksAtIt) {
  const SubmapId id = Add(Thing(false));
  PanopticFrame a = here_, b = here_;
  a.session = "a", b.session = "b";
  UpdateActivity(a, {id}, map_);
  EXPECT_EQ(Miss(id, 20, b), 0);
  EXPECT_EQ(ActivityOf(id), Activity::kActive);
  a.T_map_sensor = away_.T_map_sensor;  // looks elsewhere
  EXPECT_EQ(Miss(id, 3, a), 1) << "b saw past it often enough, and nobody contradicts any longer";
}

TEST_F(ActivityTest, WhatLiesWhereItIsKeptClearIsNotOverlookedUntilThatIsLifted) {
  const SubmapId id = Add(Thing(false)), beside = Add(Thing(false), {0, 3, 0});
  const BoundingSphere around{map_.Find(id)->BoundingSphereInMap().center_m, 0.3};
  ASSERT_TRUE(map_.mutable_info().kept_clear.Add({"here", around}).ok());
  EXPECT_EQ(Miss(id, 20, here_), 1) << "the one beside it";
  EXPECT_EQ(map_.Find(beside), nullptr);
  ASSERT_NE(map_.Find(id), nullptr);
  EXPECT_EQ(map_.Find(id)->info().num_frames_overlooked, 0);
  EXPECT_EQ(ActivityOf(id), Activity::kInactive) << "nobody sees it any longer";
  EXPECT_EQ(map_.Find(kUnknownSubmap)->blocks().Find({2, 0, 0}), nullptr) << "nothing is put there";
  ASSERT_TRUE(map_.mutable_info().kept_clear.Lift("here"));
  EXPECT_EQ(Miss(id, 3, here_), 1);
}

TEST_F(ActivityTest, WhatWasOverlookedBeforeItsPlaceIsKeptClearStays) {
  const SubmapId id = Add(Thing(false));
  PanopticFrame a = here_, b = here_;
  a.session = "a", b.session = "b";
  UpdateActivity(a, {id}, map_);
  EXPECT_EQ(Miss(id, 20, b), 0);
  const BoundingSphere around{map_.Find(id)->BoundingSphereInMap().center_m, 0.3};
  ASSERT_TRUE(map_.mutable_info().kept_clear.Add({"here", around}).ok());
  EXPECT_EQ(Miss(id, 20, a), 0) << "all of its points are cut out";
  EXPECT_NE(map_.Find(id), nullptr);
}

TEST_F(ActivityTest, AnUnconfirmedThingThatWasMovedStays) {
  const SubmapId id = Add(Thing(false));
  map_.FindMutable(id)->mutable_info().T_map_submap.translation().y() = 0.5;
  EXPECT_EQ(Miss(id, 20, here_), 0);
  EXPECT_NE(map_.Find(id), nullptr);
}

TEST_F(ActivityTest, BackgroundAndTheUnknownSubmapHaveNoLifeCycle) {
  SubmapInfo wall = Thing(false);
  wall.panoptic = Panoptic::kStuff;
  const SubmapId id = Add(wall);
  const auto before = map_.Publish(1);
  EXPECT_EQ(Miss(id, 20, here_), 0);
  EXPECT_EQ(UpdateActivity(here_, {id, kUnknownSubmap}, map_), 0);
  DeactivateAll(map_);
  EXPECT_EQ(map_.Publish(2), before);
}

TEST_F(ActivityTest, DeactivateAllSettlesWhatIsActiveAndLeavesTheRestAlone) {
  const SubmapId active = Add(Thing(true)), settled = Add(Thing(true));
  map_.FindMutable(settled)->mutable_info().activity = Activity::kInactive;
  map_.Publish(1);
  DeactivateAll(map_);
  EXPECT_EQ(ActivityOf(active), Activity::kInactive);
  const auto after = map_.Publish(2);
  EXPECT_EQ(after->Find(active)->info().revision, after->revision());
  EXPECT_LT(after->Find(settled)->info().revision, after->revision());
  DeactivateAll(map_);
  EXPECT_EQ(map_.Publish(3), after);
}

TEST_F(ActivityTest, DissolvingAveragesByWeightVoxelByVoxel) {
  const SubmapId id = Add(Thing(false));
  TsdfBlock& from = map_.FindMutable(id)->MutableTsdf({2, 0, 0});
  TsdfBlock& into = map_.FindMutable(kUnknownSubmap)->MutableTsdf({2, 0, 0});
  const auto set = [](TsdfBlock& block, std::size_t i, float distance_m, float weight, Color color) {
    block.distance_m[i] = distance_m, block.weight[i] = weight, block.color[i] = color;
  };
  set(from, 0, 0.08f, 1, {100, 0, 10}), set(into, 0, -0.04f, 3, {0, 200, 13});  // both
  set(from, 1, 0.05f, 2, {7, 8, 9});                                            // only the thing
  set(into, 2, -0.01f, 5, {1, 2, 3});                                           // only the unknown submap
  set(from, 3, 0.1f, 60, {}), set(into, 3, 0.0f, 60, {});                       // more than the cap
  map_.FindMutable(id)->MutableTsdf({-4, 0, 0}).weight[9] = 1;                  // a block of its own
  map_.FindMutable(id)->MutableLabels({2, 0, 0});

  ASSERT_TRUE(DissolveIntoUnknown(id, map_));
  EXPECT_EQ(map_.Find(id), nullptr);
  const Submap& unknown = *map_.Find(kUnknownSubmap);
  const TsdfBlock& merged = *unknown.blocks().Find({2, 0, 0})->tsdf;
  EXPECT_FLOAT_EQ(merged.distance_m[0], -0.01f);
  EXPECT_EQ(merged.weight[0], 4.0f);
  EXPECT_EQ(merged.color[0], (Color{25, 150, 12}));
  EXPECT_FLOAT_EQ(merged.distance_m[1], 0.05f);
  EXPECT_EQ(merged.weight[1], 2.0f);
  EXPECT_EQ(merged.color[1], (Color{7, 8, 9}));
  EXPECT_EQ(merged.distance_m[2], -0.01f);
  EXPECT_EQ(merged.weight[2], 5.0f);
  EXPECT_FLOAT_EQ(merged.distance_m[3], 0.05f);
  EXPECT_EQ(merged.weight[3], 100.0f);
  EXPECT_FALSE(merged.IsObserved(4));
  EXPECT_TRUE(unknown.blocks().Find({-4, 0, 0})->tsdf->IsObserved(9));
  EXPECT_EQ(unknown.blocks().Find({2, 0, 0})->labels, nullptr) << "labels go";
  // The sphere holds both blocks: x from -3.2 to 2.4 m.
  EXPECT_NEAR(unknown.bounding_sphere().center_m.x(), -0.4, 1e-9);
}

TEST_F(ActivityTest, OnlySubmapsOnTheMapsGridDissolve) {
  SubmapInfo moved = Thing(false), finer = Thing(false);
  moved.T_map_submap.translation().x() = 1e-3;
  finer.voxel_size_m = 0.05;
  const SubmapId moved_id = Add(moved), finer_id = Add(finer), gone = Add(Thing(false));
  map_.Remove(gone);
  const auto before = map_.Publish(1);
  for (const SubmapId id : {moved_id, finer_id, gone, kUnknownSubmap, SubmapId(999)}) {
    EXPECT_FALSE(DissolveIntoUnknown(id, map_));
  }
  EXPECT_EQ(map_.Publish(2), before) << "nothing was written";
}

TEST_F(ActivityTest, WhatIsContradictedMakesPlaceAndComesOnlyWhereThereIsNothingElse) {
  const BlockIndex block{2, 0, 0};
  const SubmapId id = Add(Thing(false), block);
  const auto set = [&](Submap& submap, int linear, float weight, bool is_contradicted) {
    submap.MutableTsdf(block).weight[static_cast<std::size_t>(linear)] = weight;
    if (is_contradicted) submap.MutableGone(block).Set(linear, GoneBlock::kContradicted);
  };
  Submap& thing = *map_.FindMutable(id);
  Submap& unknown = *map_.FindMutable(kUnknownSubmap);
  set(thing, 1, 2, true), set(unknown, 1, 5, false);  // the unknown one's stays
  set(thing, 2, 2, true);                             // comes, and stays contradicted
  set(thing, 3, 2, false), set(unknown, 3, 5, true);  // takes the place
  set(thing, 4, 2, false), set(unknown, 4, 5, false);
  EXPECT_TRUE(DissolveIntoUnknown(id, map_));
  const BlockEntry& merged = *map_.Find(kUnknownSubmap)->blocks().Find(block);
  const auto expect = [&](int linear, float weight, bool is_contradicted) {
    EXPECT_EQ(merged.tsdf->weight[static_cast<std::size_t>(linear)], weight) << linear;
    EXPECT_EQ(merged.IsContradicted(linear), is_contradicted) << linear;
  };
  expect(1, 5, false);
  expect(2, 2, true);
  expect(3, 2, false);
  expect(4, 7, false);
}

}  // namespace
}  // namespace dhpmap
