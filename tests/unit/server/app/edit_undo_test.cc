// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/edit_undo.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/unit/server/app/edit_undo_fixture.h"

namespace dhpmap {
namespace {

using testing::Difference;
using testing::EditUndoTest;
using testing::ReasonOf;
using testing::StoreKind;
using testing::TextWithoutNumbers;

TEST_P(EditUndoTest, EveryEditAndItsUndoRestoreTheMap) {
  const auto edits = [this] {
    return std::vector<std::pair<std::string, std::vector<Edit>>>{
        {"move", {Move(1, 3)}},
        {"rename", {Rename(1, "lamp")}},
        {"relabel", {Relabel(1, 2)}},
        {"clone", {On(1, CloneEdit{})}},
        {"delete", {On(1, DeleteEdit{})}},
        {"merge", {On(1, MergeEdit{{SubmapId(2), SubmapId(3)}})}},
        {"split", {Split(2, 3)}},
        {"clear", {Clear(2, 1.2)}},
        {"clear all of it", {Clear(3, 30)}},
        {"absent", {On(1, PresenceEdit{Presence::kAbsent})}},
        {"present", {On(1, PresenceEdit{Presence::kPresent})}},
        {"lock", {Lock(1, true)}},
        {"keep clear", {KeepClear("door", 1)}},
        {"clear and keep clear", {ClearAndKeep("hall")}},
        {"keep clear and lift another", {Lift("desk"), KeepClear("desk", 3), KeepClear("door", 2)}},
        {"a list", {Move(1, 2), On(2, MergeEdit{{SubmapId(3)}}), Split(2, 2), On(4, DeleteEdit{}), Rename(5, "a")}}};
  }();
  ASSERT_TRUE(Do({KeepClear("desk", 0.5)}, "ben").ok());
  const std::string before = Stored();
  for (const auto& [name, list] : edits) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(Do(list).ok());
    const std::string after = Stored();
    EXPECT_NE(Difference(after, before), "");
    const Status undone = Undo({});
    ASSERT_TRUE(undone.ok()) << undone.ToString();
    ASSERT_EQ(Difference(Stored(), before), "");
    Restart();
    const Status redone = Redo();
    ASSERT_TRUE(redone.ok()) << redone.ToString();
    ASSERT_EQ(Difference(Stored(), after), "");
    ASSERT_TRUE(Undo({}).ok());
    ASSERT_EQ(Difference(Stored(), before), "");
    ASSERT_EQ(Difference(TextWithoutNumbers(*map->published()), before), "") << "in memory, too";
    ExpectIntact();
  }
}

TEST_P(EditUndoTest, RandomEditsUndosRedosAndRestartsAgreeWithAStackOfStates) {
  std::mt19937 random(11);
  std::vector<std::string> done, undone;  // states to go back to, and to go on to
  int num_undone = 0, num_redone = 0;
  for (int step = 0; step < 150; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const std::string before = Stored();
    const std::uint32_t dice = random() % 16;
    const auto& submaps = map->submaps();
    const auto any = [&] { return submaps.size() > 1 ? submaps[1 + random() % (submaps.size() - 1)]->id().value : 1u; };
    if (dice < 5) {
      const std::size_t count = 1 + random() % 3;
      const Status status = Undo({.count = count});
      if (done.size() < count) {
        ASSERT_EQ(ReasonOf(status), "NOTHING_TO_UNDO");
        ASSERT_EQ(Difference(Stored(), before), "");
        continue;
      }
      ASSERT_TRUE(status.ok()) << status.ToString();
      std::string now = before;
      for (std::size_t n = 0; n < count; ++n) {
        undone.push_back(now);
        now = done.back();
        done.pop_back();
      }
      ASSERT_EQ(Difference(Stored(), now), "");
      ++num_undone;
    } else if (dice < 9) {
      const Status status = Redo();
      if (undone.empty()) {
        ASSERT_EQ(ReasonOf(status), "NOTHING_TO_REDO");
        continue;
      }
      ASSERT_TRUE(status.ok()) << status.ToString();
      done.push_back(before);
      ASSERT_EQ(Difference(Stored(), undone.back()), "");
      undone.pop_back();
      ++num_redone;
    } else if (dice == 9) {
      Restart();
      ASSERT_EQ(Difference(Stored(), before), "");
    } else {
      const std::uint32_t id = any(), other = any();
      std::vector<Edit> list;
      switch (random() % 9) {
        case 0: list = {Move(id, 1 + random() % 5)}; break;
        case 1: list = {Rename(id, "name " + std::to_string(step))}; break;
        case 2: list = {Relabel(id, static_cast<std::uint16_t>(1 + random() % 3))}; break;
        case 3: list = {On(id, CloneEdit{})}; break;
        case 4: list = {On(id, DeleteEdit{})}; break;
        case 5: list = {On(id, MergeEdit{{SubmapId(other)}})}; break;
        case 6: list = {Split(id, 1 + random() % 5)}; break;
        case 7: list = {Clear(random() % 6, 0.3 + 0.1 * (random() % 8))}; break;
        default: list = {On(id, PresenceEdit{random() % 2 == 0 ? Presence::kAbsent : Presence::kPresent})}; break;
      }
      const std::int64_t revision = map->info().revision;
      const Status status = Do(list);
      if (!status.ok() || map->info().revision == revision) {
        ASSERT_EQ(Difference(Stored(), before), "");
        continue;
      }
      done.push_back(before);
      undone.clear();
    }
  }
  EXPECT_GT(num_undone, 15);
  EXPECT_GT(num_redone, 10);
  ExpectIntact();
}

TEST_P(EditUndoTest, WithFramesInBetweenAnUndoIsCompleteOrRefused) {
  std::mt19937 random(23);
  int num_undone = 0, num_conflicts = 0;
  for (int step = 0; step < 150; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const auto& submaps = map->submaps();
    if (submaps.size() < 4) {
      ASSERT_TRUE(Do({On(submaps.back()->id().value, CloneEdit{})}, "ben").ok());
    }
    const std::uint32_t id = map->submaps()[1 + random() % (map->submaps().size() - 1)]->id().value;
    switch (random() % 6) {
      case 0:
        Observe(SubmapId(id), {static_cast<std::int32_t>(random() % 6), static_cast<std::int32_t>(id % 5), 0});
        break;
      case 1: (void)Do({Split(id, 1 + random() % 5)}); break;
      case 2: (void)Do({Move(id, 1 + random() % 5)}, "ben"); break;
      case 3: (void)Do({On(id, DeleteEdit{})}); break;
      default: {
        const std::string before = Stored();
        const auto log = *store->ListEdits("m", {.max_edits = 12});
        if (log.empty()) break;
        const LoggedEdit& edit = log[random() % log.size()];
        UndoRequest request{.kind = edit.is_undone ? EditKind::kRedo : EditKind::kUndo, .edit = edit.entry.revision};
        const Status status = Undo(request);
        if (status.ok()) {
          ++num_undone;
        } else {
          ASSERT_TRUE(ReasonOf(status) == "UNDO_CONFLICT" || ReasonOf(status) == "NOTHING_TO_UNDO")
              << status.ToString();
          if (ReasonOf(status) == "UNDO_CONFLICT") ++num_conflicts;
          ASSERT_EQ(Difference(Stored(), before), "");
        }
      }
    }
    ASSERT_EQ(Difference(TextWithoutNumbers(*map->published()), Stored()), "");
    for (const auto& submap : map->submaps()) {  // counts of classes are those of the voxels
      std::uint64_t in_row = 0, in_voxels = 0;
      for (const ClassTotal& total : submap->info().class_counts) in_row += total.count;
      for (const BlockEntry& entry : submap->blocks().entries()) {
        for (int v = 0; entry.labels != nullptr && v < kBlockVoxels; ++v) {
          for (const LabelCount& count : entry.labels->Get(v).classes) in_voxels += count.count;
        }
      }
      ASSERT_EQ(in_row, in_voxels) << "submap " << submap->id().value;
    }
  }
  EXPECT_GT(num_undone, 15);
  EXPECT_GT(num_conflicts, 5);
  ExpectIntact();
}

TEST_P(EditUndoTest, UndoingAFieldConflictsOnlyWithLaterEditsOfThatField) {
  ASSERT_TRUE(Do({Move(1, 2)}).ok());
  const std::int64_t moved = map->info().revision;
  ASSERT_TRUE(Do({Rename(1, "lamp")}, "ben").ok());
  Observe(SubmapId(1), {0, 0, 0});
  ASSERT_TRUE(Undo({.edit = moved}).ok()) << "a name and frames are other fields";
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "lamp");
  EXPECT_TRUE(map->Find(SubmapId(1))->info().T_map_submap.isApprox(Transform::Identity()));
  EXPECT_FALSE(map->Find(SubmapId(1))->info().is_placed);
  ASSERT_TRUE(Redo().ok());
  ASSERT_TRUE(Do({Move(1, 4)}, "ben").ok());
  const Status conflict = Undo({.edit = moved});
  EXPECT_EQ(conflict.code(), StatusCode::kAborted);
  EXPECT_EQ(ReasonOf(conflict), "UNDO_CONFLICT");
  std::map<std::string, std::string> metadata(conflict.metadata().begin(), conflict.metadata().end());
  EXPECT_EQ(metadata["instance_id"], "1");
  EXPECT_EQ(metadata["field"], "pose");
  EXPECT_EQ(metadata["edit"], std::to_string(moved));
}

