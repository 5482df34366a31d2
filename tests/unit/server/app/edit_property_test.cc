// SPDX-License-Identifier: BSD-3-Clause
// Laws that hold over random sequences of frames, refinements, edits, undos and restarts.
#include <algorithm>
#include <cstdlib>
#include <deque>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/server/app/edited_room.h"
#include "tests/unit/server/app/live_answers.h"
#include "tests/unit/server/app/map_laws.h"

namespace dhpmap {
namespace {

using testing::AreSame;
using testing::AreSameButForNumbers;
using testing::EditedRoom;
using testing::HasContradictedVoxel;
using testing::IdsAreInOrder;
using testing::LockedAreLeftAlone;
using testing::NumSharedPositions;
using testing::PlacedHaveTheirVoxels;
using testing::SpheresHoldWhatWasObserved;
using testing::StoreRounding;
using testing::TotalsOf;
using testing::VoxelTotals;
using SnapshotPtr = std::shared_ptr<const MapSnapshot>;

/// One run of the sequence.
struct Sequence {
  const char* name;
  EditedRoom::Store store;
  bool has_persistent_ids;
  unsigned seed;
};
constexpr Sequence kSequences[] = {{"MemoryPerFrameIds", EditedRoom::Store::kMemory, false, 3},
                                   {"MemoryPersistentIds", EditedRoom::Store::kMemory, true, 5},
                                   {"SqlitePerFrameIds", EditedRoom::Store::kSqlite, false, 7},
                                   {"SqlitePersistentIds", EditedRoom::Store::kSqlite, true, 11}};
/// Repeats one of the sequences; it makes the same map.
constexpr Sequence kPagedSequences[] = {{"PerFrameIds", EditedRoom::Store::kPaged, false, 7}};

/// Over all sequences; a soak test sets more.
int NumPropertySteps() {
  constexpr int kInCi = 500;
  const char* text = std::getenv("DHPMAP_PROPERTY_STEPS");
  return text != nullptr ? std::max(1, std::atoi(text)) : kInCi;
}

/// More things make steps slow without testing more.
constexpr std::size_t kMostThings = 12;

enum class Ask {
  kMove,
  kMoveInPlace,
  kClone,
  kCloneInPlace,
  kDelete,
  kRelabel,
  kRename,
  kMerge,
  kSplitByBox,
  kSplitByPlane,
  kSplitByParts,
  kClearBox,
  kClearSphere,
  kClearAndKeep,
  kLock,
  kUnlock,
  kAbsent,
  kPresent,
  kKeepClear,
  kLift,
};
constexpr std::uint32_t kNumAsks = static_cast<std::uint32_t>(Ask::kLift) + 1;

/// Draws random edits; they depend on the seed only.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed) {}

  std::uint32_t Below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double Between(double low, double high) { return low + (high - low) * Below(1000) / 1000.0; }

  /// An edit of an object of the map; nothing if no object suits it.
  std::optional<Edit> Draw(Ask ask, const MapSnapshot& map) {
    const Submap* object = DrawObject(map, ask);
    if (object == nullptr) return std::nullopt;
    const Eigen::Vector3d center_m = object->BoundingSphereInMap().center_m;
    const auto on = [object](decltype(Edit::action) action) {
      return Edit{.target = object->id(), .etag = {}, .action = std::move(action)};
    };
    const auto of_map = [](decltype(Edit::action) action) {
      return Edit{.target = std::nullopt, .etag = {}, .action = std::move(action)};
    };
    SubmapPatch patch;
    switch (ask) {
      case Ask::kMove: patch.T_map_submap = DrawPose(); return on(PatchEdit{patch});
      case Ask::kMoveInPlace: patch.T_map_submap = object->info().T_map_submap; return on(PatchEdit{patch});
      case Ask::kClone: patch.T_map_submap = DrawPose(); return on(CloneEdit{patch});
      case Ask::kCloneInPlace: return on(CloneEdit{});
      case Ask::kDelete: return on(DeleteEdit{});
      case Ask::kRelabel: patch.class_id = DrawClass(object->info()); return on(PatchEdit{patch});
      case Ask::kRename: patch.display_name = "name " + std::to_string(Below(5)); return on(PatchEdit{patch});
      case Ask::kMerge: return on(MergeEdit{{DrawPartner(*object, map)}});
      case Ask::kSplitByBox: return on(SplitEdit{SplitByBox{BoxAround(center_m)}});
      case Ask::kSplitByPlane: return on(SplitEdit{SplitByPlane{center_m, DrawDirection()}});
      case Ask::kSplitByParts: return on(SplitEdit{SplitByParts{.least_voxels = 4, .most_parts = 3}});
      case Ask::kClearBox: return of_map(ClearEdit{BoxAround(center_m), DrawClasses()});
      case Ask::kClearSphere: return on(ClearEdit{SphereAround(center_m), {}});
      case Ask::kClearAndKeep: return of_map(ClearEdit{SphereAround(center_m), {}, DrawRegionName()});
      case Ask::kLock: patch.is_locked = true; return on(PatchEdit{patch});
      case Ask::kUnlock: patch.is_locked = false; return on(PatchEdit{patch});
      case Ask::kAbsent: return on(PresenceEdit{Presence::kAbsent});
      case Ask::kPresent: return on(PresenceEdit{Presence::kPresent});
      case Ask::kKeepClear: return of_map(KeepClearEdit{{DrawRegionName(), BoxAround(center_m)}});
      case Ask::kLift: return of_map(LiftEdit{DrawRegionName()});
    }
    return std::nullopt;
  }

