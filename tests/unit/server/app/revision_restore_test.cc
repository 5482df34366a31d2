// SPDX-License-Identifier: BSD-3-Clause
// Restoring a map, or one of its objects.
#include "server/app/edits/revision_restore.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/server/app/edit_undo_fixture.h"

namespace dhpmap {
namespace {

using testing::Difference;
using testing::ReasonOf;
using testing::StoreKind;
using testing::TextWithoutNumbers;

class RevisionRestore : public testing::EditUndoTest {
 protected:
  RevisionRestore() { Keep(); }

  void Keep() { kept.Keep(map->published()); }
  void MustDo(std::vector<Edit> edits) {
    const Status done = Do(std::move(edits));
    ASSERT_TRUE(done.ok()) << done.ToString();
    Keep();
  }
  Status Restore(RestoreRequest request) {
    const Status restored = Commit("anna", [&](Map& edited) -> Result<EditSummary> {
      DHPMAP_ASSIGN_OR_RETURN(summary, RestoreRevision(request, kept, *store, edited));
      return summary;
    });
    Keep();
    return restored;
  }
  Status RestoreOne(std::int64_t revision, std::uint32_t id, const std::string& etag = "") {
    return Restore({.revision = revision, .submap = SubmapId(id), .etag = etag});
  }
  [[nodiscard]] std::int64_t Now() const { return map->info().revision; }
  [[nodiscard]] std::string Text() const { return TextWithoutNumbers(*map->published()); }
  /// The text of a map with this object only.
  [[nodiscard]] std::string TextOfOne(std::uint32_t id) const {
    for (const auto& submap : map->submaps()) {
      if (submap->id() == SubmapId(id)) return TextWithoutNumbers(MapSnapshot(MapInfo(), std::vector{submap}));
    }
    return "";
  }