TEST_P(EditUndoTest, UndoingALockOrRegionConflictsOnlyWithLaterEditsOfIt) {
  ASSERT_TRUE(Do({Lock(1, true)}).ok());
  const std::int64_t locked = map->info().revision;
  ASSERT_TRUE(Do({Move(1, 2), Rename(1, "lamp")}, "ben").ok());
  ASSERT_TRUE(Undo({.edit = locked}).ok());
  EXPECT_FALSE(map->Find(SubmapId(1))->info().is_locked);
  ASSERT_TRUE(Redo().ok());
  ASSERT_TRUE(Do({Lock(1, false)}, "ben").ok());
  Status conflict = Undo({.edit = locked});
  EXPECT_EQ(ReasonOf(conflict), "UNDO_CONFLICT");
  std::map<std::string, std::string> metadata(conflict.metadata().begin(), conflict.metadata().end());
  EXPECT_EQ(metadata["field"], "locked");

  ASSERT_TRUE(Do({KeepClear("door", 1)}).ok());
  const std::int64_t kept = map->info().revision;
  ASSERT_TRUE(Do({KeepClear("hall", 1)}, "ben").ok());
  ASSERT_TRUE(Undo({.edit = kept}).ok());
  ASSERT_TRUE(Do({KeepClear("door", 3)}, "ben").ok()) << "another of this name";
  conflict = Redo({.edit = kept});
  EXPECT_EQ(ReasonOf(conflict), "UNDO_CONFLICT");
  metadata = {conflict.metadata().begin(), conflict.metadata().end()};
  EXPECT_EQ(metadata["field"], "ignored_regions");
  Restart();
  ASSERT_EQ(map->info().kept_clear.list().size(), 2u);
  EXPECT_EQ(map->info().kept_clear.list()[0].name, "door");
  ExpectIntact();
}

