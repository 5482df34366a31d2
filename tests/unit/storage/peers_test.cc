// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/fleet/peers.h"

#include <gtest/gtest.h>

#include <vector>

namespace dhpmap::postgres {
namespace {

using Verdict = Peers::Verdict;

constexpr std::int64_t kSecond = 1'000'000'000;

/// We are server 1, with a lease of 2 s; server 2 is the other.
class PeersTest : public ::testing::Test {
 protected:
  void Beat(std::int64_t beat_of_other) {
    rows_ = {{.server = 1, .beat = ++own_beat_}, {.server = 2, .beat = beat_of_other, .address = "two"}};
    peers_.OnBeaten(now_ns_, rows_);
  }
  Verdict OnOther() { return peers_.OpinionOf(2).verdict; }

  std::int64_t now_ns_ = 100 * kSecond;
  std::int64_t own_beat_ = 0;
  std::vector<ServerRow> rows_;
  Peers peers_{1, 2, [this] { return now_ns_; }};
};

TEST_F(PeersTest, WhoHasNotBeenSeenToBeatIsUnclearAndThenDead) {
  Beat(7);
  EXPECT_EQ(OnOther(), Verdict::kUnclear);
  for (int n = 0; n < 3; ++n) {
    now_ns_ += kSecond * 3 / 4;
    Beat(7);
  }
  EXPECT_EQ(OnOther(), Verdict::kDead) << "after 2.25 s";
  EXPECT_EQ(peers_.OpinionOf(2).beat, 7);
  Beat(8);
  EXPECT_EQ(OnOther(), Verdict::kAlive) << "it beats again";
}

TEST_F(PeersTest, WhoBeatsIsAliveUntilALeaseAfterItsLastBeat) {
  Beat(7);
  Beat(8);
  EXPECT_EQ(OnOther(), Verdict::kAlive);
  for (const std::int64_t step_ns : {kSecond * 3 / 4, kSecond * 3 / 4, kSecond / 2}) {
    now_ns_ += step_ns;
    Beat(8);
  }
  EXPECT_EQ(OnOther(), Verdict::kAlive) << "a lease ago, and no longer";
  now_ns_ += 1;
  EXPECT_EQ(OnOther(), Verdict::kDead);
}

TEST_F(PeersTest, ASilentDatabaseKillsNoServer) {
  Beat(7);
  Beat(8);
  now_ns_ += 5 * kSecond;
  EXPECT_EQ(OnOther(), Verdict::kUnclear) << "own beats fail as well";
  Beat(8);
  EXPECT_NE(OnOther(), Verdict::kDead) << "the other has had no time to beat";
  now_ns_ += kSecond / 2;
  Beat(9);
  EXPECT_EQ(OnOther(), Verdict::kAlive);
}

TEST_F(PeersTest, OneMayAnswerForHalfALeaseAfterTheSendingOfABeat) {
  EXPECT_FALSE(peers_.IsFresh()) << "before the first beat";
  Beat(7);
  EXPECT_TRUE(peers_.IsFresh());
  now_ns_ += kSecond - 1;
  EXPECT_TRUE(peers_.IsFresh());
  now_ns_ += 1;
  EXPECT_FALSE(peers_.IsFresh());
}

TEST_F(PeersTest, ABeatThatWasOnItsWayForHalfALeaseDoesNotMakeFresh) {
  Beat(7);
  const std::int64_t sent_ns = now_ns_ + kSecond / 10;
  now_ns_ = sent_ns + kSecond;
  peers_.OnBeaten(sent_ns, rows_);
  EXPECT_FALSE(peers_.IsFresh());
  EXPECT_TRUE(peers_.ComesLate(now_ns_)) << "so what is ours is looked through before the next makes fresh";
}

TEST_F(PeersTest, ABeatComesLateHalfALeaseAfterTheLastOne) {
  EXPECT_FALSE(peers_.ComesLate(now_ns_)) << "the first one";
  Beat(7);
  EXPECT_FALSE(peers_.ComesLate(now_ns_ + kSecond - 1));
  EXPECT_TRUE(peers_.ComesLate(now_ns_ + kSecond));
}

TEST_F(PeersTest, WhoHasNoRowIsWatchedForALease) {
  Beat(7);
  EXPECT_EQ(peers_.OpinionOf(3).verdict, Verdict::kUnclear);
  EXPECT_EQ(peers_.OpinionOf(3).beat, Peers::kNoRow);
  for (int n = 0; n < 3; ++n) {
    now_ns_ += kSecond * 3 / 4;
    Beat(8 + n);
  }
  EXPECT_EQ(peers_.OpinionOf(3).verdict, Verdict::kDead);
  EXPECT_FALSE(peers_.Find(3)) << "it has no address";
}

TEST_F(PeersTest, TakersAreTheOthersThatLiveAndDoNotDrain) {
  Beat(7);
  Beat(8);
  EXPECT_EQ(peers_.Takers(), std::vector<std::int64_t>{2});
  rows_[1].beat = 9;
  rows_[1].is_draining = true;
  peers_.OnBeaten(now_ns_, rows_);
  EXPECT_TRUE(peers_.Takers().empty());
}

}  // namespace
}  // namespace dhpmap::postgres
