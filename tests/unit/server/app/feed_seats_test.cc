// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feed_seat.h"

#include <gtest/gtest.h>

#include <vector>

namespace dhpmap {
namespace {

using namespace std::chrono_literals;

class FeedSeatTest : public ::testing::Test {
 protected:
  /// A request that notes what its feed is told.
  FeedRequest Request(const std::string& session = "", bool take_over = false) {
    return {
        .session = session, .take_over = take_over, .on_evicted = [this](const Status& why) { told.push_back(why); }};
  }

  Feed::Clock::time_point now{1h};
  FeedSeat seat{30s, [this] { return now; }};
  std::vector<Status> told;
};

TEST_F(FeedSeatTest, OneFeedsAndTheOthersAreTurnedAway) {
  const auto first = *seat.Take(Request());
  EXPECT_TRUE(first->MayFeed().ok());
  const Status second = seat.Take(Request()).status();
  EXPECT_EQ(second.code(), StatusCode::kAborted);
  EXPECT_EQ(second.reason(), Reason("MAP_IS_FED"));
  EXPECT_EQ(seat.Close().code(), StatusCode::kFailedPrecondition);
  EXPECT_TRUE(first->MayFeed().ok());
  seat.Leave(first);
  EXPECT_EQ(first->MayFeed().code(), StatusCode::kAborted);
  EXPECT_TRUE(seat.Take(Request()).ok());
  EXPECT_TRUE(told.empty()) << "nobody was evicted";
}

TEST_F(FeedSeatTest, WhoTakesOverGetsItAtOnceAndTheFirstIsTold) {
  const auto first = *seat.Take(Request("a"));
  first->OnFrameBegun();
  const auto second = seat.Take(Request("b", true));
  ASSERT_TRUE(second.ok());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code(), StatusCode::kAborted);
  EXPECT_EQ(told[0].reason(), Reason("FEED_TAKEN_OVER"));
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_TAKEN_OVER"));
  seat.Leave(first);  // too late: the place is the second's
  EXPECT_TRUE((*second)->MayFeed().ok());
  EXPECT_EQ(seat.Take(Request("c")).status().reason(), Reason("MAP_IS_FED"));
  EXPECT_EQ(told.size(), 1u);
}

TEST_F(FeedSeatTest, AClientThatComesBackTakesThePlaceOfItsOwnOldConnection) {
  const auto first = *seat.Take(Request("robot"));
  EXPECT_TRUE(seat.Take(Request("robot")).ok());
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_TAKEN_OVER"));
  EXPECT_EQ(seat.Take(Request("")).status().reason(), Reason("MAP_IS_FED"));

  FeedSeat other(30s, [this] { return now; });
  ASSERT_TRUE(other.Take(Request("")).ok());
  EXPECT_EQ(other.Take(Request("")).status().reason(), Reason("MAP_IS_FED")) << "no session is nobody's own";
}

TEST_F(FeedSeatTest, AnIdleFeedMakesPlaceForAnother) {
  const auto first = *seat.Take(Request());
  now += 29s;
  EXPECT_FALSE(seat.Take(Request()).ok());
  now += 1s;
  const auto second = seat.Take(Request());
  ASSERT_TRUE(second.ok());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].reason(), Reason("FEED_IDLE"));
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_IDLE"));
}

TEST_F(FeedSeatTest, AFeedWithAFrameUnderWayIsNotIdle) {
  const auto first = *seat.Take(Request());
  first->OnFrameBegun();
  first->OnFrameBegun();
  now += 1h;
  EXPECT_FALSE(seat.Take(Request()).ok());
  first->OnFrameDone(now);
  now += 1h;
  EXPECT_FALSE(seat.Take(Request()).ok()) << "one is left";
  first->OnFrameDone(now);
  now += 29s;
  EXPECT_FALSE(seat.Take(Request()).ok());
  now += 1s;
  EXPECT_TRUE(seat.Take(Request()).ok());
}

TEST_F(FeedSeatTest, AnIdleFeedMakesPlaceForTheDeletionAndNobodyComesAfter) {
  const auto first = *seat.Take(Request());
  now += 30s;
  EXPECT_TRUE(seat.Close().ok());
  EXPECT_EQ(first->MayFeed().reason(), Reason("FEED_IDLE"));
  EXPECT_EQ(told.size(), 1u);
  EXPECT_EQ(seat.Take(Request("", true)).status().code(), StatusCode::kNotFound);
  EXPECT_EQ(seat.Close().code(), StatusCode::kNotFound);
  seat.Leave(first);
  EXPECT_EQ(seat.Take(Request()).status().code(), StatusCode::kNotFound);
  seat.Reopen();
  EXPECT_TRUE(seat.Take(Request()).ok());
}

TEST(Feed, KnowsTheNewestOfItsFramesThatAreStored) {
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

TEST(Feed, RemembersNoMoreFramesThanItMayAndNeverSaysTooMuch) {
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

}  // namespace
}  // namespace dhpmap
