// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/feed_seats.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dhpmap {
namespace {

using namespace std::chrono_literals;

class FeedSeatsTest : public ::testing::Test {
 protected:
  /// A request that records the end of its feed.
  FeedRequest Request(const std::string& session = "", bool take_over = false) {
    return {
        .session = session, .take_over = take_over, .on_evicted = [this](const Status& why) { told.push_back(why); }};
  }

  Feed::Clock::time_point now{1h};
  FeedSeats seats{30s, 3, [this] { return now; }};
  std::vector<Status> told;
};

TEST_F(FeedSeatsTest, OneStreamFeedsAndOthersAreRefused) {
  const auto first = *seats.Take(Request());
  EXPECT_TRUE(first->MayFeed().ok());
  const Status second = seats.Take(Request()).status();
  EXPECT_EQ(second.code(), StatusCode::kAborted);
  EXPECT_EQ(second.reason(), Reason("MAP_IS_FED"));
  EXPECT_EQ(seats.Close().code(), StatusCode::kFailedPrecondition);
  EXPECT_TRUE(first->MayFeed().ok());
  seats.Leave(first);
  EXPECT_EQ(first->MayFeed().code(), StatusCode::kAborted);
  EXPECT_TRUE(seats.Take(Request()).ok());
  EXPECT_TRUE(told.empty()) << "nobody was evicted";
}

TEST_F(FeedSeatsTest, SessionsFeedInParallelAndAnUnnamedStreamFeedsAlone) {
  const auto a = seats.Take(Request("a")), b = seats.Take(Request("b"));
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(seats.Take(Request("")).status().reason(), Reason("MAP_IS_FED"));
  now += 29s;
  (*b)->OnFrameBegun();
  (*b)->OnFrameDone(now);
  now += 1s;  // a is idle, b is not
  EXPECT_EQ(seats.Take(Request("")).status().reason(), Reason("MAP_IS_FED"));
  EXPECT_TRUE((*a)->MayFeed().ok()) << "who is turned away ends nobody";
  now += 29s;
  const auto alone = seats.Take(Request(""));
  ASSERT_TRUE(alone.ok());
  EXPECT_EQ((*a)->MayFeed().reason(), Reason("FEED_IDLE"));
  EXPECT_EQ((*b)->MayFeed().reason(), Reason("FEED_IDLE"));
  EXPECT_EQ(seats.Take(Request("c")).status().reason(), Reason("MAP_IS_FED"));
  EXPECT_EQ(told.size(), 2u);
}

TEST_F(FeedSeatsTest, AnIdleSessionIsReplacedOnlyWhenItsPlaceIsNeeded) {
  const auto a = *seats.Take(Request("a"));
  now += 10s;
  const auto b = *seats.Take(Request("b"));
  ASSERT_TRUE(seats.Take(Request("c")).ok());
  EXPECT_EQ(seats.Take(Request("d")).status().reason(), Reason("TOO_MANY_FEEDS"));
  now += 1h;
  EXPECT_TRUE(a->MayFeed().ok() && b->MayFeed().ok());
  EXPECT_TRUE(seats.Take(Request("d")).ok());
  EXPECT_EQ(a->MayFeed().reason(), Reason("FEED_IDLE")) << "it was silent for longest";
  EXPECT_TRUE(b->MayFeed().ok());
  EXPECT_EQ(seats.Feeds().size(), 3u);
}

TEST_F(FeedSeatsTest, ATakeoverEndsAllOtherStreams) {
  const auto first = *seats.Take(Request("a"));
  const auto other = *seats.Take(Request("b"));
  first->OnFrameBegun();
  const auto last = seats.Take(Request("c", true));
  ASSERT_TRUE(last.ok());
  ASSERT_EQ(told.size(), 2u);
  for (const Status& why : told) {
    EXPECT_EQ(why.code(), StatusCode::kAborted);
    EXPECT_EQ(why.reason(), Reason("FEED_TAKEN_OVER"));
  }
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_TAKEN_OVER"));
  EXPECT_EQ(other->MayFeed().reason(), Reason("FEED_TAKEN_OVER"));
  seats.Leave(first);  // too late
  EXPECT_TRUE((*last)->MayFeed().ok());
  EXPECT_EQ(seats.Feeds().size(), 1u);
}

TEST_F(FeedSeatsTest, AnEndedSessionMayBeginAgain) {
  const auto a = *seats.Take(Request("a"));
  const auto b = *seats.Take(Request("b"));
  EXPECT_TRUE(seats.End("a").ok());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code(), StatusCode::kAborted);
  EXPECT_EQ(told[0].reason(), Reason("SESSION_ENDED"));
  EXPECT_EQ(a->MayFeed().reason(), Reason("SESSION_ENDED"));
  EXPECT_TRUE(b->MayFeed().ok());
  EXPECT_EQ(seats.End("a").reason(), Reason("SESSION_NOT_FOUND"));
  EXPECT_EQ(seats.End("").reason(), Reason("SESSION_NOT_FOUND"));
  EXPECT_TRUE(seats.Take(Request("a")).ok());
}

