// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/edit_book.h"

#include <gtest/gtest.h>

namespace dhpmap::rig {
namespace {

const ObjectKey kChair{"h1", 6};
const Eigen::Vector3d kHere(0, 0, 0), kThere(1, 2, 50);

class Edits : public ::testing::Test {
 protected:
  EditId Rename(const std::string& name, std::optional<Eigen::Vector3d> position_m = std::nullopt) {
    return Begin({.what = "rename to " + name,
                  .history = kChair.history,
                  .id = kChair.id,
                  .change = {.display_name = name, .position_m = position_m}});
  }
  EditId Delete() {
    return Begin(
        {.what = "delete", .history = kChair.history, .id = kChair.id, .change = {.presence = Presence::kGone}});
  }
  EditId Copy(const std::string& name) {
    return Begin({.what = "copy as " + name,
                  .history = kChair.history,
                  .change = {.presence = Presence::kThere, .display_name = name, .position_m = kThere},
                  .before = {.presence = Presence::kGone}});
  }
  EditId Begin(EditPlan plan) {
    const auto edit = book.Begin(std::move(plan), ++now);
    EXPECT_TRUE(edit.has_value());
    return edit.value_or(0);
  }
  void Made(EditId edit, std::optional<std::int64_t> id = std::nullopt) { book.OnMade(edit, id, nullptr, ++now); }
  /// Asked and answered now.
  void See(const std::string& name, const Eigen::Vector3d& position_m = kHere, std::int64_t id = kChair.id) {
    ++now;
    book.OnSeen({kChair.history, id}, {.display_name = name, .position_m = position_m}, now, now);
  }
  void SeeNothing(std::int64_t id = kChair.id) {
    ++now;
    book.OnAbsent({kChair.history, id}, now, now);
  }
  int Restart(const std::map<std::int64_t, Sight>& sights) {
    ++now;
    return book.OnRestarted(kChair.history, sights, now, now);
  }
  void ExpectKept() { EXPECT_EQ(complaints, Complaints()); }
  void ExpectBroken() { EXPECT_EQ(complaints.size(), 1u); }

