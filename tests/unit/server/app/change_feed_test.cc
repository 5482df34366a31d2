// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/watch/change_feed.h"

#include <gtest/gtest.h>

#include <limits>

#include "server/app/watch/watch_position.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap {
namespace {

/// A memory store that counts how often its changes are read.
class CountingStore final : public testing::WrappedStore {
 public:
  CountingStore() : WrappedStore(MakeMemoryStore({.max_changes = 50})) {}
  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after, std::size_t max_bytes) override {
    ++num_reads;
    return inner().ListChanges(name, after, max_bytes);
  }

  int num_reads = 0;
};

class ChangeFeedTest : public ::testing::Test {
 protected:
  ChangeFeedTest() { Create(); }
  void Create() {
    MapInfo info;
    info.name = "room";
    info.history_id = ++history_;
    info.create_time_ns = history_;
    map_ = std::make_unique<Map>(info);
    EXPECT_TRUE(store_.CreateMap(*map_->Publish(1)).ok());
    feed_.Notify("room");
  }
  void Commit(int count = 1, int num_submaps = 0) {
    for (int n = 0; n < count; ++n) {
      const auto before = map_->published();
      map_->mutable_info().num_frames += 1;
      for (int i = 0; i < num_submaps; ++i) map_->Create({});
      EXPECT_TRUE(store_.Commit(*before, *map_->Publish(2), Durability::kNormal).ok());
      feed_.Notify("room");
    }
  }
  std::unique_ptr<ChangeFeed::Follower> Follow() {
    return std::move(*feed_.Follow("room", [this] { ++num_woken_; }));
  }
  /// Last revisions of the changes from a position to the end.
  std::vector<std::int64_t> ReadFrom(std::int64_t after) {
    std::vector<std::int64_t> read;
    while (true) {
      const auto list = feed_.Read("room", after);
      EXPECT_TRUE(list.ok()) << list.status().ToString();
      if (!list.ok() || list->changes.empty()) return read;
      for (const auto& change : list->changes) read.push_back(after = change->last_revision);
    }
  }

  CountingStore store_;
  ChangeFeed feed_{store_, 3};
  std::uint64_t history_ = 0;
  std::unique_ptr<Map> map_;
  int num_woken_ = 0;
};

TEST_F(ChangeFeedTest, WakesTheFollowersOfAMapUntilTheyLeave) {
  auto one = Follow();
  const auto other = std::move(*feed_.Follow("elsewhere", [] { FAIL() << "nothing happened there"; }));
  Commit();
  EXPECT_EQ(num_woken_, 1);
  one = nullptr;
  Commit();
  EXPECT_EQ(num_woken_, 1);
}

TEST_F(ChangeFeedTest, FollowersBeyondTheLimitAreRefused) {
  auto one = Follow(), two = Follow(), three = Follow();
  const auto refused = feed_.Follow("room", [] {});
  EXPECT_EQ(refused.status().reason(), Reason("TOO_MANY_WATCHERS"));
  EXPECT_EQ(feed_.num_followers(), 3u);
  two = nullptr;
  EXPECT_TRUE(feed_.Follow("room", [] {}).ok());
}

TEST_F(ChangeFeedTest, TheStoreIsReadOnceForAllFollowers) {
  const auto follower = Follow();
  const std::int64_t now = feed_.Read("room", std::numeric_limits<std::int64_t>::max())->revision;
  EXPECT_EQ(now, 1);
  Commit();
  store_.num_reads = 0;
  for (int n = 0; n < 100; ++n) EXPECT_EQ(ReadFrom(1), std::vector<std::int64_t>{2});
  EXPECT_EQ(store_.num_reads, 1);
  Commit(3);
  for (int n = 0; n < 100; ++n) EXPECT_EQ(ReadFrom(n % 2 == 0 ? 1 : 2).back(), 5);
  EXPECT_EQ(store_.num_reads, 2);
}

TEST_F(ChangeFeedTest, AgreesWithTheStoreFromAnyPosition) {
  const auto follower = Follow();
  for (int round = 0; round < 12; ++round) {
    Commit(1 + round % 4, round % 5 == 0 ? 3000 : 1);  // some too large to be kept
    const std::int64_t now = map_->published()->revision();
    for (std::int64_t after = 0; after <= now; ++after) {
      std::vector<std::int64_t> expected;
      for (std::int64_t revision = after + 1; revision <= now; ++revision) expected.push_back(revision);
      ASSERT_EQ(ReadFrom(after), expected) << "round " << round << " after " << after;
    }
  }
}