TEST_P(EditUndoTest, UndoingVoxelsConflictsWithAnyWriteToTheirTiles) {
  ASSERT_TRUE(Do({Split(1, 3)}).ok());
  const std::int64_t split = map->info().revision;
  Observe(SubmapId(4), {0, 3, 0});  // of another object
  ASSERT_TRUE(Undo({.edit = split}).ok());
  ASSERT_TRUE(Redo().ok());
  Observe(SubmapId(1), {0, 0, 0});
  const Status conflict = Undo({.edit = split});
  EXPECT_EQ(ReasonOf(conflict), "UNDO_CONFLICT") << conflict.ToString();
}

TEST_P(EditUndoTest, EachAuthorHasAStackAndANewEditEndsTheRedo) {
  ASSERT_TRUE(Do({Rename(1, "a1")}, "anna").ok());
  ASSERT_TRUE(Do({Rename(2, "b1")}, "ben").ok());
  ASSERT_TRUE(Undo({.author = "anna"}).ok());
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "");
  EXPECT_EQ(map->Find(SubmapId(2))->info().display_name, "b1");
  ASSERT_TRUE(Do({Rename(2, "b2")}, "ben").ok());
  ASSERT_TRUE(Redo({.author = "anna"}).ok()) << "another's edit ends nothing";
  ASSERT_TRUE(Undo({.author = "anna"}).ok());
  ASSERT_TRUE(Do({Rename(3, "a2")}, "anna").ok());
  EXPECT_EQ(ReasonOf(Redo({.author = "anna"})), "NOTHING_TO_REDO");
  EXPECT_EQ(ReasonOf(Undo({.author = "nobody"})), "NOTHING_TO_UNDO");
  EXPECT_EQ(ReasonOf(Undo({.edit = 999})), "EDIT_NOT_FOUND");
  const std::int64_t last = map->info().revision;
  ASSERT_TRUE(Undo({.edit = last, .author = "ben"}).ok()) << "by its id, whoever made it";
  EXPECT_EQ(ReasonOf(Undo({.edit = last})), "NOTHING_TO_UNDO");
}

