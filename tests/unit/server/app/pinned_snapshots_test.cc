// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/pinned_snapshots.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

/// With what the layers hold outside of themselves: of labels nearly all.
const std::size_t kBlock_bytes = TsdfBlock().MemoryBytes() + LabelBlock().MemoryBytes();
constexpr SubmapId kThing{1}, kOther{2};

/// A map of two submaps of 10 blocks, each with TSDF and labels.
class PinnedSnapshotsTest : public ::testing::Test {
 protected:
  PinnedSnapshotsTest() {
    for (int i = 0; i < 2; ++i) map_.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
    Write(kThing, 0, 10);
    Write(kOther, 0, 10);
    (void)Now();
  }

  void Write(SubmapId id, int begin, int end) {
    for (int x = begin; x < end; ++x) {
      map_.FindMutable(id)->MutableTsdf({x, 0, 0}).weight[0] += 1;
      map_.FindMutable(id)->MutableLabels({x, 0, 0}).AddObservation(0, ClassId(1));
    }
  }
  PinnedSnapshots::State Now() {
    const MutexLock lock(mutex_);
    present_ = map_.Publish(0);
    return present_;
  }
  void Close() {
    const MutexLock lock(mutex_);
    present_ = nullptr;
  }
  /// Sets the state that is kept elsewhere anyway; null: none.
  void KeepElsewhere(PinnedSnapshots::State state) {
    const MutexLock lock(mutex_);
    kept_ = std::move(state);
  }
  std::size_t BlocksHeld() {
    states_.Look();
    return states_.bytes() / kBlock_bytes;
  }

  ByteBudget budget_{100 * kBlock_bytes};
  Map map_{MapInfo{.name = "m", .history_id = 7}};
  Mutex mutex_;
  PinnedSnapshots::State present_ DHPMAP_GUARDED_BY(mutex_), kept_ DHPMAP_GUARDED_BY(mutex_);
  PinnedSnapshots states_{budget_, [this](const MapSnapshot& state) {
                            const MutexLock lock(mutex_);
                            return kept_ != nullptr && kept_->revision() == state.revision() ? kept_ : present_;
                          }};
};

TEST_F(PinnedSnapshotsTest, APresentStateCostsNothing) {
  const auto hold = states_.TryPin(Now(), {});
  EXPECT_EQ(BlocksHeld(), 0u);
}

TEST_F(PinnedSnapshotsTest, AnOldStateCostsTheBlocksWrittenSinceHoweverOften) {
  const auto hold = states_.TryPin(Now(), {});
  for (int i = 0; i < 3; ++i) {
    Write(kThing, 2, 6);
    Now();
  }
  EXPECT_EQ(BlocksHeld(), 4u);
  Write(kThing, 20, 30);  // new: the old state has none of it
  Now();
  EXPECT_EQ(BlocksHeld(), 4u);
  EXPECT_EQ(budget_.used_bytes(), 6 * kBlock_bytes) << "with half as much again, for what comes until the next look";
  EXPECT_EQ(CountOf(MemoryKind::kReserved).now_bytes(), budget_.used_bytes()) << "what is counted as blocks of maps";
}

TEST_F(PinnedSnapshotsTest, BlocksSharedByStatesAreCountedOnce) {
  const auto first = states_.TryPin(Now(), {}), again = states_.TryPin(Now(), {});
  Write(kThing, 0, 3);
  const auto second = states_.TryPin(Now(), {});
  Write(kOther, 0, 2);
  Now();
  EXPECT_EQ(BlocksHeld(), 5u);
}

TEST_F(PinnedSnapshotsTest, APinnedSubmapCostsOnlyItself) {
  const auto whole = states_.TryPin(Now(), {});
  const auto hold = states_.TryPin(OnlySubmap(*Now(), kThing), {});
  Write(kThing, 0, 3);
  Write(kOther, 0, 4);
  Now();
  EXPECT_EQ(BlocksHeld(), 7u);
  EXPECT_EQ(OnlySubmap(*Now(), SubmapId(99)), nullptr);
}

TEST_F(PinnedSnapshotsTest, AStateOfAClosedMapCostsAllItsBlocks) {
  const auto hold = states_.TryPin(Now(), {});
  Close();
  EXPECT_EQ(BlocksHeld(), 20u);
}

TEST_F(PinnedSnapshotsTest, AStateInTheHistoryCostsNothingUntilItIsDropped) {
  const auto past = Now();
  const auto hold = states_.TryPin(past, {}), part = states_.TryPin(OnlySubmap(*past, kThing), {});
  KeepElsewhere(past);
  Write(kThing, 0, 3);
  const auto later = states_.TryPin(Now(), {});
  Write(kOther, 0, 2);
  Now();
  EXPECT_EQ(BlocksHeld(), 2u) << "that the later one has alone";
  KeepElsewhere(nullptr);
  EXPECT_EQ(BlocksHeld(), 5u);
}

TEST_F(PinnedSnapshotsTest, AReleasedStatesMemoryIsReturned) {
  auto hold = states_.TryPin(Now(), {});
  Write(kThing, 0, 3);
  Now();
  EXPECT_EQ(BlocksHeld(), 3u);
  hold.reset();
  EXPECT_EQ(BlocksHeld(), 0u);
  EXPECT_EQ(budget_.used_bytes(), 0u);
}

TEST_F(PinnedSnapshotsTest, TheOldestPinIsReleasedWhenMemoryRunsOut) {
  ByteShare others(&budget_);
  int first_asked = 0, second_asked = 0;
  auto first = states_.TryPin(Now(), [&] { ++first_asked; });
  Write(kThing, 0, 5);
  const auto second = states_.TryPin(Now(), [&] { ++second_asked; });
  Write(kOther, 0, 5);
  Now();
  EXPECT_EQ(BlocksHeld(), 10u);
  EXPECT_EQ(first_asked, 0);
  ASSERT_TRUE(others.Resize(85 * kBlock_bytes));
  Write(kThing, 5, 6);
  Now();
  (void)BlocksHeld();
  EXPECT_GT(first_asked, 0);
  EXPECT_EQ(second_asked, 0) << "without the first there is room";
}

TEST_F(PinnedSnapshotsTest, NewPinsAreRefusedWhileOlderOnesHoldMuch) {
  const auto hold = states_.TryPin(Now(), {});
  Write(kThing, 0, 10);
  Write(kOther, 0, 10);
  Now();
  EXPECT_EQ(BlocksHeld(), 20u);
  Write(kOther, 20, 40);
  const auto newest = states_.TryPin(Now(), {});
  EXPECT_NE(states_.TryPin(Now(), {}), nullptr);
  Close();
  EXPECT_EQ(BlocksHeld(), 60u);
  EXPECT_EQ(states_.TryPin(Now(), {}), nullptr);
}

TEST_F(PinnedSnapshotsTest, ChecksByItselfAndSkipsReleasedPins) {
  ByteShare others(&budget_);
  ASSERT_TRUE(others.Resize(99 * kBlock_bytes));
  std::atomic<int> asked = 0;
  auto hold = states_.TryPin(Now(), [&] { ++asked; });
  Write(kThing, 0, 5);
  Now();
  EXPECT_TRUE(testing::Eventually([&] { return asked > 0; }));
  hold.reset();
  const int before = asked;
  states_.Look();
  EXPECT_EQ(asked, before);
}

}  // namespace
}  // namespace dhpmap
