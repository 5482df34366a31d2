// SPDX-License-Identifier: BSD-3-Clause
// Restoring deleted objects.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/unit/server/app/edit_undo_fixture.h"

namespace dhpmap {
namespace {

using testing::Difference;
using testing::ReasonOf;
using testing::StoreKind;

class UndeleteTest : public testing::EditUndoTest {};

TEST_P(UndeleteTest, ADeletedObjectIsRestoredUnderItsId) {
  const std::string before = Stored();
  ASSERT_TRUE(Do({On(2, DeleteEdit{}), Rename(1, "lamp")}).ok());
  ASSERT_TRUE(Do({Rename(3, "sofa")}).ok());
  const auto undelete = [this](std::uint32_t id) {
    return Commit("ben", [&](Map& edited) { return UndeleteSubmap(SubmapId(id), *store, edited); });
  };
  EXPECT_EQ(ReasonOf(undelete(1)), "NOTHING_TO_UNDO");
  EXPECT_EQ(ReasonOf(undelete(77)), "SUBMAP_NOT_FOUND");
  ASSERT_TRUE(undelete(2).ok());
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "lamp") << "alone";
  ASSERT_NE(map->Find(SubmapId(2)), nullptr);
  ASSERT_TRUE(Do({Rename(1, "")}).ok());
  ASSERT_TRUE(Do({Rename(3, "")}).ok());
  EXPECT_EQ(Difference(Stored(), before), "") << "with what was known of it and another";
  ASSERT_TRUE(Do({On(4, MergeEdit{{SubmapId(5)}})}).ok());
  EXPECT_EQ(ReasonOf(undelete(5)), "MERGED_INTO");
  ExpectIntact();
}

TEST_P(UndeleteTest, ObjectsDeletedTogetherAreRestoredWithTheirOwnVoxels) {
  const auto undelete = [this](std::uint32_t id) {
    return Commit("ben", [&](Map& edited) { return UndeleteSubmap(SubmapId(id), *store, edited); });
  };
  const auto is_vacated = [this](int y) { return map->vacated().Find({0, 0, 0})->IsFree(CellOf({1, y, 0}), 5); };
  const std::string before = Stored();
  ASSERT_TRUE(Do({On(2, DeleteEdit{}), On(3, DeleteEdit{})}).ok());
  ASSERT_TRUE(is_vacated(1) && is_vacated(2));
  ASSERT_TRUE(undelete(2).ok());
  EXPECT_FALSE(is_vacated(1));
  EXPECT_TRUE(is_vacated(2)) << "what the other left is as it was";
  ASSERT_TRUE(undelete(3).ok());
  EXPECT_EQ(map->vacated().tiles().size(), 0u);
  EXPECT_EQ(Difference(Stored(), before), "");
  ExpectIntact();
}

TEST_P(UndeleteTest, AVerdictOfTwoObjectsSurvivesADeletionAndARestore) {
  constexpr SubmapId kPart(6);
  const auto undelete = [this](SubmapId id) {
    return Commit("ben", [&](Map& edited) { return UndeleteSubmap(id, *store, edited); });
  };
  ASSERT_TRUE(Do({Split(2, 3)}).ok());
  ASSERT_NE(map->Find(kPart), nullptr);
  const auto verdict_on = [this](SubmapId a, SubmapId b) { return map->info().pairs.Of(a, b).verdict; };
  ASSERT_EQ(verdict_on(SubmapId(2), kPart), PairVerdict::kMustBeTwo);
  ASSERT_TRUE(Do({On(kPart.value, DeleteEdit{})}).ok());
  ASSERT_EQ(verdict_on(SubmapId(2), kPart), PairVerdict::kOpen);
  ASSERT_TRUE(undelete(kPart).ok());
  EXPECT_EQ(verdict_on(SubmapId(2), kPart), PairVerdict::kMustBeTwo);

  ASSERT_TRUE(Do({On(kPart.value, DeleteEdit{}), On(1, DeleteEdit{})}).ok());
  ASSERT_TRUE(Do({On(3, MergeEdit{{SubmapId(2)}})}).ok());
  ASSERT_TRUE(undelete(kPart).ok());
  EXPECT_EQ(verdict_on(SubmapId(3), kPart), PairVerdict::kMustBeTwo) << "of what the other is a part of by now";
  EXPECT_EQ(map->Find(SubmapId(1)), nullptr);
  Restart();
  EXPECT_EQ(verdict_on(SubmapId(3), kPart), PairVerdict::kMustBeTwo);
  ASSERT_TRUE(Undo({.author = "ben"}).ok());
  EXPECT_EQ(verdict_on(SubmapId(3), kPart), PairVerdict::kOpen) << "with the undo it goes again";
  ExpectIntact();
}

TEST_P(UndeleteTest, AnObjectThatLostVoxelsBeforeItsDeletionIsRestoredCompletely) {
  ASSERT_TRUE(Do({Split(2, 3), On(2, DeleteEdit{})}).ok());
  const std::int64_t edit = map->info().revision;
  const Status alone = Commit("ben", [&](Map& edited) { return UndeleteSubmap(SubmapId(2), *store, edited); });
  EXPECT_EQ(ReasonOf(alone), "UNDO_CONFLICT");
  EXPECT_NE(alone.message().find("undo edit " + std::to_string(edit)), std::string::npos);
  EXPECT_TRUE(Undo({}).ok());
  EXPECT_EQ(ReasonOf(Undo({.edit = std::numeric_limits<std::int64_t>::max()})), "EDIT_NOT_FOUND");
}

INSTANTIATE_TEST_SUITE_P(Stores, UndeleteTest, ::testing::Values(StoreKind::kMemory, StoreKind::kSqlite),
                         [](const auto& kind) { return kind.param == StoreKind::kMemory ? "Memory" : "Sqlite"; });

}  // namespace
}  // namespace dhpmap
