// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/commit_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

Status MapIsDeleted(const MapSnapshot& snapshot) {
  return NotFound("map '" + snapshot.info().name + "' has been deleted").WithReason("MAP_NOT_FOUND");
}

}  // namespace

CommitWorker::CommitWorker(MapStore& store, std::shared_ptr<const MapSnapshot> committed, double retry_s,
                           Observer observer)
    : store_(store), retry_s_(retry_s), observer_(std::move(observer)), committed_(committed), newest_(committed) {
  thread_ = std::thread([this] { Loop(); });
}

CommitWorker::~CommitWorker() { Stop(); }

void CommitWorker::Request(std::shared_ptr<const MapSnapshot> snapshot, Durability durability, Done done) {
  Status refused;
  {
    const std::lock_guard lock(mutex_);
    if (deleted_) {
      refused = MapIsDeleted(*snapshot);
    } else if (stopping_) {
      refused = Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN");
    } else {
      newest_ = std::move(snapshot);
      waiters_.push_back({durability, std::move(done)});
    }
  }
  if (refused.ok()) wake_.notify_one();
  else if (done) done(refused);
}

void CommitWorker::DeleteMap(Done done) {
  bool refused = false;
  {
    const std::lock_guard lock(mutex_);
    refused = stopping_;
    if (!refused) deletions_.push_back(std::move(done));
  }
  if (!refused) wake_.notify_one();
  else done(Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"));
}

std::int64_t CommitWorker::committed_revision() const {
  const std::lock_guard lock(mutex_);
  return committed_->revision();
}

Status CommitWorker::last_outcome() const {
  const std::lock_guard lock(mutex_);
  return last_outcome_;
}

void CommitWorker::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void CommitWorker::Loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    const auto is_ready = [this] { return stopping_ || HasWork(); };
    if (last_outcome_.ok() || deleted_) {
      wake_.wait(lock, is_ready);
    } else if (!wake_.wait_for(lock, std::chrono::duration<double>(retry_s_), is_ready)) {
      CommitNewest(lock);  // behind, and nobody asks: try again
      continue;
    }
    const bool last_round = stopping_;
    if (!deletions_.empty()) DeleteNow(lock);
    if (!waiters_.empty() || (last_round && newest_ != committed_)) CommitNewest(lock);
    if (last_round && !HasWork()) return;
  }
}

void CommitWorker::CommitNewest(std::unique_lock<std::mutex>& lock) {
  auto before = committed_;
  auto after = newest_;
  std::vector<Waiter> served = std::exchange(waiters_, {});
  const bool full = stopping_ || std::any_of(served.begin(), served.end(), [](const Waiter& waiter) {
                      return waiter.durability == Durability::kFull;
                    });
  Status status = deleted_ ? MapIsDeleted(*after) : Status::Ok();
  lock.unlock();

  if (status.ok()) {
    const auto start = Clock::now();
    status = store_.Commit(*before, *after, full ? Durability::kFull : Durability::kNormal);
    if (observer_) observer_(std::chrono::duration<double>(Clock::now() - start).count(), status);
    lock.lock();
    if (status.ok()) committed_ = after;
    last_outcome_ = status;
    lock.unlock();
  }
  for (const Waiter& waiter : served) {
    if (waiter.done) waiter.done(status);
  }
  served.clear();  // to free these may take long: not under the lock
  before.reset();
  after.reset();
  lock.lock();
}

void CommitWorker::DeleteNow(std::unique_lock<std::mutex>& lock) {
  const std::vector<Done> served = std::exchange(deletions_, {});
  const std::string name = committed_->info().name;
  Status status = deleted_ ? MapIsDeleted(*committed_) : Status::Ok();
  lock.unlock();
  if (status.ok()) status = store_.DeleteMap(name);
  lock.lock();
  if (status.ok()) {
    deleted_ = true;
    newest_ = committed_;
  }
  lock.unlock();
  for (const Done& done : served) done(status);
  lock.lock();
}

}  // namespace dhpmap