TEST_F(ChangeFeedTest, PagesHaveABoundedSizeFromCacheAndStore) {
  auto follower = Follow();
  Commit(50, 60);
  ASSERT_GT(ReadFrom(1).size(), 40u);
  for (int round = 0; round < 2; ++round) {
    if (round == 1) follower = nullptr;  // nothing is kept
    for (std::int64_t after = 1; after < 51;) {
      const auto page = feed_.Read("room", after);
      ASSERT_TRUE(page.ok());
      ASSERT_FALSE(page->changes.empty());
      std::size_t num_bytes = 0;
      for (const auto& change : page->changes) num_bytes += BytesOf(*change);
      EXPECT_LT(num_bytes - BytesOf(*page->changes.back()), ChangeFeed::kPage_bytes);
      EXPECT_EQ(page->has_more, page->changes.back()->last_revision < 51);
      after = page->changes.back()->last_revision;
    }
  }
}

TEST_F(ChangeFeedTest, OnlyPositionsBeforeTheKeptHistoryAreCompacted) {
  const auto follower = Follow();
  EXPECT_EQ(ReadFrom(0).size(), 1u);
  Commit(80);
  EXPECT_EQ(feed_.Read("room", 20).status().reason(), Reason("COMPACTED"));
  EXPECT_EQ(ReadFrom(60).size(), 21u);
}

TEST_F(ChangeFeedTest, ADeletedMapIsNotFoundAndANewOneHasItsOwnChanges) {
  const auto follower = Follow();
  Commit(5);
  EXPECT_EQ(ReadFrom(0).size(), 6u);
  ASSERT_TRUE(store_.DeleteMap("room").ok());
  feed_.Notify("room");
  EXPECT_EQ(feed_.Read("room", 3).status().code(), StatusCode::kNotFound);
  Create();
  const auto list = feed_.Read("room", 0);
  ASSERT_TRUE(list.ok());
  EXPECT_EQ(list->history_id, 2u);
  EXPECT_EQ(list->changes.size(), 1u);
}

TEST_F(ChangeFeedTest, IsReadableWithoutFollowing) { EXPECT_EQ(ReadFrom(0), std::vector<std::int64_t>{1}); }

TEST(WatchPosition, RoundTripsAsText) {
  for (const WatchPosition& position :
       {WatchPosition{1, 0}, WatchPosition{0x7fff'ffff'ffff'ffff, std::int64_t{1} << 62}}) {
    EXPECT_EQ(ParsePosition(PositionText(position)), position);
  }
  EXPECT_EQ(PositionText({0xab, 7}), "00000000000000ab-7");
  for (const char* text :
       {"", "7", "ab-7", "00000000000000ab-", "00000000000000ab-x", "00000000000000ab--1", "00000000000000ab-7 ",
        "0000000000000xab-7", "00000000000000ab-9223372036854775807", "00000000000000ab-99999999999999999999"}) {
    EXPECT_FALSE(ParsePosition(text)) << text;
  }
}

TEST(WatchPosition, BeforeAStartIsTheStateKnownThen) {
  MapInfo map;
  map.history_id = 5;
  map.revision = 40;
  const LostRevisions lost = {{11, 20}};
  const auto before = [&](WatchStart start) { return PositionBefore(start, map, lost); };
  EXPECT_FALSE(before({.revision = 0, .history_id = std::nullopt})->has_value());
  EXPECT_FALSE(before({.revision = 0, .history_id = 5})->has_value());
  EXPECT_EQ(**before({.revision = 1, .history_id = 5}), (WatchPosition{5, 0}));
  EXPECT_EQ(**before({.revision = 41, .history_id = std::nullopt}), (WatchPosition{5, 40}));
  EXPECT_EQ(**before({.revision = 11, .history_id = 5}), (WatchPosition{5, 10})) << "what is known is not lost";
  for (const WatchStart& start :
       {WatchStart{.revision = 42, .history_id = std::nullopt}, WatchStart{.revision = 12, .history_id = 5},
        WatchStart{.revision = 21, .history_id = 5}, WatchStart{.revision = 0, .history_id = 6}}) {
    EXPECT_EQ(before(start).status().reason(), Reason("HISTORY_LOST")) << start.revision;
  }
}

}  // namespace
}  // namespace dhpmap