TEST_F(FeedSeatsTest, CountsOfASessionOutlastItsStreamsAndAreBounded) {
  const auto first = *seats.Take(Request("robot"));
  first->tally().OnMessage(100, 5);
  seats.Leave(first);
  const auto second = *seats.Take(Request("robot"));
  second->tally().OnMessage(20, 6);
  EXPECT_EQ(seats.Tallies().at("robot")->Counts(7).num_bytes, 120);
  for (int i = 0; i < 400; ++i) {
    const auto feed = *seats.Take(Request("s" + std::to_string(i)));
    feed->tally().OnMessage(1, 1000 + i);
    second->tally().OnMessage(0, 1000 + i);
    seats.Leave(feed);
  }
  EXPECT_EQ(seats.Tallies().size(), FeedSeats::kMostTallies);
  EXPECT_TRUE(seats.Tallies().contains("robot"));
  EXPECT_TRUE(seats.Tallies().contains("s399"));
  EXPECT_FALSE(seats.Tallies().contains("s0"));
}

TEST(FeedTally, TheRateIsThatOfTheLastSeconds) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  FeedTally tally;
  EXPECT_EQ(tally.Counts(0).frames_per_s, 0);
  std::int64_t now = 100 * kSecond_ns;
  for (int i = 0; i < 100; ++i, now += kSecond_ns / 5) {
    tally.OnMessage(10, now);
    tally.OnFused(i, 7, now);
  }
  EXPECT_NEAR(tally.Counts(now).frames_per_s, 5, 0.2);
  EXPECT_EQ(tally.Counts(now).num_fused, 100);
  EXPECT_EQ(tally.Counts(now).num_points, 700);
  EXPECT_EQ(tally.Counts(now).num_bytes, 1000);
  EXPECT_EQ(tally.Counts(now).accepted_sequence, 99);
  EXPECT_NEAR(tally.Counts(now + 5 * kSecond_ns).frames_per_s, 2.5, 0.2);
  EXPECT_EQ(tally.Counts(now + 11 * kSecond_ns).frames_per_s, 0);
  for (int i = 0; i < 5000; ++i, now += kSecond_ns / 500) tally.OnFused(i, 1, now);  // more than are remembered
  EXPECT_NEAR(tally.Counts(now).frames_per_s, 500, 20);
}

TEST(FeedTally, KeepsTheLastWarningAndCountsLaterFrames) {
  FeedTally tally;
  tally.OnChecked({});
  EXPECT_FALSE(tally.Counts(0).last_warning);
  EXPECT_EQ(tally.Counts(0).num_plausible_since, 0) << "after no warning";
  tally.OnChecked({{FrameFault::kStampRepeated, "again"}});
  tally.OnChecked({});
  tally.OnChecked({{FrameFault::kPoseInverted, "inverted"}, {FrameFault::kStampWentBack, "back"}});
  tally.OnChecked({});
  tally.OnChecked({});
  const FeedCounts counts = tally.Counts(0);
  EXPECT_EQ(counts.num_implausible, 2);
  ASSERT_TRUE(counts.last_warning);
  EXPECT_EQ(counts.last_warning->fault, FrameFault::kPoseInverted);
  EXPECT_EQ(counts.last_warning->message, "inverted");
  EXPECT_EQ(counts.num_plausible_since, 2);
}

TEST_F(FeedSeatsTest, AReconnectedClientReplacesItsOldConnection) {
  const auto first = *seats.Take(Request("robot"));
  const auto other_robot = *seats.Take(Request("other"));
  EXPECT_TRUE(seats.Take(Request("robot")).ok());
  EXPECT_TRUE(other_robot->MayFeed().ok());
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_TAKEN_OVER"));
  EXPECT_EQ(seats.Take(Request("")).status().reason(), Reason("MAP_IS_FED"));

  FeedSeats other(30s, 3, [this] { return now; });
  ASSERT_TRUE(other.Take(Request("")).ok());
  EXPECT_EQ(other.Take(Request("")).status().reason(), Reason("MAP_IS_FED")) << "no session is nobody's own";
}

