// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/writer_queue.h"

#include <gtest/gtest.h>

#include <future>
#include <latch>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/app/open_map/due_time.h"
#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

/// A queue that records the order of its jobs, refusals and chores.
class WriterQueueTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kMaxEdits = 2;

  WriterQueueTest() {
    queue_ = std::make_unique<WriterQueue>(kMaxEdits, WriterChores{.due = [this] { return due_; },
                                                                   .run =
                                                                       [this] {
                                                                         if (++num_chores_ != 2) return;
                                                                         due_ = std::nullopt;
                                                                         has_done_two_.count_down();
                                                                       },
                                                                   .finish = [this] { Note("finish"); }});
  }
  ~WriterQueueTest() override { (void)queue_->Stop(); }

  void Note(const std::string& what) {
    const std::lock_guard lock(mutex_);
    noted_.push_back(what);
  }
  std::vector<std::string> Noted() {
    const std::lock_guard lock(mutex_);
    return noted_;
  }
  void Post(const std::string& name, bool is_edit = false) {
    queue_->Post({.run = [this, name] { Note(name); },
                  .refuse = [this, name](const Status& why) { Note(name + ": " + std::string(why.reason().name())); },
                  .is_edit = is_edit});
  }
  /// Keeps the thread busy until Free. Returns once it is busy.
  void Hold() {
    std::promise<void> holds;
    queue_->Post({.run =
                      [&holds, free = free_.get_future().share()] {
                        holds.set_value();
                        free.wait();
                      },
                  .refuse = [](const Status&) {}});
    holds.get_future().wait();
  }
  void AwaitRest() {
    EXPECT_TRUE(testing::Eventually([this] { return queue_->IsAtRest(); }));
  }
  void Free() { free_.set_value(); }

  std::mutex mutex_;
  std::vector<std::string> noted_;
  std::promise<void> free_;
  // Used by the writer thread.
  std::optional<DueTime> due_;
  int num_chores_ = 0;
  std::latch has_done_two_{1};
  std::unique_ptr<WriterQueue> queue_;
};

TEST_F(WriterQueueTest, JobsRunInOrderAndTheLastChoreAfterAll) {
  Hold();
  for (const char* name : {"a", "b", "c"}) Post(name);
  EXPECT_TRUE(Noted().empty());
  EXPECT_FALSE(queue_->IsAtRest());
  Free();
  std::promise<void> done;
  queue_->Post({.run = [&done] { done.set_value(); }, .refuse = [](const Status&) {}});
  done.get_future().wait();
  EXPECT_EQ(queue_->Stop(), StatusCode::kUnavailable);
  EXPECT_EQ(Noted(), (std::vector<std::string>{"a", "b", "c", "finish"}));
  EXPECT_TRUE(queue_->IsAtRest());
}

TEST_F(WriterQueueTest, StopRefusesQueuedAndLaterJobs) {
  Hold();
  Post("waits");
  auto stopped = std::async(std::launch::async, [this] { return queue_->Stop(); });
  EXPECT_TRUE(
      testing::Eventually([this] { return !queue_->refusal().ok(); }));  // it has begun, and waits for the job in hand
  Free();
  stopped.wait();
  Post("late");
  EXPECT_EQ(Noted(), (std::vector<std::string>{"waits: SHUTTING_DOWN", "finish", "late: SHUTTING_DOWN"}));
}

TEST_F(WriterQueueTest, AClosedQueueRefusesLaterJobsAndRunsQueuedOnes) {
  Hold();
  Post("waits");
  queue_->Close(NotFound("the map has been deleted").WithReason("MAP_NOT_FOUND"));
  Post("late");
  Free();
  AwaitRest();
  EXPECT_EQ(queue_->Stop(), StatusCode::kNotFound);
  EXPECT_EQ(Noted(), (std::vector<std::string>{"late: MAP_NOT_FOUND", "waits", "finish"}));
}

TEST_F(WriterQueueTest, OnlyEditsBeyondTheLimitAreRefused) {
  Hold();
  for (const char* name : {"first", "second", "third"}) Post(name, /*is_edit=*/true);
  Post("no edit");
  EXPECT_EQ(Noted(), std::vector<std::string>{"third: TOO_MANY_EDITS"});
  Free();
  AwaitRest();
  Post("room again", /*is_edit=*/true);
  AwaitRest();
  EXPECT_EQ(Noted(), (std::vector<std::string>{"third: TOO_MANY_EDITS", "first", "second", "no edit", "room again"}));
}

TEST_F(WriterQueueTest, AJobThatThrowsIsDroppedAndTheNextOneRuns) {
  queue_->Post({.run = [] { throw std::runtime_error("job"); }, .refuse = [](const Status&) {}});
  Post("next");
  AwaitRest();
  EXPECT_EQ(Noted(), std::vector<std::string>{"next"});
}

TEST_F(WriterQueueTest, DueChoresRunWithoutAJob) {
  queue_->Post({.run = [this] { due_ = DueIn(0.001); }, .refuse = [](const Status&) {}});
  has_done_two_.wait();  // one after the job, one when it is due
}

TEST_F(WriterQueueTest, WithoutAJobThereIsNoThreadAndNoLastChore) {
  EXPECT_EQ(queue_->Stop(), StatusCode::kUnavailable);
  EXPECT_TRUE(Noted().empty());
}

}  // namespace
}  // namespace dhpmap
