// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/snapshot_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "server/app/states/state_bytes.h"

namespace dhpmap {
namespace {

constexpr SubmapId kKeptThing{1};

/// A map with one thing of 10 blocks.
class SnapshotHistoryTest : public ::testing::Test {
 protected:
  SnapshotHistoryTest() {
    map_.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
    Write(0, 10);
  }
  void Write(int begin, int end) {
    for (int x = begin; x < end; ++x) map_.FindMutable(kKeptThing)->MutableTsdf({x, 0, 0}).weight[0] += 1;
  }
  SnapshotHistory::State Next(int num_blocks) {
    Write(0, num_blocks);
    return map_.Publish(0);
  }
  static std::string Text(const SnapshotHistory::Neighbours& nearest) {
    const auto text = [](const std::optional<std::int64_t>& revision) {
      return revision ? std::to_string(*revision) : std::string("none");
    };
    return text(nearest.before) + " " + text(nearest.after);
  }
  static SnapshotHistory::View ViewOf(SnapshotHistory::State state) {
    return std::make_shared<const MapView>(std::move(state));
  }

  std::shared_ptr<ByteBudget> budget_ = std::make_shared<ByteBudget>(std::size_t{1} << 30);
  Map map_{MapInfo{.name = "m", .history_id = 7}};
};

TEST_F(SnapshotHistoryTest, FindsExactlyTheStoredStates) {
  SnapshotHistory kept(64, budget_);
  const auto first = Next(1);
  const auto passed_over = Next(1);
  const auto last = Next(1);
  kept.Keep(first);
  kept.Keep(last);
  ASSERT_NE(kept.Find(first->revision()), nullptr);
  EXPECT_EQ(kept.Find(first->revision())->shared_snapshot(), first);
  EXPECT_EQ(kept.Find(last->revision())->shared_snapshot(), last);
  EXPECT_EQ(kept.StateAt(first->revision()), first);
  EXPECT_EQ(kept.StateAt(passed_over->revision()), nullptr);
  EXPECT_EQ(kept.Find(passed_over->revision()), nullptr);
  EXPECT_EQ(Text(kept.Around(passed_over->revision())), "1 3");
  EXPECT_EQ(Text(kept.Around(0)), "none 1");
  EXPECT_EQ(Text(kept.Around(9)), "3 none");
}

TEST_F(SnapshotHistoryTest, AllReadersOfARevisionShareOneView) {
  SnapshotHistory kept(64, budget_);
  const auto state = Next(1);
  kept.Keep(state);
  const SnapshotHistory::View view = kept.Find(state->revision());
  ASSERT_NE(view, nullptr);
  EXPECT_EQ(kept.Find(state->revision()), view);
}

TEST_F(SnapshotHistoryTest, KeepsALimitedNumber) {
  SnapshotHistory kept(3, budget_);
  std::vector<std::weak_ptr<const MapSnapshot>> states;
  for (int i = 0; i < 10; ++i) {
    const auto state = Next(1);
    states.push_back(state);
    kept.Keep(state);
    EXPECT_NE(kept.Find(state->revision()), nullptr);  // read, too: a view is freed with its state
  }
  EXPECT_EQ(kept.size(), 3u);
  for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(states[i].expired(), i < 7) << i;
  SnapshotHistory none(0, budget_);
  none.Keep(Next(1));
  EXPECT_EQ(none.size(), 0u);
}

TEST_F(SnapshotHistoryTest, ACommitOfAStoredStateAddsNothing) {
  SnapshotHistory kept(64, budget_);
  const auto first = Next(1), second = Next(1);
  for (const auto& state : {first, second, second, first}) kept.Keep(state);
  EXPECT_EQ(kept.size(), 2u);
}

TEST_F(SnapshotHistoryTest, AStateCostsWhatTheNextOneDoesNotShare) {
  SnapshotHistory kept(64, budget_);
  kept.Keep(Next(10));
  EXPECT_EQ(kept.bytes(), 0u) << "the newest is shared with the map";
  kept.Keep(Next(4));
  const std::size_t blocks = 4 * TsdfBlock().MemoryBytes();
  EXPECT_GE(kept.bytes(), blocks);
  EXPECT_LT(kept.bytes(), blocks + TsdfBlock().MemoryBytes()) << "rows and tables are small";
  const std::size_t before = kept.bytes();
  map_.mutable_info().display_name = "renamed";
  kept.Keep(map_.Publish(0));
  EXPECT_LT(kept.bytes(), before + TsdfBlock().MemoryBytes()) << "no block was written";
  EXPECT_EQ(budget_->used_bytes(), kept.bytes());
}

/// After each state exactly as many of the oldest are dropped as necessary.
TEST_F(SnapshotHistoryTest, KeepsAsManyRecentStatesAsFit) {
  const std::size_t limit_bytes = 20 * TsdfBlock().MemoryBytes();
  SnapshotHistory kept(64, std::make_shared<ByteBudget>(limit_bytes));
  std::mt19937 random(5);
  std::vector<SnapshotHistory::State> all;
  for (int i = 0; i < 60; ++i) {
    all.push_back(Next(static_cast<int>(random() % 10)));
    kept.Keep(all.back());
    std::size_t bytes = 0, num_kept = 1;  // the obvious way: from the newest on, while there is room
    for (; num_kept < std::min<std::size_t>(64, all.size()); ++num_kept) {
      const std::size_t older = all.size() - num_kept - 1;
      const std::size_t cost = StateBytesNotIn(*all[older], *all[older + 1]);
      if (bytes + cost > limit_bytes) break;
      bytes += cost;
    }
    // Dropped states do not return when memory is free again.
    EXPECT_LE(kept.size(), num_kept);
    EXPECT_LE(kept.bytes(), limit_bytes);
    for (std::size_t n = 0; n < kept.size(); ++n) {
      EXPECT_NE(kept.Find(all[all.size() - 1 - n]->revision()), nullptr) << n;
    }
    EXPECT_GE(kept.size(), std::min<std::size_t>(num_kept, 2)) << "there is room for one more";
  }
}

TEST_F(SnapshotHistoryTest, ReturnsItsMemoryAndTakesNoneFromOtherMaps) {
  const std::size_t limit_bytes = 12 * TsdfBlock().MemoryBytes();
  const auto shared = std::make_shared<ByteBudget>(limit_bytes);
  {
    SnapshotHistory full(64, shared), other(64, shared);
    full.Keep(Next(10));
    full.Keep(Next(10));
    ASSERT_GT(shared->used_bytes(), limit_bytes / 2);
    const auto a = Next(10), b = Next(10);
    other.Keep(a);
    other.Keep(b);
    EXPECT_EQ(full.size(), 2u);
    EXPECT_EQ(other.size(), 1u) << "the newest is always there";
    EXPECT_NE(other.Find(b->revision()), nullptr);
  }
  EXPECT_EQ(shared->used_bytes(), 0u);
}

TEST_F(SnapshotHistoryTest, SaysWhyARevisionCannotBeRead) {
  SnapshotHistory kept(64, budget_);
  const auto first = Next(1);
  kept.Keep(first);
  (void)Next(1);
  kept.Keep(Next(1));
  (void)Next(1);
  const LostRevisions lost = {{4, 4}};
  (void)Next(1);
  const auto present = ViewOf(map_.published());
  const auto reason = [&](std::int64_t revision) {
    const auto view = ViewAt(revision, present, kept, lost, "read_revision");
    return view.ok() ? std::to_string((*view)->snapshot().revision()) : std::string(view.status().reason().name());
  };
  EXPECT_EQ(reason(1), "1");
  EXPECT_EQ(reason(3), "3");
  EXPECT_EQ(reason(5), "5") << "the present one, though it is not stored yet";
  EXPECT_EQ(reason(4), "HISTORY_LOST");
  EXPECT_EQ(reason(6), "BAD_REVISION");
  EXPECT_EQ(reason(0), "BAD_REVISION");
  EXPECT_EQ(reason(-1), "BAD_REVISION");
  const auto between = ViewAt(2, present, kept, lost, "read_revision");
  EXPECT_EQ(between.status().reason(), Reason("REVISION_NOT_KEPT"));
  EXPECT_EQ(between.status().code(), StatusCode::kOutOfRange);
  EXPECT_EQ(between.status().metadata(),
            (std::vector<std::pair<std::string, std::string>>{{"revision_after", "3"}, {"revision_before", "1"}}));
  EXPECT_NE(between.status().message().find("1 and 3"), std::string::npos) << between.status().message();
}

TEST_F(SnapshotHistoryTest, AStateOfAnotherHistoryIsNotFound) {
  SnapshotHistory kept(64, budget_);
  const auto state = Next(1);
  kept.Keep(state);
  const auto own = ViewAt(1, ViewOf(Next(1)), kept, {}, "revision");
  ASSERT_TRUE(own.ok()) << own.status().ToString();
  EXPECT_EQ((*own)->shared_snapshot(), state);
  Map anew(MapInfo{.name = "m", .history_id = 8});
  (void)anew.Publish(0);
  anew.mutable_info().display_name = "anew";
  const auto read = ViewAt(1, ViewOf(anew.Publish(0)), kept, {}, "revision");
  EXPECT_EQ(read.status().reason(), Reason("REVISION_NOT_KEPT"));
}

/// What each state has of its own beside blocks, which 64 states of a thousand maps have as well.
TEST_F(SnapshotHistoryTest, AStateCostsItsListsToo) {
  SnapshotHistory kept(64, budget_);
  kept.Keep(Next(1));
  for (std::uint32_t id = 2; id < 2002; ++id) {
    map_.mutable_info().pairs.SetVerdict(kKeptThing, SubmapId(id), PairVerdict::kMustBeTwo);
  }
  kept.Keep(map_.Publish(0));
  const std::size_t before = kept.bytes();
  map_.mutable_info().display_name = "renamed";
  kept.Keep(map_.Publish(0));
  EXPECT_GE(kept.bytes(), before + 2000 * sizeof(ObjectPair));
}

TEST_F(SnapshotHistoryTest, ThePresentStateFollowsTheLastStoredOne) {
  SnapshotHistory kept(64, budget_);
  (void)Next(1);
  kept.Keep(Next(1));
  (void)Next(1);
  const auto present = ViewOf(Next(1));
  const auto metadata_of = [&](std::int64_t revision) {
    return ViewAt(revision, present, kept, {}, "read_revision").status().metadata();
  };
  using Metadata = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(metadata_of(3), (Metadata{{"revision_after", "4"}, {"revision_before", "2"}}));
  EXPECT_EQ(metadata_of(1), (Metadata{{"revision_after", "2"}})) << "there is none before";
}

TEST_F(SnapshotHistoryTest, AnEvictionReplacesTheNewestStateAndDropsOlderOnes) {
  SnapshotHistory kept(64, budget_);
  const auto first = Next(1), second = Next(2);
  kept.Keep(first);
  kept.Keep(second);
  EXPECT_GT(kept.bytes(), 0u);
  const auto same = std::make_shared<const MapSnapshot>(*second);
  kept.EvictPages(same);
  EXPECT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept.bytes(), 0u);
  EXPECT_EQ(kept.StateAt(second->revision()), same);
  EXPECT_EQ(kept.StateAt(first->revision()), nullptr);
  const auto third = Next(1);
  kept.EvictPages(third);  // which is not stored yet
  EXPECT_EQ(kept.size(), 0u);
  kept.Keep(third);
  EXPECT_EQ(kept.StateAt(third->revision()), third);
}

}  // namespace
}  // namespace dhpmap
