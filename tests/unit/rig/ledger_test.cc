// SPDX-License-Identifier: BSD-3-Clause
// Each law with answers that keep it and answers that break it: a ledger that never complains would be worthless.
#include "tests/rig/ledger/ledger.h"

#include <gtest/gtest.h>

#include <string>

namespace dhpmap::rig {
namespace {

constexpr const char* kHistory = "h1";

v1::Submap Chair(std::int64_t id, std::int64_t revision, std::int64_t edited_revision = 0) {
  v1::Submap submap;
  submap.set_name("maps/room/submaps/" + std::to_string(id));
  submap.set_instance_id(id);
  submap.set_kind(v1::LabelClass::THING);
  submap.set_class_id(1);
  submap.set_class_name("chair");
  submap.set_display_name("chair " + std::to_string(id));
  submap.set_first_observed_stamp_ns(1000 + id);
  submap.set_revision(revision);
  submap.set_etag(std::string(kHistory) + "-s" + std::to_string(id) + "-r" + std::to_string(revision) + "-e" +
                  std::to_string(edited_revision));
  return submap;
}

v1::ListSubmapsResponse Listing(std::int64_t revision, const std::vector<v1::Submap>& submaps) {
  v1::ListSubmapsResponse all;
  all.set_revision(revision);
  for (const v1::Submap& submap : submaps) *all.add_submaps() = submap;
  return all;
}

v1::Map Room(std::int64_t revision, std::int64_t num_frames) {
  v1::Map map;
  map.set_name("maps/room");
  map.set_history_id(kHistory);
  map.set_revision(revision);
  map.set_num_frames(num_frames);
  return map;
}

class LedgerLaws : public ::testing::Test {
 protected:
  void See(const v1::Submap& submap, std::int64_t map_revision) {
    ledger.OnSubmap(kHistory, submap, map_revision, ledger.Now());
  }
  EditId Begin(EditPlan plan, std::optional<NamedState> etag = std::nullopt) {
    plan.history = kHistory;
    const auto id = ledger.BeginEdit({.plan = std::move(plan), .etag = std::move(etag)});
    EXPECT_TRUE(id.has_value());
    return id.value_or(0);
  }
  EditId BeginDelete(std::int64_t id, std::optional<NamedState> etag = std::nullopt) {
    return Begin({.what = "delete", .id = id, .change = {.presence = Presence::kGone}}, std::move(etag));
  }
  void ExpectKept() { EXPECT_EQ(ledger.complaints(), Complaints()); }
  /// Exactly one complaint, of this law.
  void ExpectBroken(const std::string& law) {
    ASSERT_EQ(ledger.complaints().size(), 1u);
    EXPECT_TRUE(ledger.complaints()[0].starts_with(law + ":")) << ledger.complaints()[0];
  }

