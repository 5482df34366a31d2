// SPDX-License-Identifier: BSD-3-Clause
// A refinement that began before an edit leaves what was edited alone.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "mapping/refinement/adopt_refinement.h"
#include "mapping/refinement/refine_map.h"
#include "mapping/refinement/refinement_round.h"
#include "mapping/refinement/region_part.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

using testing::AddSubmap;
using testing::Put;
using testing::SubmapsAreEqual;
using testing::Sum;

constexpr std::array kHere = {SubmapId(1), SubmapId(2)}, kThere = {SubmapId(3), SubmapId(4)};
constexpr int kApart_vox = 160;

/// Two places far apart. In each a settled thing holds a block, and another one, which has seen its half more often,
/// that half.
Map TwoPlaces() {
  Map map(testing::RandomMapInfo());
  map.mutable_info().config.refinement.crf = false;  // label management alone says what becomes of them
  for (const int x : {0, kApart_vox}) {
    Submap &whole = AddSubmap(map), &half = AddSubmap(map);
    for (int i = 0; i < kBlockVoxels; ++i) {
      const VoxelIndex in_block = VoxelIn({0, 0, 0}, i), v{in_block.x + x, in_block.y, in_block.z};
      const float distance_m = 0.01f * static_cast<float>(v.y - 4);
      Put(whole, v, distance_m, 1.0f, {{{1, 3}}, {{kOwnInstance, 3}}});
      if (v.z < 4) Put(half, v, distance_m, 1.0f, {{{2, 7}}, {{kOwnInstance, 7}}});
    }
    for (Submap* submap : {&whole, &half}) {
      submap->mutable_info().activity = Activity::kInactive;
      submap->UpdateBoundingSphere();
    }
  }
  return map;
}

/// What edits of a row set, but for the revision.
struct RowEdit {
  const char* name;
  void (*make)(SubmapInfo&);
};
constexpr RowEdit kRowEdits[] = {
    {"relabelled",
     [](SubmapInfo& info) {
       info.class_id = ClassId(2);
       info.class_is_fixed = true;
     }},
    {"renamed", [](SubmapInfo& info) { info.display_name = "grandfather's chair"; }},
    {"marked absent", [](SubmapInfo& info) { info.presence = Presence::kAbsent; }},
    {"locked", [](SubmapInfo& info) { info.is_locked = true; }},
    {"locked and unlocked", [](SubmapInfo& info) { info.is_locked = false; }},
    {"moved",
     [](SubmapInfo& info) {
       info.T_map_submap.translation().x() = 1.0;
       info.is_placed = true;
     }},
    {"moved to where it is", [](SubmapInfo& info) { info.is_placed = true; }},
    {"edited and undone", [](SubmapInfo&) {}},
};

void MakeEdit(const RowEdit& edit, SubmapId id, Map& map) {
  SubmapInfo& info = map.FindMutable(id)->mutable_info();
  edit.make(info);
  info.edited_revision = map.info().revision + 1;  // as the server's edits and their undoing do
}

/// Of two places, a refinement that is under way.
class EditedMeanwhile : public ::testing::Test {
 protected:
  /// Begins with what the map is now.
  void BeginRefinement() {
    const auto before = map_.Freeze();
    Map side(before);
    ThreadPool pool(1);
    RefineMap(side, pool);
    refined_ = side.Freeze();
    outcome_ = OutcomeOf(std::make_shared<const StateMarks>(*before), *refined_);
    for (const auto& [id, old] : outcome_.before->submaps()) {
      if (id == kUnknownSubmap) continue;
      ASSERT_NE(refined_->Find(id), nullptr);
      ASSERT_FALSE(SubmapsAreEqual(*before->Find(id), *refined_->Find(id))) << "nothing to take over";
    }
  }
  void ExpectAsIn(const MapSnapshot& state, std::array<SubmapId, 2> ids) {
    for (const SubmapId id : ids) {
      ASSERT_NE(map_.Find(id), nullptr);
      EXPECT_TRUE(SubmapsAreEqual(*state.Find(id), *map_.Find(id))) << "submap " << id.value;
    }
  }