TEST_F(FeedSeatsTest, AnIdleFeedIsReplacedByAnother) {
  const auto first = *seats.Take(Request());
  now += 29s;
  EXPECT_FALSE(seats.Take(Request()).ok());
  now += 1s;
  const auto second = seats.Take(Request());
  ASSERT_TRUE(second.ok());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].reason(), Reason("FEED_IDLE"));
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_IDLE"));
}

TEST_F(FeedSeatsTest, AFeedWithAFrameInFlightIsNotIdle) {
  const auto first = *seats.Take(Request());
  first->OnFrameBegun();
  first->OnFrameBegun();
  now += 1h;
  EXPECT_FALSE(seats.Take(Request()).ok());
  first->OnFrameDone(now);
  now += 1h;
  EXPECT_FALSE(seats.Take(Request()).ok()) << "one is left";
  first->OnFrameDone(now);
  now += 29s;
  EXPECT_FALSE(seats.Take(Request()).ok());
  now += 1s;
  EXPECT_TRUE(seats.Take(Request()).ok());
}

TEST_F(FeedSeatsTest, ADeletionEndsIdleFeedsAndRefusesNewOnes) {
  const auto first = *seats.Take(Request());
  now += 30s;
  EXPECT_TRUE(seats.Close().ok());
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_IDLE"));
  EXPECT_EQ(told.size(), 1u);
  EXPECT_EQ(seats.Take(Request("", true)).status().code(), StatusCode::kNotFound);
  EXPECT_EQ(seats.Close().code(), StatusCode::kNotFound);
  seats.Leave(first);
  EXPECT_EQ(seats.Take(Request()).status().code(), StatusCode::kNotFound);
  seats.Reopen();
  EXPECT_TRUE(seats.Take(Request()).ok());
}

TEST(Feed, KnowsItsNewestStoredFrame) {
  Feed feed({}, {});
  EXPECT_FALSE(feed.StoredUpTo(100).has_value()) << "those are other feeds' frames";
  feed.OnFused(101, 7);
  feed.OnFused(102, 7);
  feed.OnFused(104, -2);  // another frame of the map came between
  EXPECT_FALSE(feed.StoredUpTo(100).has_value());
  EXPECT_EQ(feed.StoredUpTo(101), 7);
  EXPECT_EQ(feed.StoredUpTo(103), 7);
  EXPECT_EQ(feed.StoredUpTo(104), -2);
  EXPECT_EQ(feed.StoredUpTo(200), -2);
}

TEST(Feed, RemembersALimitedNumberOfFramesAndNeverOverstatesProgress) {
  Feed feed({}, {});
  const int num_frames = static_cast<int>(Feed::kMaxRemembered) + 500;
  for (int i = 1; i <= num_frames; ++i) feed.OnFused(i, i);
  for (int stored = 0; stored <= num_frames; stored += 10) {
    const auto told = feed.StoredUpTo(stored);
    EXPECT_LE(told.value_or(0), stored);
    if (stored < static_cast<int>(Feed::kMaxRemembered)) {
      EXPECT_EQ(told.value_or(0), stored);
    }
  }
  EXPECT_EQ(feed.StoredUpTo(num_frames), num_frames);
}

TEST_F(FeedSeatsTest, WhenTheMapMovesAllFeedsEndWithTheOwnerAndNewOnesAreRefused) {
  const auto a = *seats.Take(Request("a")), b = *seats.Take(Request("b"));
  seats.MoveAway(Unavailable("moved").WithReason("NOT_OWNER").WithMetadata("owner", "two:2"));
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].reason(), Reason("NOT_OWNER"));
  EXPECT_EQ(told[1].metadata().front().second, "two:2");
  EXPECT_EQ(a->MayFeed().reason(), Reason("NOT_OWNER"));
  EXPECT_EQ(seats.Take(Request("c")).status().reason(), Reason("NOT_OWNER"));
  seats.Leave(b);
  EXPECT_EQ(b->MayFeed().reason(), Reason("NOT_OWNER")) << "once ended it stays so";
}

}  // namespace
}  // namespace dhpmap