TEST_P(EditUndoTest, AnUndoWithoutKeptDataIsRefusedWithAReason) {
  used_limits = {.max_histories = 2};
  BeginAnew(used_limits);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(Do({Split(static_cast<std::uint32_t>(i + 1), 3)}).ok());
  const auto log = *store->ListEdits("m", {});
  EXPECT_TRUE(log[0].is_kept && log[1].is_kept);
  EXPECT_FALSE(log[2].is_kept || log[3].is_kept);
  const Status lost = Undo({.edit = log[3].entry.revision});
  EXPECT_EQ(ReasonOf(lost), "UNDO_NOT_KEPT");
  std::map<std::string, std::string> metadata(lost.metadata().begin(), lost.metadata().end());
  EXPECT_EQ(metadata["oldest_edit"], std::to_string(log[1].entry.revision));
  EXPECT_EQ(ReasonOf(Undo({.count = 3})), "UNDO_NOT_KEPT") << "all or none";
  EXPECT_TRUE(Undo({.count = 2}).ok());
  ExpectIntact();
  if (GetParam() == StoreKind::kMemory) return;
  used_limits = {.max_history_bytes = 10};
  BeginAnew(used_limits);
  ASSERT_TRUE(Do({Split(1, 3)}).ok());
  EXPECT_EQ(ReasonOf(Undo({})), "UNDO_NOT_KEPT") << "alone larger than all that may be kept";
  ExpectIntact();
}

TEST_P(EditUndoTest, UndoingInAnotherOrderBreaksNothing) {
  ASSERT_TRUE(Do({On(2, DeleteEdit{})}).ok());
  const std::int64_t first = map->info().revision;
  ASSERT_TRUE(Undo({}).ok());
  ASSERT_TRUE(Do({On(3, DeleteEdit{})}).ok());
  const std::int64_t second = map->info().revision;
  ASSERT_TRUE(Redo({.edit = first}).ok());
  ASSERT_TRUE(Undo({.edit = second}).ok());
  ASSERT_TRUE(Undo({.edit = first}).ok());
  EXPECT_TRUE(map->Find(SubmapId(2)) != nullptr && map->Find(SubmapId(3)) != nullptr);
  ExpectIntact();
}

TEST_P(EditUndoTest, ALaterRemovalOfARestoredObjectConflicts) {
  ASSERT_TRUE(Do({On(2, DeleteEdit{})}).ok());
  const std::int64_t deleted = map->info().revision;
  ASSERT_TRUE(Commit("ben", [&](Map& edited) { return UndeleteSubmap(SubmapId(2), *store, edited); }).ok());
  ASSERT_TRUE(Do({On(2, DeleteEdit{})}, "ben").ok());
  const Status late = Undo({.edit = deleted, .conditions = {.expected_revision = deleted}});
  EXPECT_EQ(ReasonOf(late), "EDITED_SINCE");
  EXPECT_EQ(map->Find(SubmapId(2)), nullptr);
  const Status known = Undo({.edit = deleted, .conditions = {.expected_revision = map->info().revision}});
  EXPECT_TRUE(known.ok()) << known.ToString();
}

INSTANTIATE_TEST_SUITE_P(Stores, EditUndoTest, ::testing::Values(StoreKind::kMemory, StoreKind::kSqlite),
                         [](const auto& kind) { return kind.param == StoreKind::kMemory ? "Memory" : "Sqlite"; });

}  // namespace
}  // namespace dhpmap