  Map map_ = TwoPlaces();
  std::shared_ptr<const MapSnapshot> refined_;
  RefinementOutcome outcome_;
};

TEST_F(EditedMeanwhile, AnObjectKeepsTheEditAndItsVoxelsAndOthersAreRefined) {
  for (const RowEdit& edit : kRowEdits) {
    for (const SubmapId id : kHere) {
      SCOPED_TRACE(::testing::Message() << "submap " << id.value << " was " << edit.name);
      map_ = TwoPlaces();
      ASSERT_NO_FATAL_FAILURE(BeginRefinement());
      MakeEdit(edit, id, map_);
      const auto now = map_.Freeze();
      const auto sum = Sum(map_);
      EXPECT_GT(AdoptRefinement(outcome_, map_), 0);
      ExpectAsIn(*now, kHere);
      ExpectAsIn(*refined_, kThere);
      EXPECT_EQ(Sum(map_), sum);
    }
  }
}

TEST_F(EditedMeanwhile, WhatAnEditFromBeforeLeftIsTakenOver) {
  MakeEdit(kRowEdits[0], kHere[0], map_);
  ASSERT_NO_FATAL_FAILURE(BeginRefinement());
  EXPECT_EQ(AdoptRefinement(outcome_, map_), 0);
  ExpectAsIn(*refined_, kHere);
  ExpectAsIn(*refined_, kThere);
}

TEST_F(EditedMeanwhile, FramesAreNoEdits) {
  ASSERT_NO_FATAL_FAILURE(BeginRefinement());
  Submap& seen = *map_.FindMutable(kHere[0]);
  Put(seen, {40, 0, 0}, 0.01f, 1.0f, {{{1, 1}}, {{kOwnInstance, 1}}});  // elsewhere
  seen.mutable_info().num_frames_observed += 1;
  seen.mutable_info().last_observed_ns += 1;
  seen.mutable_info().activity = Activity::kActive;
  EXPECT_EQ(AdoptRefinement(outcome_, map_), 0);
  const BlockIndex here{0, 0, 0};
  for (const SubmapId id : kHere) {
    EXPECT_EQ(map_.Find(id)->blocks().Find(here)->tsdf, refined_->Find(id)->blocks().Find(here)->tsdf);
  }
}

TEST_F(EditedMeanwhile, WhatWasLeftIsRefinedInTheNextRound) {
  ThreadPool pool(1);
  RefinementRound round;
  std::shared_ptr<const MapSnapshot> first;
  for (const bool is_edited : {true, false}) {
    const auto state = map_.Freeze();
    round.Begin(*state, 1);
    ASSERT_FALSE(round.IsFinished());
    const RegionPart part = round.NextPart();
    Map side = GoOnFrom(*state, part);
    round.RefineNext(side, pool);
    const auto refined = side.Freeze();
    if (is_edited) first = refined;
    if (is_edited) MakeEdit(kRowEdits[1], kHere[0], map_);
    const auto num_left = AdoptRefinement(OutcomeOf(round.pending().marks(), *refined, part), map_);
    EXPECT_EQ(num_left > 0, is_edited);
    round.End(*refined, part);
  }
  Submap expected = *first->Find(kHere[0]);
  expected.mutable_info().display_name = map_.Find(kHere[0])->info().display_name;
  expected.mutable_info().edited_revision = map_.Find(kHere[0])->info().edited_revision;
  EXPECT_FALSE(expected.info().display_name.empty());
  EXPECT_TRUE(SubmapsAreEqual(expected, *map_.Find(kHere[0])));
  EXPECT_TRUE(SubmapsAreEqual(*first->Find(kHere[1]), *map_.Find(kHere[1])));
}

}  // namespace
}  // namespace dhpmap
