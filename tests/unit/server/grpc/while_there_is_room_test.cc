// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "server/grpc/call_runner.h"
#include "server/grpc/map_quota.h"
#include "storage/store.h"
#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

/// A map of one submap that is completely rewritten, and a budget for half of its bytes.
class WhileThereIsRoomTest : public ::testing::Test {
 protected:
  static constexpr int kNumBlocks = 64;
  static constexpr std::size_t kBudget_bytes = kNumBlocks * sizeof(TsdfBlock) / 2;

  WhileThereIsRoomTest() { WriteAll(); }

  void WriteAll() {
    Submap& submap = *map_.FindMutable(kUnknownSubmap);
    for (int i = 0; i < kNumBlocks; ++i) submap.MutableTsdf({i, 0, 0}).weight[0] += 1;
    auto state = map_.Publish(0);
    const MutexLock lock(mutex_);
    present_ = std::move(state);
  }
  std::shared_ptr<const MapSnapshot> Present() {
    const MutexLock lock(mutex_);
    return present_;
  }
  Status Answer(const std::function<Status(const std::stop_token&)>& work) {
    return WhileThereIsRoom(context_, Present(), stop_.get_token(), work);
  }

  Map map_{MapInfo{.name = "m", .history_id = 7}};
  Mutex mutex_;
  std::shared_ptr<const MapSnapshot> present_ DHPMAP_GUARDED_BY(mutex_);
  ByteBudget budget_{kBudget_bytes};
  PinnedSnapshots held_{budget_, [this](const MapSnapshot&) { return Present(); }};
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  std::unique_ptr<MapRegistry> registry_ = MapRegistry::Open(*store_, {}).value();
  Lanes lanes_{Lane{{}}, Lane{{}}, Lane{{}}, Lane{{}}, Lane{{}}, Lane{{}}, Lane{{}}, Lane{{}}};
  GrpcOptions options_;
  GrpcObserver observer_;
  std::atomic<int> num_checks_ = 0;
  MapQuota quota_{*options_.gate, *registry_};
  ServiceContext context_{*registry_, lanes_, options_, observer_, held_, num_checks_, quota_};
  std::stop_source stop_;
};

TEST_F(WhileThereIsRoomTest, AnswersOfTheWorkAreReturned) {
  EXPECT_TRUE(Answer([](const std::stop_token&) { return Status::Ok(); }).ok());
  EXPECT_EQ(Answer([](const std::stop_token&) { return NotFound("it"); }).code(), StatusCode::kNotFound);
}

TEST_F(WhileThereIsRoomTest, WorkOnARewrittenMapIsStopped) {
  const Status status = Answer([this](const std::stop_token& ended) {
    WriteAll();
    EXPECT_TRUE(testing::Eventually([&] { return ended.stop_requested(); }));
    return Cancelled("told so");
  });
  EXPECT_EQ(status.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(status.reason(), Reason("TOO_MANY_BYTES"));
  EXPECT_TRUE(testing::Eventually([this] { return budget_.used_bytes() == 0; })) << "it is let go of";
}

TEST_F(WhileThereIsRoomTest, WorkThatSucceedsNeverthelessIsAnswered) {
  EXPECT_TRUE(Answer([this](const std::stop_token& ended) {
                WriteAll();
                EXPECT_TRUE(testing::Eventually([&] { return ended.stop_requested(); }));
                return Status::Ok();
              }).ok());
}

TEST_F(WhileThereIsRoomTest, WorkOfADisconnectedClientIsCancelled) {
  const Status status = Answer([this](const std::stop_token& ended) {
    stop_.request_stop();
    EXPECT_TRUE(ended.stop_requested());
    return Cancelled("the client went away");
  });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
}

TEST_F(WhileThereIsRoomTest, NoWorkBeginsWhileOldStatesTakeTooMuch) {
  const auto old = held_.TryPin(Present(), {});  // cannot be released
  WriteAll();
  held_.Look();
  bool has_begun = false;
  const Status status = Answer([&](const std::stop_token&) {
    has_begun = true;
    return Status::Ok();
  });
  EXPECT_EQ(status.reason(), Reason("TOO_MANY_BYTES"));
  EXPECT_FALSE(has_begun);
}

}  // namespace
}  // namespace dhpmap