 private:
  /// Usually a thing, and one that the edit can change, if there is one.
  const Submap* DrawObject(const MapSnapshot& map, Ask ask) {
    std::vector<const Submap*> all, fitting;
    all.reserve(map.submaps().size());
    fitting.reserve(map.submaps().size());
    const bool may_be_stuff = Below(6) == 0;
    for (const auto& submap : map.submaps()) {
      const SubmapInfo& info = submap->info();
      if (info.panoptic == Panoptic::kUnknown || (info.panoptic == Panoptic::kStuff && !may_be_stuff)) continue;
      all.push_back(submap.get());
      const bool fits = ask == Ask::kUnlock ? info.is_locked : ask != Ask::kPresent || submap->IsAbsent();
      if (fits) fitting.push_back(submap.get());
    }
    const std::vector<const Submap*>& those = fitting.empty() ? all : fitting;
    return those.empty() ? nullptr : those[Below(static_cast<std::uint32_t>(those.size()))];
  }
  /// An object at the same place, if there is one.
  SubmapId DrawPartner(const Submap& object, const MapSnapshot& map) {
    std::vector<SubmapId> all, fitting;
    all.reserve(map.submaps().size());
    fitting.reserve(map.submaps().size());
    for (const auto& submap : map.submaps()) {
      if (submap->id() == object.id()) continue;
      all.push_back(submap->id());
      const bool fits = submap->info().panoptic == Panoptic::kThing &&
                        submap->info().T_map_submap.matrix() == object.info().T_map_submap.matrix();
      if (fits) fitting.push_back(submap->id());
    }
    const std::vector<SubmapId>& those = fitting.empty() || Below(8) == 0 ? all : fitting;
    return those[Below(static_cast<std::uint32_t>(those.size()))];
  }
  /// Uses braces, because function arguments may be evaluated in any order.
  Eigen::Vector3d DrawVector(double low, double high) {
    return {Between(low, high), Between(low, high), Between(low, high)};
  }
  Transform DrawPose() {
    const Eigen::Vector3d by_m = DrawVector(-0.5, 0.5);
    return Eigen::Translation3d(by_m) * Eigen::AngleAxisd(Between(-3, 3), Eigen::Vector3d::UnitZ());
  }
  ClassId DrawClass(const SubmapInfo& info) {
    const std::uint32_t first = info.panoptic == Panoptic::kThing ? 1 : 4, num = first == 1 ? 3 : 2;
    return ClassId(static_cast<std::uint16_t>(first + Below(num)));
  }
  std::vector<ClassId> DrawClasses() {
    if (Below(2) == 0) return {};
    return {ClassId(static_cast<std::uint16_t>(1 + Below(5)))};
  }
  Eigen::Vector3d DrawDirection() { return {Between(-1, 1), Between(-1, 1), Between(0.1, 1)}; }
  std::string DrawRegionName() { return std::string(1, static_cast<char>('a' + Below(3))); }
  Eigen::AlignedBox3d BoxAround(const Eigen::Vector3d& center_m) {
    const Eigen::Vector3d half_m = DrawVector(0.05, 0.3);
    const Eigen::Vector3d at_m = center_m + 0.3 * DrawDirection();
    return {at_m - half_m, at_m + half_m};
  }
  BoundingSphere SphereAround(const Eigen::Vector3d& center_m) {
    return {center_m + 0.3 * DrawDirection(), Between(0.1, 0.4)};
  }

