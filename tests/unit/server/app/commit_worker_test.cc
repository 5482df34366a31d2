// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/commit_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "mapping/map/map.h"
#include "tests/support/eventually.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap {
namespace {

/// A store whose commits a test can delay, and which records the calls.
class ScriptedStore final : public testing::WrappedStore {
 public:
  struct Call {
    std::int64_t before, after;
    Durability durability;
  };

  Result<StoredMap> GetMap(const std::string&) override {
    if (!stored) return NotFound("not here");
    return *stored;
  }
  Status DeleteMap(const std::string&) override {
    if (is_lost_in_answering) stored = std::nullopt;
    Throw();
    stored = std::nullopt;
    return Status::Ok();
  }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    const std::lock_guard lock(mutex);  // held by the test: the disk is slow
    calls.push_back({before.revision(), after.revision(), durability});
    if (is_lost_in_answering) stored = StoredMap{.info = after.info()};
    Throw();
    return std::exchange(next_outcome, Status::Ok());
  }
  /// Makes the next call throw this exception.
  template <typename Exception>
  void ThrowNext(const Exception& exception) {
    next_exception = std::make_exception_ptr(exception);
  }
  void Throw() {
    if (const auto exception = std::exchange(next_exception, nullptr)) std::rethrow_exception(exception);
  }

  std::mutex mutex;
  std::vector<Call> calls;
  Status next_outcome;
  std::optional<StoredMap> stored;
  bool is_lost_in_answering = false;  ///< all is done before it throws
  std::exception_ptr next_exception;
};

class CommitWorkerTest : public ::testing::Test {
 protected:
  CommitWorkerTest() {
    MapInfo info;
    info.name = "room";
    map.emplace(info);
    first = map->Publish(0);
    worker.emplace(store, first, /*retry_s=*/1000.0, CommitWorker::Observer());
  }

  std::shared_ptr<const MapSnapshot> Change() {
    map->mutable_info().num_frames++;
    return map->Publish(0);
  }
  Status Delete() {
    std::promise<Status> outcome;
    worker->DeleteMap([&outcome](const Status& status) { outcome.set_value(status); });
    return outcome.get_future().get();
  }
  std::future<Status> Request(std::shared_ptr<const MapSnapshot> snapshot, Durability durability) {
    auto promise = std::make_shared<std::promise<Status>>();
    worker->Request(std::move(snapshot), durability, [promise](const Status& status) { promise->set_value(status); });
    return promise->get_future();
  }

  ScriptedStore store;
  std::optional<Map> map;
  std::shared_ptr<const MapSnapshot> first;
  std::optional<CommitWorker> worker;
};

TEST_F(CommitWorkerTest, RequestsDuringACommitAreServedByOneCommitOfTheNewest) {
  std::unique_lock slow(store.mutex);
  auto a = Request(Change(), Durability::kNormal);
  std::vector<std::future<Status>> others;
  for (int i = 0; i < 5; ++i) {
    others.push_back(Request(Change(), i == 2 ? Durability::kFull : Durability::kNormal));
  }
  slow.unlock();
  EXPECT_TRUE(a.get().ok());
  for (auto& other : others) EXPECT_TRUE(other.get().ok());
  slow.lock();
  ASSERT_LE(store.calls.size(), 2u);
  EXPECT_EQ(store.calls.back().after, 7);
  EXPECT_EQ(store.calls.back().durability, Durability::kFull);
  slow.unlock();
  EXPECT_EQ(worker->committed_revision(), 7);
}

