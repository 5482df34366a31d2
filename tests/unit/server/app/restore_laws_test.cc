// SPDX-License-Identifier: BSD-3-Clause
// Laws of restoring a revision, over random sequences of frames, refinements and edits.
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/server/app/edited_room.h"
#include "tests/unit/server/app/map_laws.h"

namespace dhpmap {
namespace {

using testing::AreSameButForNumbers;
using testing::EditedRoom;
using testing::IdsAreInOrder;
using testing::MapsAreEqual;
using testing::NumSharedPositions;
using testing::SpheresHoldWhatWasObserved;
using testing::WithoutEdits;
using StatePtr = std::shared_ptr<const MapSnapshot>;

/// The present map with everything that a restore of a past state brings back.
StatePtr ComeBack(const MapSnapshot& past, const MapSnapshot& now) {
  MapInfo info = now.info();
  info.display_name = past.info().display_name;
  info.merged = past.info().merged;
  info.pairs = past.info().pairs;
  info.kept_clear = past.info().kept_clear;
  return std::make_shared<const MapSnapshot>(std::move(info), past.submaps(), now.free_space(),
                                             VacatedSpace{past.vacated()});
}

class RestoreLaws : public ::testing::TestWithParam<EditedRoom::Store> {
 protected:
  std::uint32_t Below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

  void Frame() {
    const testing::RoomView view{.place = static_cast<int>(Below(testing::kNumPlaces)), .has_crate = Below(4) != 0};
    const Status taken = room_.Integrate(view, /*has_persistent_ids=*/false);
    ASSERT_TRUE(taken.ok()) << taken.ToString();
  }

  void Finish() {
    const Status finished = room_.Finish();
    ASSERT_TRUE(finished.ok()) << finished.ToString();
    EXPECT_EQ(NumSharedPositions(*room_.Now()), 0) << "each position is held once, wherever the map came from";
    Remember();
  }

  /// Of a thing; nothing if there is none.
  std::optional<Edit> DrawEdit() {
    std::vector<const Submap*> things;
    const StatePtr now = room_.Now();
    for (const auto& submap : now->submaps()) {
      if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap.get());
    }
    if (things.empty()) return std::nullopt;
    const Submap& thing = *things[Below(static_cast<std::uint32_t>(things.size()))];
    const SubmapId other = things[Below(static_cast<std::uint32_t>(things.size()))]->id();
    const Eigen::Vector3d center_m = thing.BoundingSphereInMap().center_m;
    Edit edit{.target = thing.id(), .etag = {}, .action = DeleteEdit{}};
    SubmapPatch patch;
    switch (Below(7)) {
      case 0: patch.T_map_submap = Transform(Eigen::Translation3d(0.1 * Below(5), 0, 0.3)); break;
      case 1: patch.display_name = "name " + std::to_string(Below(5)); break;
      case 2: edit.action = CloneEdit{}; return edit;
      case 3: edit.action = MergeEdit{{other}}; return edit;
      case 4: edit.action = SplitEdit{SplitByPlane{center_m, Eigen::Vector3d::UnitX()}}; return edit;
      case 5: edit.action = ClearEdit{BoundingSphere{center_m, 0.2}, {}}; return edit;
      default: return edit;
    }
    edit.action = PatchEdit{patch};
    return edit;
  }

  void EditSomething() {
    const std::optional<Edit> edit = DrawEdit();
    if (!edit) return;
    if (room_.Make({.edits = {*edit}}, "anna").ok()) Remember();
  }

  void RestoreSomething() {
    ASSERT_FALSE(stored_.empty());
    auto past = stored_.begin();
    std::advance(past, Below(static_cast<std::uint32_t>(stored_.size())));
    const StatePtr before = room_.Now();
    const auto restored = room_.Restore({.revision = past->first}, "carl");
    if (restored.status().reason() == Reason("REVISION_NOT_KEPT")) return;  // for want of room: there are many
    ASSERT_TRUE(restored.ok()) << restored.status().ToString();
    const StatePtr after = room_.Now();
    EXPECT_TRUE(AreSameButForNumbers(*ComeBack(*past->second, *after), *after, {}))
        << "revision " << past->first << ", from " << before->revision();
    ++num_restored_;
    Remember();
    if (*restored == before->revision() || Below(2) == 0) return;
    const auto undone = room_.Undo({.author = "carl"});
    ASSERT_TRUE(undone.ok()) << undone.status().ToString();
    EXPECT_TRUE(MapsAreEqual(*WithoutEdits(*before), *WithoutEdits(*room_.Now()), rounding_m_, rounding_share_))
        << "the undo of a restoration from " << before->revision() << " to " << past->first;
    EXPECT_TRUE(before->info().merged == room_.Now()->info().merged);
    ++num_undone_;
    Remember();
  }

  /// Records the present state, which is stored.
  void Remember() { stored_[room_.Now()->revision()] = room_.Now(); }

  void ExpectLaws() {
    const StatePtr now = room_.Now();
    EXPECT_TRUE(IdsAreInOrder(*now));
    EXPECT_TRUE(SpheresHoldWhatWasObserved(*now));
    EXPECT_GE(now->revision(), last_revision_);
    EXPECT_GE(now->info().next_submap_id, last_next_id_);
    EXPECT_GE(now->info().num_frames, last_frames_);
    last_revision_ = now->revision();
    last_next_id_ = now->info().next_submap_id;
    last_frames_ = now->info().num_frames;
    for (const MergedId& merged : now->info().merged.list()) EXPECT_EQ(now->Find(merged.merged), nullptr);
  }

  std::mt19937 random_{29};
  EditedRoom room_{GetParam()};
  const bool rounds_ = GetParam() == EditedRoom::Store::kSqlite;  // what an undo reads from the database
  const double rounding_m_ = rounds_ ? testing::EditedRoomInfo().config.truncation_m / 4096 : 0;
  const double rounding_share_ = rounds_ ? 1e-4 : 0;
  std::map<std::int64_t, StatePtr> stored_;
  std::int64_t last_revision_ = 0, last_frames_ = 0;
  SubmapId last_next_id_{0};
  int num_restored_ = 0, num_undone_ = 0;
};

TEST_P(RestoreLaws, HoldOverFramesRefinementsEditsAndRestorations) {
  for (int frame = 0; frame < 6; ++frame) ASSERT_NO_FATAL_FAILURE(Frame());
  ASSERT_TRUE(room_.Flush().ok());
  Remember();
  for (int step = 0; step < 60; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const std::uint32_t dice = Below(100);
    if (dice < 40) ASSERT_NO_FATAL_FAILURE(Frame());
    else if (dice < 70) EditSomething();
    else if (dice < 75) ASSERT_NO_FATAL_FAILURE(Finish());
    else ASSERT_NO_FATAL_FAILURE(RestoreSomething());
    ExpectLaws();
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GE(num_restored_, 5);
  EXPECT_GE(num_undone_, 1);
}

INSTANTIATE_TEST_SUITE_P(Stores, RestoreLaws, ::testing::Values(EditedRoom::Store::kMemory, EditedRoom::Store::kSqlite),
                         [](const auto& store) {
                           return store.param == EditedRoom::Store::kMemory ? "Memory" : "Sqlite";
                         });

}  // namespace
}  // namespace dhpmap