  std::mt19937 random_;
};

/// Runs the steps and checks the laws after each.
class EditProperty : public ::testing::TestWithParam<Sequence> {
 protected:
  void Run(int num_steps) {
    for (int frame = 0; frame < 6; ++frame) ASSERT_NO_FATAL_FAILURE(Frame());
    for (int step = 0; step < num_steps; ++step) {
      if (step % 40 == 39) Finish();
      else if (step % 25 == 24) Restart();
      else RandomStep();
      ExpectLaws();
      ExpectAnswers(step);
      if (!HasFailure()) continue;
      std::string told;
      for (const std::string& line : steps_) told += "\n  " + line;
      FAIL() << "seed " << GetParam().seed << ", step " << step << ", after" << told;
    }
  }

  void RandomStep() {
    const std::uint32_t dice = edits_.Below(100);
    if (dice < 38) Frames();
    else if (dice < 50) UndoSomething();
    else if (dice < 53) UndeleteSomething();
    else EditSomething();
  }

  void Frames() {
    for (std::uint32_t n = 1 + edits_.Below(3); n > 0 && !HasFailure(); --n) Frame();
  }
  void Frame() {
    const testing::RoomView view{.place = static_cast<int>(edits_.Below(testing::kNumPlaces)),
                                 .has_crate = edits_.Below(4) != 0,
                                 .has_other_class = edits_.Below(5) == 0};
    Tell("frame from " + std::to_string(view.place) + (view.has_crate ? "" : " without the crate") +
         (view.has_other_class ? " with another class" : ""));
    const SnapshotPtr before = room_.Now();
    const Status taken = room_.Integrate(view, GetParam().has_persistent_ids);
    ASSERT_TRUE(taken.ok()) << taken.ToString();
    EXPECT_EQ(room_.Now()->info().num_frames, before->info().num_frames + 1);
    EXPECT_TRUE(LockedAreLeftAlone(*before, *room_.Now()));
    EXPECT_TRUE(room_.Now()->info().kept_clear == before->info().kept_clear);
  }

  void Finish() {
    Tell("finish");
    const SnapshotPtr before = room_.Now();
    const Status finished = room_.Finish();
    ASSERT_TRUE(finished.ok()) << finished.ToString();
    const SnapshotPtr after = room_.Now();
    EXPECT_TRUE(LockedAreLeftAlone(*before, *after));
    EXPECT_TRUE(PlacedHaveTheirVoxels(*before, *after));
    EXPECT_EQ(NumSharedPositions(*after), 0) << "each position is held once";
    // Refinement hands observations over. Labels go with what is dissolved into the unknown submap, and with voxels
    // that are no longer there when something else is put in their place.
    const std::uint64_t num_before = TotalsOf(*before).num_observations, num_after = TotalsOf(*after).num_observations;
    EXPECT_LE(num_after, num_before);
    if (after->submaps().size() == before->submaps().size() && !HasContradictedVoxel(*before)) {
      EXPECT_EQ(num_after, num_before);
    }
    ++num_finished_;
  }

  void Restart() {
    Tell("restart");
    const Status flushed = room_.Flush();
    ASSERT_TRUE(flushed.ok()) << flushed.ToString();
    const SnapshotPtr before = room_.Now();
    const auto log_before = room_.store().ListEdits("room", {.max_edits = 1000});
    for (const auto& submap : before->submaps()) {  // to compare with: without its store nothing more can be read
      const auto blocks = submap->blocks().entries();
      EXPECT_EQ(std::distance(blocks.begin(), blocks.end()), static_cast<std::ptrdiff_t>(submap->blocks().size()));
    }
    room_.Restart();
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_TRUE(AreSame(*before, *room_.Now(), rounding_));
    const auto log_after = room_.store().ListEdits("room", {.max_edits = 1000});
    ASSERT_TRUE(log_before.ok() && log_after.ok());
    ASSERT_EQ(log_before->size(), log_after->size());
    for (std::size_t i = 0; i < log_after->size(); ++i) {
      const LoggedEdit &a = (*log_before)[i], &b = (*log_after)[i];
      EXPECT_TRUE(a.entry.revision == b.entry.revision && a.entry.summary == b.entry.summary &&
                  a.is_undone == b.is_undone && a.is_kept == b.is_kept);
    }
    const auto report = room_.store().VerifyMap("room", false, {});
    ASSERT_TRUE(report.ok()) << report.status().ToString();
    for (const MapFault& fault : report->faults) ADD_FAILURE() << fault.place << " " << fault.what;
    ++num_restarts_;
  }

