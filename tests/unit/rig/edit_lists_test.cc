// SPDX-License-Identifier: BSD-3-Clause
// Edits that are made together are there all or none, and so is what takes them back.
#include <gtest/gtest.h>

#include "tests/rig/ledger/ledger.h"

namespace dhpmap::rig {
namespace {

constexpr const char* kListed = "h-lists";

/// Two copies, 11 named rig-a and 12 named rig-b, that lists are made of.
class EditLists : public ::testing::Test {
 protected:
  void SetUp() override {
    MakeCopy(11, "rig-a");
    MakeCopy(12, "rig-b");
    ExpectKept();
  }
  static EditPlan Copy(const std::string& name) {
    return {.what = "copy as " + name,
            .history = kListed,
            .change = {.presence = Presence::kThere, .display_name = name},
            .before = {.presence = Presence::kGone}};
  }
  static EditPlan Rename(std::int64_t id, const std::string& name) {
    return {.what = "rename to " + name, .history = kListed, .id = id, .change = {.display_name = name}};
  }
  static EditPlan Delete(std::int64_t id) {
    return {.what = "delete", .history = kListed, .id = id, .change = {.presence = Presence::kGone}};
  }
  void MakeCopy(std::int64_t id, const std::string& name) {
    const auto edit = book.Begin(Copy(name), ++now);
    ASSERT_TRUE(edit);
    book.OnMade(*edit, id, nullptr, ++now);
  }
  std::vector<EditId> Begin(std::vector<EditPlan> plans) {
    const auto list = book.BeginList(std::move(plans), ++now);
    EXPECT_TRUE(list.has_value());
    return list.value_or(std::vector<EditId>());
  }
  std::vector<EditId> BeginUndo(const std::vector<EditId>& made, bool is_redo = false) {
    const auto list = book.BeginUndo(made, is_redo, "undo", ++now);
    EXPECT_TRUE(list.has_value());
    return list.value_or(std::vector<EditId>());
  }
  void Made(const std::vector<EditId>& list) {
    ++now;
    for (const EditId edit : list) book.OnMade(edit, std::nullopt, nullptr, now);
  }
  void Cut(const std::vector<EditId>& list) {
    for (const EditId edit : list) book.OnCut(edit);
  }
  void Refused(const std::vector<EditId>& list) {
    for (const EditId edit : list) book.OnRefused(edit);
  }
  using Names = std::map<std::int64_t, std::string>;
  static std::map<std::int64_t, Sight> Sights(const Names& names) {
    std::map<std::int64_t, Sight> sights;
    for (const auto& [id, name] : names) sights[id].display_name = name;
    return sights;
  }
  void See(const Names& names) {
    ++now;
    book.OnWhole(kListed, Sights(names), now, now);
  }
  int Restart(const Names& names) {
    ++now;
    return book.OnRestarted(kListed, Sights(names), now, now);
  }
  void ExpectKept() { EXPECT_EQ(complaints, Complaints()); }
  void ExpectBroken() {
    EXPECT_EQ(complaints.size(), 1u);
    complaints.clear();
  }