TEST_F(CommitWorkerTest, AfterAFailureTheNextCommitStartsFromTheLastGoodState) {
  store.next_outcome = ResourceExhausted("full");
  EXPECT_EQ(Request(Change(), Durability::kFull).get().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(worker->committed_revision(), 1);
  EXPECT_FALSE(worker->last_outcome().ok());
  EXPECT_TRUE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_TRUE(worker->last_outcome().ok());
  ASSERT_EQ(store.calls.size(), 2u);
  EXPECT_EQ(store.calls[1].before, 1);
  EXPECT_EQ(store.calls[1].after, 3);
}

TEST_F(CommitWorkerTest, OnlyMarksOfTheStoredStateAreKept) {
  const SubmapId id = map->Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04}).id();
  map->FindMutable(id)->MutableTsdf({0, 0, 0});
  auto snapshot = map->Publish(0);
  const std::weak_ptr<const MapSnapshot> state = snapshot;
  const std::weak_ptr<const TsdfBlock> block = snapshot->Find(id)->blocks().Find({0, 0, 0})->tsdf;
  ASSERT_TRUE(Request(snapshot, Durability::kNormal).get().ok());
  snapshot = nullptr;
  map->FindMutable(id)->MutableTsdf({0, 0, 0});
  map->Publish(1);
  ASSERT_TRUE(testing::Eventually([&] { return state.expired() && block.expired(); }));
  EXPECT_TRUE(Request(map->published(), Durability::kNormal).get().ok());
  EXPECT_EQ(store.calls.back().before, 2);
}

TEST_F(CommitWorkerTest, AfterARefusedEditTheStoreIsTriedWithItsOwnState) {
  worker.emplace(store, first, /*retry_s=*/0.01, CommitWorker::Observer());
  store.next_outcome = ResourceExhausted("full");
  EXPECT_EQ(worker->CommitUnseen(Change()).code(), StatusCode::kResourceExhausted);
  EXPECT_TRUE(testing::Eventually([&] { return worker->last_outcome().ok(); }));
  EXPECT_EQ(worker->committed_revision(), 1);
  const std::lock_guard lock(store.mutex);
  EXPECT_EQ(store.calls.back().after, 1);
}

TEST_F(CommitWorkerTest, ARequestForTheStoredStateStillTriesTheStore) {
  worker.emplace(store, first, /*retry_s=*/0.01, CommitWorker::Observer());
  const auto same = std::make_shared<const MapSnapshot>(*first);
  worker->EvictPages(same);
  auto unseen = Change();
  first = nullptr;
  store.next_outcome = ResourceExhausted("full");
  EXPECT_EQ(worker->CommitUnseen(std::move(unseen)).code(), StatusCode::kResourceExhausted);
  EXPECT_TRUE(testing::Eventually([&] { return worker->last_outcome().ok(); }));
  const std::lock_guard lock(store.mutex);
  EXPECT_EQ(store.calls.back().after, 1) << "not said to be well because nobody has asked it";
}

TEST_F(CommitWorkerTest, APendingStateIsReplacedByItsEvictedCopy) {
  store.next_outcome = ResourceExhausted("full");
  auto waiting = Change();
  EXPECT_FALSE(Request(waiting, Durability::kNormal).get().ok());
  const auto same = std::make_shared<const MapSnapshot>(*waiting);
  const std::weak_ptr<const MapSnapshot> state = waiting;
  worker->EvictPages(same);
  waiting = nullptr;
  const auto next = Change();
  EXPECT_TRUE(testing::Eventually([&] { return state.expired(); }));
  worker->Stop();
  const std::lock_guard lock(store.mutex);
  EXPECT_EQ(store.calls.back().after, 2) << "it is stored all the same";
}

TEST_F(CommitWorkerTest, EveryStoredStateReachesTheKeeperBeforeTheCallbacks) {
  std::vector<std::int64_t> kept;
  worker.emplace(store, first, /*retry_s=*/1000.0, CommitWorker::Observer(),
                 [&kept](const std::shared_ptr<const MapSnapshot>& state) { kept.push_back(state->revision()); });
  EXPECT_TRUE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_EQ(kept, std::vector<std::int64_t>{2});
  store.next_outcome = ResourceExhausted("full");
  EXPECT_FALSE(worker->CommitUnseen(Change()).ok());
  EXPECT_EQ(kept, std::vector<std::int64_t>{2}) << "what is refused has never been";
  EXPECT_TRUE(worker->CommitUnseen(Change()).ok());
  worker->Stop();
  EXPECT_EQ(kept, (std::vector<std::int64_t>{2, 4}));
}