  void EditSomething() {
    const SnapshotPtr before = room_.Now();
    const bool is_crowded = before->submaps().size() > kMostThings;
    const auto ask = is_crowded ? Ask::kDelete : static_cast<Ask>(edits_.Below(kNumAsks));
    EditList list;
    for (std::uint32_t n = edits_.Below(6) == 0 ? 3 : 1; n > 0; --n) {
      const Ask next = list.edits.empty() ? ask : static_cast<Ask>(edits_.Below(kNumAsks));
      if (auto edit = edits_.Draw(next, *before)) list.edits.push_back(*std::move(edit));
      told_asks_ += " " + std::to_string(static_cast<int>(next));
    }
    if (list.edits.empty()) return;
    Tell("edit" + std::exchange(told_asks_, {}) + " of " + NameOf(list.edits.front()));
    const auto made = room_.Make(list, DrawAuthor());
    const SnapshotPtr after = room_.Now();
    if (!made.ok() || made->revision == before->revision()) {
      if (!made.ok()) Tell("  refused: " + made.status().ToString());
      EXPECT_NE(made.status().code(), StatusCode::kInternal) << made.status().ToString();
      EXPECT_TRUE(AreSame(*before, *after, {})) << "nothing has happened";
      return;
    }
    ++num_made_[ask];
    if (std::none_of(list.edits.begin(), list.edits.end(), MayShareMore)) {
      EXPECT_LE(NumSharedPositions(*after), NumSharedPositions(*before)) << "no edit puts two things in one place";
    }
    if (list.edits.size() == 1) ExpectCounts(list.edits.front(), made->results.front(), *before, *after);
    // Who holds a paged state keeps its voxels in memory, and can read no more of it after a restart.
    if (GetParam().store != EditedRoom::Store::kPaged) last_edit_ = {made->revision, before};
    if (edits_.Below(2) == 0) {
      UndoAtOnce(made->revision, before, after);
    } else if (edits_.Below(10) == 0) {
      Restart();
      if (!HasFatalFailure()) UndoTheLast();
    }
  }

  /// Whether refinement may later have voxels that it did not write before, or that it did not know to be there. All
  /// other edits only remove voxels from it, or divide its voxels.
  static bool MayShareMore(const Edit& edit) {
    if (const auto* patch = ActionIf<PatchEdit>(edit)) return patch->patch.is_locked == false;
    if (const auto* presence = ActionIf<PresenceEdit>(edit)) return presence->presence == Presence::kPresent;
    return ActionIf<MergeEdit>(edit) != nullptr;
  }

  /// Checks the numbers of voxels and observations that the edit guarantees.
  void ExpectCounts(const Edit& edit, const EditResult& result, const MapSnapshot& before, const MapSnapshot& after) {
    VoxelTotals expected = TotalsOf(before);
    const VoxelTotals found = TotalsOf(after);
    if (ActionIf<MergeEdit>(edit) != nullptr) {
      EXPECT_EQ(found.num_observations, expected.num_observations);
      EXPECT_LE(found.num_known, expected.num_known);
      return;
    }
    if (ActionIf<ClearEdit>(edit) != nullptr) {
      EXPECT_EQ(found.num_known + result.num_voxels, expected.num_known);
      EXPECT_LE(found.num_observations, expected.num_observations);
      return;
    }
    for (const SubmapId id : result.removed) {
      expected.num_known -= TotalsOf(*before.Find(id)).num_known;
      expected.num_observations -= TotalsOf(*before.Find(id)).num_observations;
    }
    if (ActionIf<CloneEdit>(edit) != nullptr) {
      const VoxelTotals original = TotalsOf(*before.Find(std::get<SubmapId>(*edit.target)));
      EXPECT_EQ(TotalsOf(*after.Find(result.created.at(0))), original);
      expected.num_known += original.num_known;
      expected.num_observations += original.num_observations;
    }
    EXPECT_EQ(found, expected) << "all others hand voxels on, or touch none";
  }