  Complaints complaints;
  EditBook book{complaints};
  Moment now = 0;
};

TEST_F(Edits, ThatAreMadeAreThere) {
  See("chair 6");
  Made(Rename("rig-1", kThere));
  See("rig-1", kThere);
  ExpectKept();
  See("chair 6");
  ExpectBroken();
}

TEST_F(Edits, ThatAreUnderWayAreThereOrNot) {
  const EditId edit = Rename("rig-1", kThere);
  See("chair 6");
  See("rig-1", kThere);
  Made(edit);
  ExpectKept();
}

TEST_F(Edits, AreNeverThereByHalf) {
  Made(Rename("rig-1", kThere));
  See("rig-1", kHere);
  ExpectBroken();
}

TEST_F(Edits, AreHeldAgainstWhatTheirAnswerSays) {
  const EditId edit = Rename("rig-1", kThere);
  const Sight half{.display_name = "rig-1", .position_m = kHere};
  book.OnMade(edit, kChair.id, &half, ++now);
  ExpectBroken();
}

TEST_F(Edits, MayBeSeenLateByWhoAskedBefore) {
  See("chair 6");
  const Moment asked = ++now;
  Made(Rename("rig-1"));
  book.OnSeen(kChair, {.display_name = "chair 6"}, asked, ++now);
  ExpectKept();
}

TEST_F(Edits, ThatWereRefusedAreNotThere) {
  book.OnRefused(Rename("rig-1"));
  See("chair 6");
  ExpectKept();
  See("rig-1");
  ExpectBroken();
}

TEST_F(Edits, ThatWereSeenMayNotBeRefused) {
  Made(Rename("rig-1"));
  const EditId edit = Rename("rig-2");
  See("rig-2");
  book.OnRefused(edit);
  ExpectBroken();
}

TEST_F(Edits, OfOneObjectComeOneAfterTheOther) {
  Rename("rig-1");
  EXPECT_FALSE(book.Begin({.history = kChair.history, .id = kChair.id}, ++now));
}

TEST_F(Edits, ThatWereMadeOutliveARestart) {
  Made(Rename("rig-1"));
  EXPECT_EQ(Restart({{6, {.display_name = "rig-1"}}}), 0);
  ExpectKept();
  Restart({{6, {.display_name = "chair 6"}}});
  ExpectBroken();
}

TEST_F(Edits, ThatWereCutOffAreDecidedByTheRestart) {
  Made(Rename("rig-1"));
  book.OnCut(Rename("rig-2"));
  EXPECT_EQ(Restart({{6, {.display_name = "rig-2"}}}), 1);
  See("rig-2");
  ExpectKept();
  See("rig-1");
  ExpectBroken();
}

TEST_F(Edits, ThatWereCutOffAndLostDoNotComeBack) {
  Made(Rename("rig-1"));
  book.OnCut(Rename("rig-2"));
  EXPECT_EQ(Restart({{6, {.display_name = "rig-1"}}}), 0);
  ExpectKept();
  See("rig-2");
  ExpectBroken();
}

TEST_F(Edits, ThatWereSeenAndCutOffMayNotBeLost) {
  Made(Rename("rig-1"));
  const EditId edit = Rename("rig-2");
  See("rig-2");
  book.OnCut(edit);
  Restart({{6, {.display_name = "rig-1"}}});
  ExpectBroken();
}

TEST_F(Edits, InVainThatWereCutOffLeaveNoTrace) {
  const EditId edit = Begin({.what = "delete what has this id in a map of before",
                             .history = kChair.history,
                             .id = kChair.id,
                             .change = {.presence = Presence::kGone},
                             .is_vain = true});
  book.OnCut(edit);
  EXPECT_EQ(Restart({}), 0);
  See("chair 6");  // the first object of this map that has the id
  ExpectKept();
}

TEST_F(Edits, InVainThatWereMadeAllTheSame) {
  const EditId edit = Begin({.what = "rename",
                             .history = kChair.history,
                             .id = kChair.id,
                             .change = {.display_name = "rig-1"},
                             .is_vain = true});
  book.OnCut(edit);
  EXPECT_EQ(Restart({{kChair.id, {.display_name = "rig-1"}}}), 0);
  See("rig-1");
  ExpectBroken();
}

TEST_F(Edits, WhatIsDeletedNeverComesBack) {
  Made(Delete());
  SeeNothing();
  ExpectKept();
  EXPECT_TRUE(book.IsGone(kChair, now));
  See("chair 6");
  ExpectBroken();
}

TEST_F(Edits, WhatIsDeletedCannotBeEdited) {
  Made(Delete());
  Made(Rename("rig-1"));
  ExpectBroken();
}

TEST_F(Edits, ADeletionThatWasCutOffIsDecidedByTheRestart) {
  See("chair 6");
  book.OnCut(Delete());
  EXPECT_EQ(Restart({}), 1);
  ExpectKept();
  See("chair 6");
  ExpectBroken();
}

TEST_F(Edits, MappingMayTakeAwayWhatItMadeButNoCopy) {
  Made(Rename("rig-1"));
  SeeNothing();
  Made(Copy("rig-2"), 7);
  See("rig-2", kThere, 7);
  ExpectKept();
  SeeNothing(7);
  ExpectBroken();
}

TEST_F(Edits, ACopyIsMissedInAListOfAll) {
  Made(Copy("rig-2"), 7);
  ++now;
  book.OnWhole(kChair.history, {{6, {.display_name = "chair 6"}}}, now, now);
  ExpectBroken();
}

TEST_F(Edits, ACopyMayBeSeenBeforeItsAnswer) {
  const EditId edit = Copy("rig-2");
  See("rig-2", kThere, 7);
  Made(edit, 7);
  ExpectKept();
}

TEST_F(Edits, ACopyIsAnsweredWithTheIdItWasSeenWith) {
  const EditId edit = Copy("rig-2");
  See("rig-2", kThere, 7);
  Made(edit, 8);
  EXPECT_FALSE(complaints.empty());
}

TEST_F(Edits, ACopyThatWasCutOffIsDecidedByTheRestart) {
  book.OnCut(Copy("rig-2"));
  EXPECT_EQ(Restart({{7, {.display_name = "rig-2", .position_m = kThere}}}), 1);
  ExpectKept();
  SeeNothing(7);
  ExpectBroken();
}

TEST_F(Edits, ACopyThatWasCutOffAndLostDoesNotComeBack) {
  book.OnCut(Copy("rig-2"));
  EXPECT_EQ(Restart({}), 0);
  ExpectKept();
  See("rig-2", kThere, 7);
  ExpectBroken();
}

TEST_F(Edits, ACopyIsNotAtAnotherPlace) {
  book.OnCut(Copy("rig-2"));
  Restart({{7, {.display_name = "rig-2", .position_m = kHere}}});
  EXPECT_FALSE(complaints.empty());
}

TEST_F(Edits, ANameIsThatOfOneObject) {
  Made(Copy("rig-2"), 7);
  See("rig-2", kThere, 8);
  ExpectBroken();
}

TEST_F(Edits, NobodyGaveThisName) {
  See("rig-99");
  ExpectBroken();
}

}  // namespace
}  // namespace dhpmap::rig