TEST_F(CommitWorkerTest, StopTriesOnceMoreToCommitUnstoredChanges) {
  store.next_outcome = ResourceExhausted("full");
  EXPECT_FALSE(Request(Change(), Durability::kNormal).get().ok());
  worker->Stop();
  EXPECT_EQ(worker->committed_revision(), 2);
  EXPECT_EQ(store.calls.back().durability, Durability::kFull);
  EXPECT_EQ(Request(Change(), Durability::kNormal).get().code(), StatusCode::kUnavailable);
}

TEST_F(CommitWorkerTest, AfterADeletionCommitsFail) {
  std::promise<Status> deleted;
  worker->DeleteMap([&deleted](const Status& status) { deleted.set_value(status); });
  EXPECT_TRUE(deleted.get_future().get().ok());
  EXPECT_EQ(Request(Change(), Durability::kNormal).get().code(), StatusCode::kNotFound);
  worker->Stop();
  EXPECT_TRUE(store.calls.empty());
}

TEST_F(CommitWorkerTest, ACommitThatThrowsHasFailed) {
  store.ThrowNext(std::bad_alloc());
  const Status no_memory = Request(Change(), Durability::kNormal).get();
  EXPECT_EQ(no_memory.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(no_memory.reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_EQ(worker->last_outcome().code(), StatusCode::kResourceExhausted);
  store.ThrowNext(std::runtime_error("of the store"));
  const Status other = Request(Change(), Durability::kNormal).get();
  EXPECT_EQ(other.code(), StatusCode::kInternal);
  EXPECT_NE(other.ToString().find("of the store"), std::string::npos) << other.ToString();
  store.ThrowNext(1);
  EXPECT_EQ(Request(Change(), Durability::kNormal).get().code(), StatusCode::kInternal);
  EXPECT_EQ(worker->committed_revision(), 1);

  EXPECT_TRUE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_TRUE(worker->last_outcome().ok());
  ASSERT_EQ(store.calls.size(), 4u);
  EXPECT_EQ(store.calls.back().before, 1) << "nothing is left out";
  EXPECT_EQ(store.calls.back().after, 5);
}

TEST_F(CommitWorkerTest, ChangesOfACommitThatThrewAreStoredByTheNext) {
  worker.emplace(store, first, /*retry_s=*/0.01, CommitWorker::Observer());
  store.ThrowNext(std::bad_alloc());
  EXPECT_FALSE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_TRUE(testing::Eventually([&] { return worker->committed_revision() == 2; }));
}

TEST_F(CommitWorkerTest, AnUnseenStateWhoseCommitThrowsIsDropped) {
  store.ThrowNext(std::bad_alloc());
  EXPECT_EQ(worker->CommitUnseen(Change()).reason(), Reason("OUT_OF_MEMORY"));
  worker->Stop();
  EXPECT_EQ(worker->committed_revision(), 1);
  ASSERT_EQ(store.calls.size(), 1u) << "no later commit writes it";
}

TEST_F(CommitWorkerTest, ACommitThatThrowsAfterWritingHasSucceeded) {
  store.is_lost_in_answering = true;
  store.ThrowNext(std::bad_alloc());
  EXPECT_TRUE(worker->CommitUnseen(Change()).ok());
  EXPECT_EQ(worker->committed_revision(), 2);
  EXPECT_TRUE(worker->last_outcome().ok());
  EXPECT_TRUE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_EQ(store.calls.back().before, 2) << "where the store is";
}

TEST_F(CommitWorkerTest, ACommitThatThrowsIsNotTakenForAnotherOneOfItsRevision) {
  const auto refused = Change();
  map.emplace(first);
  map->mutable_info().display_name = "edited";
  const auto edited = map->Publish(1);
  ASSERT_EQ(edited->revision(), refused->revision());
  store.stored = StoredMap{.info = refused->info()};  // written, though its caller was told of an error
  store.ThrowNext(std::bad_alloc());
  EXPECT_EQ(worker->CommitUnseen(edited).reason(), Reason("OUT_OF_MEMORY")) << "the store has never seen it";
  EXPECT_EQ(worker->committed_revision(), 1);
}

TEST_F(CommitWorkerTest, ACommitThatThrowsWithoutANewRevisionIsMadeOnceMore) {
  store.is_lost_in_answering = true;
  store.ThrowNext(std::bad_alloc());
  EXPECT_EQ(Request(first, Durability::kNormal).get().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_TRUE(Request(first, Durability::kNormal).get().ok());
  ASSERT_EQ(store.calls.size(), 2u);
  EXPECT_EQ(store.calls.back().before, 1);
  EXPECT_EQ(store.calls.back().after, 1);
}

TEST_F(CommitWorkerTest, ADeletionThatThrowsChangesNothing) {
  store.stored = StoredMap{.info = first->info()};
  store.ThrowNext(std::bad_alloc());
  EXPECT_EQ(Delete().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_TRUE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_TRUE(Delete().ok());
  EXPECT_EQ(Request(Change(), Durability::kNormal).get().code(), StatusCode::kNotFound);
}

TEST_F(CommitWorkerTest, ADeletionThatThrowsAfterDeletingHasSucceeded) {
  store.stored = StoredMap{.info = first->info()};
  store.is_lost_in_answering = true;
  store.ThrowNext(std::bad_alloc());
  EXPECT_TRUE(Delete().ok());
  EXPECT_EQ(Request(Change(), Durability::kNormal).get().code(), StatusCode::kNotFound);
}

TEST_F(CommitWorkerTest, ACallbackThatThrowsDoesNotPreventOthers) {
  int num_heard = 0;
  worker.emplace(store, first, /*retry_s=*/1000.0, [&num_heard](double, const Status&) {
    ++num_heard;
    throw std::bad_alloc();
  });
  std::unique_lock slow(store.mutex);
  const auto rude = [](const Status&) { throw std::runtime_error("of the listener"); };
  for (int i = 0; i < 3; ++i) worker->Request(Change(), Durability::kNormal, rude);
  auto answer = Request(Change(), Durability::kNormal);
  slow.unlock();
  EXPECT_TRUE(answer.get().ok());
  EXPECT_TRUE(Request(Change(), Durability::kNormal).get().ok());
  EXPECT_EQ(worker->committed_revision(), 6);
  worker->Stop();
  EXPECT_GE(num_heard, 2);
  worker->Request(Change(), Durability::kNormal, rude);  // refused here and now
}

TEST_F(CommitWorkerTest, NothingIsCommittedAfterALoss) {
  worker.emplace(store, first, /*retry_s=*/0.001, CommitWorker::Observer());
  store.next_outcome = Unavailable("taken").WithReason("NOT_OWNER").WithMetadata("owner", "two:2");
  const Status refused = Request(Change(), Durability::kNormal).get();
  EXPECT_EQ(refused.reason(), Reason("NOT_OWNER"));
  ASSERT_EQ(refused.metadata().size(), 1u);
  EXPECT_EQ(worker->loss().reason(), Reason("NOT_OWNER"));
  EXPECT_EQ(Request(Change(), Durability::kFull).get().reason(), Reason("NOT_OWNER"));
  EXPECT_EQ(worker->CommitUnseen(Change()).metadata(), refused.metadata()) << "an edit is dropped with the same words";
  worker->Stop();
  EXPECT_EQ(store.calls.size(), 1u) << "neither retried, nor at the end";
  EXPECT_EQ(worker->committed_revision(), 1);
}

}  // namespace
}  // namespace dhpmap