  /// An undo restores the map before the edit, and a redo the map after it.
  void UndoAtOnce(std::int64_t revision, const SnapshotPtr& before, const SnapshotPtr& after) {
    Tell("  undone at once");
    const auto undone = room_.Undo({.edit = revision, .author = "anna"});
    ASSERT_TRUE(undone.ok()) << undone.status().ToString();
    EXPECT_TRUE(AreSameButForNumbers(*before, *room_.Now(), rounding_)) << "the undo of edit " << revision;
    ++num_undone_at_once_;
    if (edits_.Below(2) == 0) return;
    Tell("  and done again");
    const auto redone = room_.Undo({.kind = EditKind::kRedo, .edit = revision, .author = "anna"});
    ASSERT_TRUE(redone.ok()) << redone.status().ToString();
    EXPECT_TRUE(AreSameButForNumbers(*after, *room_.Now(), rounding_)) << "the redo of edit " << revision;
  }

  /// Undoes the last edit; nothing has changed the map since, but the server may have restarted.
  void UndoTheLast() {
    if (last_edit_.before == nullptr) return;
    Tell("undo of edit " + std::to_string(last_edit_.revision) + ", the last of all");
    const auto undone = room_.Undo({.edit = last_edit_.revision, .author = DrawAuthor()});
    ASSERT_TRUE(undone.ok()) << undone.status().ToString();
    EXPECT_TRUE(AreSameButForNumbers(*last_edit_.before, *room_.Now(), rounding_)) << "what it was before that edit";
    ++num_undone_;
  }

  /// Undoes an author's last edits, or any one edit, completely or not at all.
  void UndoSomething() {
    if (last_edit_.before != nullptr && room_.Now()->revision() == last_edit_.revision && edits_.Below(2) == 0) {
      UndoTheLast();
      return;
    }
    UndoRequest request{.kind = edits_.Below(3) == 0 ? EditKind::kRedo : EditKind::kUndo,
                        .edit = std::nullopt,
                        .count = 1 + edits_.Below(2),
                        .author = DrawAuthor()};
    const auto log = room_.store().ListEdits("room", {.max_edits = 12});
    ASSERT_TRUE(log.ok()) << log.status().ToString();
    if (edits_.Below(2) == 0 && !log->empty()) {
      request.edit = (*log)[edits_.Below(static_cast<std::uint32_t>(log->size()))].entry.revision;
    }
    Tell(std::string(request.kind == EditKind::kRedo ? "redo" : "undo") +
         (request.edit ? " of edit " + std::to_string(*request.edit) : " of the last of " + request.author));
    ExpectDoneOrUntouched([&] { return room_.Undo(request); });
  }

  void UndeleteSomething() {
    const auto log = room_.store().ListEdits("room", {.max_edits = 20});
    ASSERT_TRUE(log.ok()) << log.status().ToString();
    std::vector<SubmapId> removed;
    for (const LoggedEdit& edit : *log) {
      removed.insert(removed.end(), edit.entry.summary.removed.begin(), edit.entry.summary.removed.end());
    }
    if (removed.empty()) return;
    const SubmapId id = removed[edits_.Below(static_cast<std::uint32_t>(removed.size()))];
    Tell("undelete " + std::to_string(id.value));
    ExpectDoneOrUntouched([&] { return room_.Undelete(id, DrawAuthor()); });
  }

  template <typename Call>
  void ExpectDoneOrUntouched(Call&& call) {
    const SnapshotPtr before = room_.Now();
    const Result<std::int64_t> revision = call();
    if (revision.ok()) {
      EXPECT_EQ(*revision, before->revision() + 1);
      ++num_undone_;
      return;
    }
    Tell("  refused: " + revision.status().ToString());
    const Reason allowed[] = {Reason("NOTHING_TO_UNDO"), Reason("NOTHING_TO_REDO"), Reason("UNDO_CONFLICT"),
                              Reason("UNDO_NOT_KEPT"),   Reason("MERGED_INTO"),     Reason("SUBMAP_NOT_FOUND")};
    const bool is_allowed = std::any_of(std::begin(allowed), std::end(allowed),
                                        [&](const Reason& reason) { return revision.status().reason() == reason; });
    EXPECT_TRUE(is_allowed) << revision.status().ToString();
    EXPECT_TRUE(AreSame(*before, *room_.Now(), {})) << "nothing has happened";
  }