  Complaints complaints;
  EditBook book{complaints};
  Moment now = 0;
};

TEST_F(EditLists, OneThatWasMadeIsThereWhole) {
  Made(Begin({Rename(11, "rig-a2"), Delete(12)}));
  See({{11, "rig-a2"}});
  ExpectKept();
  See({{11, "rig-a2"}, {12, "rig-b"}});
  ExpectBroken();
}

TEST_F(EditLists, OneThatWasCutOffIsThereWholeOrNotAtAll) {
  Cut(Begin({Rename(11, "rig-a2"), Delete(12), Copy("rig-c")}));
  EXPECT_EQ(Restart({{11, "rig-a2"}, {13, "rig-c"}}), 3);
  Cut(Begin({Rename(11, "rig-a3"), Delete(13)}));
  EXPECT_EQ(Restart({{11, "rig-a2"}, {13, "rig-c"}}), 0);
  ExpectKept();
}

TEST_F(EditLists, OneThatWasCutOffAndIsThereInPart) {
  Cut(Begin({Rename(11, "rig-a2"), Delete(12)}));
  Restart({{11, "rig-a2"}, {12, "rig-b"}});
  ExpectBroken();
  Cut(Begin({Copy("rig-c"), Rename(12, "rig-b2")}));
  Restart({{11, "rig-a2"}, {12, "rig-b2"}});
  ExpectBroken();
}

TEST_F(EditLists, NobodySeesOneInPartWhileItIsMade) {
  Begin({Rename(11, "rig-a2"), Rename(12, "rig-b2")});
  See({{11, "rig-a"}, {12, "rig-b"}});
  See({{11, "rig-a2"}, {12, "rig-b2"}});
  ExpectKept();
  See({{11, "rig-a2"}, {12, "rig-b"}});
  ExpectBroken();
  See({{11, "rig-a"}, {12, "rig-b2"}});
  EXPECT_EQ(complaints, Complaints()) << "one complaint each";
}

TEST_F(EditLists, AStateOfBeforeOneOfItsObjectsWasMadeSaysNothing) {
  const Moment early = ++now;
  MakeCopy(13, "rig-c");
  Begin({Delete(13), Rename(11, "rig-a2")});
  book.OnWhole(kListed, Sights({{11, "rig-a"}, {12, "rig-b"}}), early, ++now);
  ExpectKept();
}

TEST_F(EditLists, OneThatWasRefusedIsNotThere) {
  Refused(Begin({Rename(11, "rig-a2"), Delete(12)}));
  See({{11, "rig-a"}, {12, "rig-b"}});
  ExpectKept();
  See({{11, "rig-a"}});
  ExpectBroken();
}

TEST_F(EditLists, AreOfObjectsThatMappingLeavesAloneAndNobodyElseEdits) {
  EXPECT_TRUE(book.IsHeld({kListed, 11}));
  EXPECT_FALSE(book.IsHeld({kListed, 1})) << "mapping's";
  EXPECT_FALSE(book.BeginList({Rename(11, "rig-a2"), Rename(1, "rig-1")}, ++now));
  EXPECT_FALSE(book.BeginList({Rename(11, "rig-a2"), Delete(11)}, ++now)) << "which of the two is seen?";
  const auto other = book.Begin(Rename(12, "rig-b2"), ++now);
  EXPECT_FALSE(book.BeginList({Rename(11, "rig-a3"), Delete(12)}, ++now)) << "another edit is under way";
  book.OnMade(other.value(), std::nullopt, nullptr, ++now);
  See({{11, "rig-a"}, {12, "rig-b2"}});
  ExpectKept();
}

TEST_F(EditLists, AnUndoTakesBackAllThatItsListHasChangedAndARedoMakesItAgain) {
  const auto list = Begin({Rename(11, "rig-a2"), Delete(12)});
  Made(list);
  Made(BeginUndo(list));
  See({{11, "rig-a"}, {12, "rig-b"}});
  ExpectKept();
  Made(BeginUndo(list, true));
  See({{11, "rig-a2"}});
  ExpectKept();
  See({{11, "rig-a"}, {12, "rig-b"}});
  EXPECT_EQ(complaints.size(), 2u);
}

TEST_F(EditLists, AnUndoLeavesWhatElseWasChangedSince) {
  const auto list = Begin({Rename(11, "rig-a2")});
  Made(list);
  EditPlan relabel{.what = "relabel", .history = kListed, .id = 11, .change = {.class_id = 4}};
  Made({book.Begin(relabel, ++now).value()});
  Made(BeginUndo(list));
  auto sights = Sights({{11, "rig-a"}, {12, "rig-b"}});
  sights[11].class_id = 4;
  book.OnWhole(kListed, sights, now, now);
  ExpectKept();
  See({{11, "rig-a"}, {12, "rig-b"}});
  ExpectBroken();
}

TEST_F(EditLists, AnUndoThatWasCutOffIsThereWholeOrNotAtAll) {
  const auto list = Begin({Rename(11, "rig-a2"), Rename(12, "rig-b2")});
  Made(list);
  Cut(BeginUndo(list));
  EXPECT_EQ(Restart({{11, "rig-a2"}, {12, "rig-b2"}}), 0);
  Cut(BeginUndo(list));
  EXPECT_EQ(Restart({{11, "rig-a"}, {12, "rig-b"}}), 2);
  ExpectKept();
  Cut(BeginUndo(list, true));
  Restart({{11, "rig-a2"}, {12, "rig-b"}});
  ExpectBroken();
}

TEST_F(EditLists, WhatWouldChangeNothingIsNotUndone) {
  const auto list = Begin({Rename(11, "rig-a2")});
  EXPECT_FALSE(book.BeginUndo(list, false, "undo", ++now)) << "it is under way";
  Made(list);
  EXPECT_FALSE(book.BeginUndo(list, true, "redo", ++now)) << "it is there";
}

TEST(Backups, HaveWhatWasToldBeforeTheyWereBegun) {
  Ledger ledger;
  v1::Map map;
  v1::ListSubmapsResponse all;
  ledger.OnStored(kListed, "robot", 4);
  const Moment asked = ledger.Now();
  const std::int64_t num_stored = ledger.NumStoredFrames(kListed);
  EXPECT_EQ(num_stored, 5);
  ledger.OnStored(kListed, "robot", 9);
  map.set_num_frames(5);
  ledger.OnBackup(kListed, map, all, num_stored, asked, ledger.Now());
  EXPECT_EQ(ledger.complaints(), Complaints());
  map.set_num_frames(4);
  ledger.OnBackup(kListed, map, all, num_stored, asked, ledger.Now());
  ASSERT_EQ(ledger.complaints().size(), 1u);
  EXPECT_TRUE(ledger.complaints()[0].starts_with("law 6:")) << ledger.complaints()[0];
}

TEST(Backups, HaveEditsThatWereMadeBefore) {
  Ledger ledger;
  const auto list = ledger.BeginList({{.plan = {.what = "copy",
                                                .history = kListed,
                                                .change = {.presence = Presence::kThere, .display_name = "rig-a"},
                                                .before = {.presence = Presence::kGone}}}});
  ASSERT_TRUE(list);
  const Moment early = ledger.Now();
  ledger.OnListMade(*list, {11}, 5);
  ledger.OnBackup(kListed, {}, {}, 0, early, ledger.Now());
  EXPECT_EQ(ledger.complaints(), Complaints()) << "it was made meanwhile";
  ledger.OnBackup(kListed, {}, {}, 0, ledger.Now(), ledger.Now());
  EXPECT_EQ(ledger.complaints().size(), 1u);
}

}  // namespace
}  // namespace dhpmap::rig
