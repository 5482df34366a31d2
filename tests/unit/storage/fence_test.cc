// SPDX-License-Identifier: BSD-3-Clause
// An owner that is stopped at some point of a commit, while another server takes its map over, and then goes on.
#include <gtest/gtest.h>

#include <future>
#include <string>

#include "tests/unit/storage/fleet_fixture.h"

namespace dhpmap {
namespace {

using testing::CutConnection;
using testing::ExpectSameMap;
using testing::PostgresCluster;

class FenceTest : public testing::FleetOfStores {
 protected:
  void SetUp() override {
    FleetOfStores::SetUp();
    if (IsSkipped()) return;
    way_ = std::make_unique<CutConnection>(PostgresCluster::Get()->Folder());
    old_ = Open("old:1", way_->Url());
    new_ = Open("new:2");
    map_ = Create(old_);
    ASSERT_OK(Commit(old_, *map_));  // so that its statements are prepared
    Pass(1, {&old_, &new_});
    epoch_ = EpochOf(old_);
  }
  void TearDown() override {
    old_.store.reset();
    new_.store.reset();
  }
  /// The other server takes the map, and commits to it.
  void TakeOver() {
    Pass(2.5, {&new_});
    ASSERT_OK_AND_ASSIGN(const auto taken, new_.store->LoadMap("house"));
    found_ = taken->revision();
    next_ = std::make_unique<Map>(taken);
    ASSERT_OK(Commit(new_, *next_));
    EXPECT_EQ(EpochOf(new_), epoch_ + 1);
  }
  void ExpectTheNewOwnersState() {
    ASSERT_OK_AND_ASSIGN(const auto stored, new_.store->LoadMap("house"));
    ExpectSameMap(*next_->published(), *stored);
    EXPECT_OK(Commit(new_, *next_)) << "it goes on";
  }
  /// The old owner commits, and is stopped there until the other has taken over.
  Status CommitHeldAt(CutConnection::Hold where) {
    way_->HoldNext(where);
    auto done = std::async(std::launch::async, [&] { return Commit(old_, *map_); });
    way_->AwaitHeld();
    TakeOver();
    way_->Release();
    return done.get();
  }

  std::unique_ptr<CutConnection> way_;
  Server old_, new_;
  std::unique_ptr<Map> map_, next_;
  std::int64_t epoch_ = 0, found_ = 0;
};

TEST_F(FenceTest, StoppedBeforeACommitItIsRefused) {
  const std::int64_t before = map_->published()->revision();
  TakeOver();
  EXPECT_EQ(found_, before);
  EXPECT_EQ(OwnerIn(Commit(old_, *map_)), "new:2");
  ExpectTheNewOwnersState();
}

TEST_F(FenceTest, StoppedBetweenLookingAndWritingItIsRefused) {
  const std::int64_t before = map_->published()->revision();
  const Status refused = CommitHeldAt(CutConnection::Hold::kBeforeBegin);
  EXPECT_EQ(OwnerIn(refused), "new:2");
  EXPECT_EQ(found_, before);
  ExpectTheNewOwnersState();
}

TEST_F(FenceTest, StoppedInsideACommitItsTransactionIsEnded) {
  const std::int64_t before = map_->published()->revision();
  const Status refused = CommitHeldAt(CutConnection::Hold::kBeforeCommit);
  EXPECT_EQ(OwnerIn(refused), "new:2");
  EXPECT_EQ(found_, before) << "it held the map's row, and nothing of it is stored";
  ExpectTheNewOwnersState();
}

TEST_F(FenceTest, StoppedAfterACommitItIsFoundByTheNewOwner) {
  const std::int64_t before = map_->published()->revision();
  const Status done = CommitHeldAt(CutConnection::Hold::kAfterCommit);
  EXPECT_OK(done) << "rightly acknowledged: no other could have written before";
  EXPECT_GT(found_, before);
  EXPECT_EQ(OwnerIn(Commit(old_, *map_)), "new:2");
  ExpectTheNewOwnersState();
}

TEST_F(FenceTest, StoppedInsideAnEditItHasNotHappenedAndMayBeMadeAgain) {
  const auto before = map_->published();
  map_->mutable_info().display_name = "edited";
  const auto after = map_->Publish(20);
  const EditRecord edit{.entry = {after->revision(), 20, {.request_id = "1"}, {}}, .answer = "done", .before = before};
  way_->HoldNext(CutConnection::Hold::kBeforeCommit);
  auto done = std::async(std::launch::async, [&] { return old_.store->CommitEdit(*before, *after, edit); });
  way_->AwaitHeld();
  TakeOver();
  way_->Release();
  EXPECT_EQ(OwnerIn(done.get()), "new:2");
  ASSERT_OK_AND_ASSIGN(const auto answer, new_.store->FindAnswer("house", "1"));
  EXPECT_FALSE(answer) << "the new owner does it when the client asks again";
  ExpectTheNewOwnersState();
}

}  // namespace
}  // namespace dhpmap