  SnapshotHistory kept{1000, std::make_shared<ByteBudget>(std::size_t{1} << 30)};
  EditSummary summary;
};

TEST_P(RevisionRestore, TheLogNamesTheRestoredRevision) {
  const std::int64_t past = Now();
  MustDo({Rename(1, "new")});
  MustDo({Rename(1, "newer")});
  ASSERT_TRUE(RestoreOne(past + 1, 1).ok());
  EXPECT_EQ(summary.restored_revision, past + 1);
  ASSERT_TRUE(Restore({.revision = past}).ok());
  EXPECT_EQ(summary.restored_revision, past);
  const auto log = store->ListEdits("m", {.max_edits = 2});
  ASSERT_TRUE(log.ok() && log->size() == 2);
  EXPECT_EQ(log->at(0).entry.summary.restored_revision, past);
  EXPECT_EQ(log->at(1).entry.summary.restored_revision, past + 1);
}

TEST_P(RevisionRestore, TheMapIsRestoredByAnEditThatCanBeUndone) {
  const std::int64_t past = Now();
  const std::string as_it_was = Stored();
  MustDo({Rename(1, "lamp"), Relabel(1, 2), Lock(1, true)});
  MustDo({On(2, DeleteEdit{})});
  MustDo({Move(3, 0.5)});
  MustDo({On(4, MergeEdit{{SubmapId(5)}})});
  MustDo({Split(1, 3)});
  MustDo({On(3, CloneEdit{}), KeepClear("door", 0.5)});
  MustDo({Clear(4, 2)});
  Observe(SubmapId(3), {9, 2, 0});
  Keep();
  const std::string edited = Stored();
  ASSERT_TRUE(Restore({.revision = past}).ok());
  EXPECT_EQ(Difference(Stored(), as_it_was), "");
  EXPECT_EQ(summary.steps, (std::vector<EditStep>{{EditAction::kRestore, kUnknownSubmap}}));
  EXPECT_EQ(summary.created, (std::vector<SubmapId>{SubmapId(2), SubmapId(5)}));
  EXPECT_EQ(summary.removed, (std::vector<SubmapId>{SubmapId(6), SubmapId(7)}));
  ExpectIntact();
  ASSERT_TRUE(Undo({}).ok());
  EXPECT_EQ(Difference(Stored(), edited), "");
  ASSERT_TRUE(Redo().ok());
  EXPECT_EQ(Difference(Stored(), as_it_was), "");
  ExpectIntact();
  Restart();
  EXPECT_EQ(Difference(Text(), as_it_was), "");
}

TEST_P(RevisionRestore, NoIdIsReused) {
  const std::int64_t past = Now();
  MustDo({On(1, CloneEdit{})});
  ASSERT_NE(map->Find(SubmapId(6)), nullptr);
  ASSERT_TRUE(Restore({.revision = past}).ok());
  EXPECT_EQ(map->Find(SubmapId(6)), nullptr);
  MustDo({On(1, CloneEdit{})});
  EXPECT_EQ(map->Find(SubmapId(6)), nullptr);
  EXPECT_NE(map->Find(SubmapId(7)), nullptr);
  EXPECT_GT(Now(), past + 2) << "nor a revision";
}

TEST_P(RevisionRestore, ARestoreWithoutEffectIsNoEdit) {
  const std::int64_t now = Now();
  ASSERT_TRUE(Restore({.revision = now}).ok());
  EXPECT_EQ(Now(), now);
  EXPECT_TRUE(store->ListEdits("m", {})->empty());
  MustDo({Rename(1, "lamp")});
  ASSERT_TRUE(RestoreOne(now, 2).ok()) << "of which nothing has changed";
  EXPECT_EQ(Now(), now + 1);
}

TEST_P(RevisionRestore, ASingleObjectIsRestored) {
  const std::int64_t past = Now();
  const std::string as_it_was = TextOfOne(3);
  MustDo({Move(3, 0.5), Rename(3, "sofa"), Rename(1, "lamp")});
  MustDo({Clear(4, 2)});
  ASSERT_NE(TextOfOne(3), as_it_was);
  const std::string other = TextOfOne(1);
  ASSERT_TRUE(RestoreOne(past, 3).ok());
  EXPECT_EQ(Difference(TextOfOne(3), as_it_was), "");
  EXPECT_EQ(Difference(TextOfOne(1), other), "") << "all else stays";
  EXPECT_EQ(map->Find(SubmapId(3))->info().edited_revision, Now());
  EXPECT_EQ(summary.steps, (std::vector<EditStep>{{EditAction::kRestore, SubmapId(3)}}));
  EXPECT_EQ(summary.changed, std::vector<SubmapId>{SubmapId(3)});
  ExpectIntact();
}

TEST_P(RevisionRestore, ADeletedObjectIsRestoredAlone) {
  const std::int64_t past = Now();
  const std::string as_it_was = TextOfOne(2);
  MustDo({On(2, DeleteEdit{}), Rename(1, "lamp")});
  const std::string deleted = Stored();
  ASSERT_FALSE(map->vacated().tiles().empty());
  ASSERT_TRUE(RestoreOne(past, 2).ok());
  EXPECT_EQ(Difference(TextOfOne(2), as_it_was), "");
  EXPECT_TRUE(map->vacated().tiles().empty()) << "its place is taken again";
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "lamp");
  ASSERT_TRUE(Undo({}).ok());
  EXPECT_EQ(Difference(Stored(), deleted), "");
  ExpectIntact();
}

TEST_P(RevisionRestore, ASplitObjectStaysSplitAfterAPartWasDeleted) {
  const SubmapId whole(1), part(6);
  MustDo({Split(1, 3)});
  ASSERT_EQ(map->info().pairs.Of(whole, part).verdict, PairVerdict::kMustBeTwo);
  const std::int64_t past = Now();
  MustDo({On(6, DeleteEdit{})});
  const std::string deleted = Stored();
  ASSERT_EQ(map->info().pairs.Of(whole, part).verdict, PairVerdict::kOpen);
  ASSERT_TRUE(RestoreOne(past, 6).ok());
  EXPECT_EQ(map->info().pairs.Of(whole, part).verdict, PairVerdict::kMustBeTwo);
  ASSERT_TRUE(Undo({}).ok());
  EXPECT_EQ(Difference(Stored(), deleted), "");
  ExpectIntact();
}

TEST_P(RevisionRestore, AnImpossibleRestoreIsRefusedAndChangesNothing) {
  const std::int64_t past = Now();
  MustDo({On(1, CloneEdit{})});
  MustDo({On(4, MergeEdit{{SubmapId(5)}})});
  Observe(SubmapId(1), {10, 0, 0});  // a revision that is not kept
  const std::int64_t not_kept = Now();
  Observe(SubmapId(1), {11, 0, 0});
  const std::string before = Stored();
  EXPECT_EQ(ReasonOf(RestoreOne(past, 0)), "UNKNOWN_SUBMAP");
  EXPECT_EQ(ReasonOf(RestoreOne(past, 5)), "MERGED_INTO");
  EXPECT_EQ(ReasonOf(RestoreOne(past, 6)), "SUBMAP_NOT_FOUND") << "it was not there then";
  EXPECT_EQ(ReasonOf(RestoreOne(past, 77)), "SUBMAP_NOT_FOUND");
  EXPECT_EQ(ReasonOf(RestoreOne(past, 1, "of another")), "ETAG_MISMATCH");
  EXPECT_EQ(ReasonOf(Restore({.revision = past, .etag = "of another"})), "ETAG_MISMATCH");
  EXPECT_EQ(ReasonOf(Restore({.revision = 0})), "BAD_REVISION");
  EXPECT_EQ(ReasonOf(Restore({.revision = Now() + 1})), "BAD_REVISION");
  EXPECT_EQ(ReasonOf(Restore({.revision = past, .lost = {{past, past}}})), "HISTORY_LOST");
  EXPECT_EQ(ReasonOf(Restore({.revision = not_kept})), "REVISION_NOT_KEPT");
  EXPECT_EQ(Difference(Stored(), before), "");
}

TEST_P(RevisionRestore, EditsOfARestoredObjectConflict) {
  const std::int64_t past = Now();
  MustDo({Rename(1, "lamp")});
  const std::int64_t renamed = Now();
  const auto restore = [&](std::optional<SubmapId> submap, std::int64_t expected) {
    return std::string(ReasonOf(Restore({.revision = past, .submap = submap, .expected_revision = expected})));
  };
  EXPECT_EQ(restore(SubmapId(1), past), "EDITED_SINCE");
  EXPECT_EQ(restore(std::nullopt, past), "EDITED_SINCE");
  EXPECT_EQ(restore(std::nullopt, renamed + 9), "EDITED_SINCE") << "it is not there yet";
  EXPECT_EQ(restore(SubmapId(2), past), "") << "another object was";
  MustDo({On(3, DeleteEdit{})});
  EXPECT_EQ(restore(std::nullopt, renamed), "EDITED_SINCE") << "of an object that is gone the log knows";
  Observe(SubmapId(1), {10, 0, 0});
  EXPECT_EQ(restore(SubmapId(1), renamed), "") << "frames do not count";
}

TEST_P(RevisionRestore, ARemovalOfARestoredObjectConflicts) {
  const std::int64_t past = Now();
  MustDo({On(3, DeleteEdit{})});
  const std::int64_t removed = Now();
  MustDo({Rename(1, "lamp")});
  const auto restore = [&](std::int64_t expected) {
    return std::string(ReasonOf(Restore({.revision = past, .submap = SubmapId(3), .expected_revision = expected})));
  };
  EXPECT_EQ(restore(past), "EDITED_SINCE");
  EXPECT_EQ(map->Find(SubmapId(3)), nullptr);
  EXPECT_EQ(restore(removed), "") << "known to be gone";
  EXPECT_NE(map->Find(SubmapId(3)), nullptr);
}

/// For all later edits and all target revisions.
TEST_P(RevisionRestore, AnyKeptRevisionIsRestoredAndUndone) {
  std::mt19937 random(23);
  std::map<std::int64_t, std::string> texts = {{Now(), Text()}};
  const auto below = [&random](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int step = 0; step < 60; ++step) {
    const std::uint32_t id = 1 + below(8);
    const auto edit = [&]() -> Edit {
      switch (below(8)) {
        case 0: return Rename(id, "name " + std::to_string(below(5)));
        case 1: return Move(id, 0.1 * below(5));
        case 2: return Relabel(id, static_cast<std::uint16_t>(1 + below(3)));
        case 3: return On(id, DeleteEdit{});
        case 4: return On(id, MergeEdit{{SubmapId(1 + below(8))}});
        case 5: return Split(id, 1 + below(4));
        case 6: return Clear(below(6), 1 + below(2));
        default: return On(id, CloneEdit{});
      }
    }();
    (void)Do({edit});  // of what is not there it is refused
    if (step % 5 == 0 && map->Find(SubmapId(id)) != nullptr) Observe(SubmapId(id), {7, static_cast<int>(below(4)), 0});
    Keep();
    texts[Now()] = Text();
    if (step % 4 != 3) continue;
    const std::string before = Text();
    auto past = texts.begin();
    std::advance(past, below(static_cast<std::uint32_t>(texts.size())));
    const Status restored = Restore({.revision = past->first});
    ASSERT_TRUE(restored.ok()) << restored.ToString();
    ASSERT_EQ(Difference(Text(), past->second), "") << "step " << step << ", of revision " << past->first;
    if (Text() != before && below(2) == 0) {
      ASSERT_TRUE(Undo({}).ok());
      Keep();
      ASSERT_EQ(Difference(Text(), before), "") << "step " << step;
    }
    texts[Now()] = Text();
    ASSERT_EQ(Difference(Text(), Stored()), "");
  }
  ExpectIntact();
}

INSTANTIATE_TEST_SUITE_P(Stores, RevisionRestore, ::testing::Values(StoreKind::kMemory, StoreKind::kSqlite),
                         [](const auto& kind) { return kind.param == StoreKind::kMemory ? "Memory" : "Sqlite"; });

}  // namespace
}  // namespace dhpmap