  void ExpectLaws() {
    const SnapshotPtr now = room_.Now();
    EXPECT_TRUE(IdsAreInOrder(*now));
    EXPECT_TRUE(SpheresHoldWhatWasObserved(*now));
    EXPECT_GE(now->revision(), last_revision_) << "revisions only grow";
    EXPECT_GE(now->info().next_submap_id, last_next_id_) << "ids are never given out twice";
    last_revision_ = now->revision();
    last_next_id_ = now->info().next_submap_id;
    for (const MergedId& merged : now->info().merged.list()) {
      EXPECT_EQ(now->Find(merged.merged), nullptr) << merged.merged.value << " is a part of another";
    }
  }

  /// Queries every state; the comparison with new caches takes long, so it is rare.
  void ExpectAnswers(int step) {
    constexpr int kEvery = 5, kFirst = 2;  // seldom just after a restart, when nothing is kept
    const std::shared_ptr<const MapView> live = room_.View();
    if (step % kEvery != kFirst) {
      answers_.Follow(*live, room_.surfaces());
      return;
    }
    EXPECT_TRUE(answers_.AreAsIfMadeAnew(*live, room_.surfaces()));
    EXPECT_TRUE(answers_.MeshIsAsIfRebuilt(live->snapshot()));
  }

  void Tell(std::string step) {
    constexpr std::size_t kMostTold = 16;
    steps_.push_back(std::move(step));
    if (steps_.size() > kMostTold) steps_.pop_front();
  }
  static std::string NameOf(const Edit& edit) {
    return edit.target ? std::to_string(std::get<SubmapId>(*edit.target).value) : std::string("the map");
  }
  std::string DrawAuthor() { return edits_.Below(2) == 0 ? "anna" : "ben"; }

  static StoreRounding RoundingOf(EditedRoom::Store store) {
    if (store == EditedRoom::Store::kMemory) return {};
    return {.distance_m = testing::EditedRoomInfo().config.truncation_m / 4096, .weight_share = 1e-4};
  }

  RandomEdits edits_{GetParam().seed};
  testing::LiveAnswers answers_{GetParam().seed};  // draws for itself: the sequence is the same without it
  EditedRoom room_{GetParam().store};
  const StoreRounding rounding_ = RoundingOf(GetParam().store);
  std::deque<std::string> steps_;
  std::string told_asks_;
  std::map<Ask, int> num_made_;
  struct {
    std::int64_t revision = 0;
    SnapshotPtr before;
  } last_edit_;
  std::int64_t last_revision_ = 0;
  SubmapId last_next_id_{0};
  int num_finished_ = 0, num_restarts_ = 0, num_undone_ = 0, num_undone_at_once_ = 0;
};

TEST_P(EditProperty, LawsHoldOverFramesRefinementsEditsUndosAndRestarts) {
  const int num_steps = std::max(1, NumPropertySteps() / static_cast<int>(std::size(kSequences)));
  Run(num_steps);
  if (HasFailure() || num_steps < 100) return;
  EXPECT_GE(num_finished_, num_steps / 50);
  EXPECT_GE(num_restarts_, num_steps / 50);
  EXPECT_GE(num_undone_at_once_, num_steps / 20);
  EXPECT_GE(num_undone_, 1);
  EXPECT_GE(num_made_.size(), kNumAsks / 2) << "so many kinds of edits were made";
}

INSTANTIATE_TEST_SUITE_P(Random, EditProperty, ::testing::ValuesIn(kSequences),
                         [](const auto& sequence) { return sequence.param.name; });
INSTANTIATE_TEST_SUITE_P(Paged, EditProperty, ::testing::ValuesIn(kPagedSequences),
                         [](const auto& sequence) { return sequence.param.name; });

}  // namespace
}  // namespace dhpmap