  Ledger ledger;
};

// 1. Names of states.

TEST_F(LedgerLaws, AStateMayBeSeenAgainAndChangeWithItsRevision) {
  See(Chair(6, 10), 10);
  See(Chair(6, 10), 12);
  v1::Submap relabelled = Chair(6, 13);
  relabelled.set_class_id(2);
  See(relabelled, 13);
  ExpectKept();
}

TEST_F(LedgerLaws, TheSofaThatHasTheChairsEtag) {
  See(Chair(6, 10), 10);
  v1::Submap sofa = Chair(6, 10);
  sofa.set_class_id(2);
  sofa.set_class_name("sofa");
  See(sofa, 11);
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, AnIdOfAnotherObject) {
  See(Chair(6, 10), 10);
  v1::Submap other = Chair(6, 12);
  other.set_first_observed_stamp_ns(77);
  See(other, 12);
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, TwoObjectsWithOneEtag) {
  See(Chair(6, 10), 10);
  v1::Submap other = Chair(7, 10);
  other.set_etag(Chair(6, 10).etag());
  See(other, 10);
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, AnEtagThatStaysWhileFramesChangeWhatItNames) {
  See(Chair(6, 10), 10);
  v1::Submap later = Chair(6, 12);
  later.set_etag(Chair(6, 10).etag());
  See(later, 12);
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, AnEtagThatComesBackInAnotherHistory) {
  See(Chair(6, 10), 10);
  ledger.OnSubmap("h2", Chair(6, 10), 10, ledger.Now());
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, ARevisionOfTwoStatesOfTheMap) {
  ledger.OnListing(kHistory, Listing(10, {Chair(6, 10)}), ledger.Now());
  ledger.OnListing(kHistory, Listing(10, {Chair(6, 10), Chair(7, 9)}), ledger.Now());
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, ARevisionWithTwoSummaries) {
  ledger.OnMap(Room(10, 100), ledger.Now());
  ledger.OnMap(Room(10, 101), ledger.Now());
  ExpectBroken("law 1");
}

TEST_F(LedgerLaws, OtherVoxelsInTheSameState) {
  ledger.OnVoxels(kHistory, Chair(6, 10), "512 voxels");
  ledger.OnVoxels(kHistory, Chair(6, 11), "513 voxels");
  ExpectKept();
  ledger.OnVoxels(kHistory, Chair(6, 10), "511 voxels");
  ExpectBroken("law 1");
}

// 2. Revisions and lost states.

TEST_F(LedgerLaws, ARevisionMayBeOlderThanWhatWasToldOnlyAfterTheQuestion) {
  const Moment asked = ledger.Now();
  ledger.OnRevision(kHistory, 20, ledger.Now());
  ledger.OnRevision(kHistory, 19, asked);
  ExpectKept();
  ledger.OnRevision(kHistory, 19, ledger.Now());
  ExpectBroken("law 2");
}

TEST_F(LedgerLaws, ASubmapIsNotOfALaterRevisionThanItsMap) {
  See(Chair(6, 11), 10);
  ExpectBroken("law 2");
}

TEST_F(LedgerLaws, TokensOfLostStatesMustBeRefusedAndOthersNot) {
  const EditId edit = BeginDelete(7);
  ledger.OnPageToken(kHistory, "stored", 10);
  ledger.OnMade(edit, nullptr, 11);
  ledger.OnPageToken(kHistory, "nobody knows", 12);
  ledger.OnMap(Room(14, 60), ledger.Now());
  ledger.OnPageToken(kHistory, "lost", 15);
  ledger.OnRestarted(Room(1000, 59), Listing(1000, {}), ledger.Now());
  std::vector<KeptToken> tokens;
  for (std::uint64_t any = 0; any < 2; ++any) tokens.push_back(*ledger.TokenToAsk(kHistory, any));
  ASSERT_EQ(tokens[0].token, "stored");
  ASSERT_EQ(tokens[1].token, "lost");
  ledger.OnPage(kHistory, tokens[0], false, "");
  ledger.OnPage(kHistory, tokens[1], true, "");
  ExpectKept();
  ledger.OnPage(kHistory, tokens[1], false, "a page");
  ExpectBroken("law 2");
  ledger.OnPage(kHistory, tokens[0], true, "HISTORY_LOST");
  EXPECT_EQ(ledger.complaints().size(), 2u);
}

// 3 is edit_book_test; here that what was stored with an edit stays, too.

TEST_F(LedgerLaws, FramesThatWereStoredWithAnEdit) {
  ledger.OnMap(Room(10, 60), ledger.Now());
  const EditId edit = BeginDelete(7);
  ledger.OnMade(edit, nullptr, 11);
  ledger.OnRestarted(Room(1000, 59), Listing(1000, {}), ledger.Now());
  ExpectBroken("law 3");
}

TEST_F(LedgerLaws, AnEditOfASmallMapIsThereOrNot) {
  const Wish wish{.presence = Presence::kThere, .display_name = "rig-1"};
  const EditId made = *ledger.BeginMapEdit(1, "create", wish, false);
  v1::Map map = Room(1, 0);
  map.set_display_name("rig-1");
  ledger.OnMapMade(made, &map);
  ledger.OnSeenMap(1, &map, ledger.Now());
  ledger.OnMapsRestarted({{1, map}}, ledger.Now());
  ExpectKept();
  ledger.OnSeenMap(1, nullptr, ledger.Now());
  ExpectBroken("law 3");
}

// 4. Sessions.

TEST_F(LedgerLaws, ASessionGoesOnAtOrBehindWhatItWasTold) {
  ledger.OnStored(kHistory, "robot", 41);
  ledger.OnResumed(kHistory, "robot", 41, 42);
  ledger.OnResumed(kHistory, "robot", 45, 46);
  ExpectKept();
  ledger.OnResumed(kHistory, "robot", 44, 45);
  ExpectBroken("law 4");
}

TEST_F(LedgerLaws, ASessionOfWhichNothingIsKnownAnyMore) {
  ledger.OnStored(kHistory, "robot", 41);
  ledger.OnResumed(kHistory, "robot", std::nullopt, 0);
  ExpectBroken("law 4");
}

TEST_F(LedgerLaws, FramesWithoutTheirSession) {
  ledger.OnResumed(kHistory, "robot", 41, 43);
  ExpectBroken("law 4");
}

// 5. Stale etags.

TEST_F(LedgerLaws, AnEditWithThePresentEtagMayBeMade) {
  See(Chair(6, 10), 10);
  ledger.OnMade(BeginDelete(6, NamedState{{kHistory, 6}, 10}), nullptr, 11);
  ExpectKept();
  EXPECT_EQ(ledger.tally().num_stale_edits, 0);
}

TEST_F(LedgerLaws, AnEditWithAnEtagOfBeforeFramesMayBeMade) {
  See(Chair(6, 10, 9), 10);
  See(Chair(6, 12, 9), 12);
  ledger.OnMade(BeginDelete(6, NamedState{{kHistory, 6}, 10, 9}), nullptr, 13);
  ExpectKept();
  EXPECT_EQ(ledger.tally().num_stale_edits, 0);
}

TEST_F(LedgerLaws, AnEditWithAnEtagOfBeforeAnotherEdit) {
  See(Chair(6, 10), 10);
  See(Chair(6, 12, 11), 12);
  const EditId refused = BeginDelete(6, NamedState{{kHistory, 6}, 10});
  ledger.OnRefused(refused);
  ExpectKept();
  EXPECT_EQ(ledger.tally().num_stale_edits, 1);
  ledger.OnMade(BeginDelete(6, NamedState{{kHistory, 6}, 10}), nullptr, 13);
  ExpectBroken("law 5");
}

TEST_F(LedgerLaws, AnEtagThatACrashHasMadeThePresentOneAgain) {
  See(Chair(6, 10), 10);
  See(Chair(6, 12), 12);  // which was never stored
  ledger.OnRestarted(Room(1000, 0), Listing(1000, {Chair(6, 10)}), ledger.Now());
  ledger.OnMade(BeginDelete(6, NamedState{{kHistory, 6}, 10}), nullptr, 1001);
  ExpectKept();
}

TEST_F(LedgerLaws, AnEditWithAnEtagThatACrashHasLost) {
  See(Chair(6, 10), 10);
  See(Chair(6, 12), 12);
  ledger.OnRestarted(Room(1000, 0), Listing(1000, {Chair(6, 10)}), ledger.Now());
  ledger.OnMade(BeginDelete(6, NamedState{{kHistory, 6}, 12}), nullptr, 1001);
  ExpectBroken("law 5");
}

TEST_F(LedgerLaws, AnEditWithAnEtagOfAnObjectThatACrashHasLost) {
  See(Chair(6, 12), 12);
  ledger.OnRestarted(Room(1000, 0), Listing(1000, {}), ledger.Now());
  ledger.OnMade(BeginDelete(6, NamedState{{kHistory, 6}, 12}), nullptr, 1001);
  ExpectBroken("law 5");
}

TEST_F(LedgerLaws, AnEditWithAnEtagOfAMapOfBefore) {
  ledger.OnMade(BeginDelete(6, NamedState{{"h0", 6}, 10}), nullptr, 11);
  ExpectBroken("law 5");
}

TEST_F(LedgerLaws, AnEditWithAnEtagOfAMapOfBeforeThatIsCutOffSaysNothingOfAnIdThatIsFree) {
  ledger.OnCut(BeginDelete(12, NamedState{{"h0", 12}, 10}));
  ledger.OnRestarted(Room(1000, 0), Listing(1000, {}), ledger.Now());
  See(Chair(12, 1001), 1001);
  ExpectKept();
}

TEST_F(LedgerLaws, ACopyOfAnObjectByAStaleEtag) {
  See(Chair(6, 12, 12), 12);
  const EditPlan plan{
      .what = "copy", .change = {.presence = Presence::kThere}, .before = {.presence = Presence::kGone}};
  const EditId edit = Begin(plan, NamedState{{kHistory, 6}, 10});
  const v1::Submap copy = Chair(8, 13);
  ledger.OnMade(edit, &copy, 13);
  ExpectBroken("law 5");
}

TEST_F(LedgerLaws, AStaleEtagOfASmallMap) {
  const EditId edit =
      *ledger.BeginMapEdit(1, "create", {.presence = Presence::kThere, .display_name = "rig-1"}, /*is_stale=*/true);
  ledger.OnMapMade(edit, nullptr);
  ExpectBroken("law 5");
}

}  // namespace
}  // namespace dhpmap::rig
