// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/commit_worker.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/this_thread.h"
#include "mapping/map/same_state.h"
#include "server/app/open_map/shutting_down.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

/// Copies the storage locations of tiles to a state with equal tiles in other objects: see EvictPages.
void AdoptStored(const MapSnapshot& stored, const std::shared_ptr<const MapSnapshot>& other) {
  if (other == nullptr || other.get() == &stored) return;
  for (const auto& submap : stored.submaps()) {
    const Submap* same = other->Find(submap->id());
    if (same == nullptr || same == submap.get()) continue;
    if (submap->blocks().SharesUnread(same->blocks())) continue;
    for (const TileEntry& entry : submap->blocks().tiles_if_read()) {
      const TileEntry* there = same->blocks().FindTile(entry.index);
      if (there == nullptr || there->tile == entry.tile || there->tile->part_id() != entry.tile->part_id()) continue;
      for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
        const auto layer = static_cast<BlockLayer>(i);
        if (entry.tile->stored(layer).IsKnown()) there->tile->stored(layer).Adopt(entry.tile->stored(layer));
      }
    }
  }
}

/// What the commit of an edit, and a loaded state after it, has not stored yet: see MapStore::CommitEdit.
constexpr bool kLacksLeft = true;

Status MapIsDeleted(const StateMarks& committed) {
  return NotFound("map '" + committed.info().name + "' has been deleted").WithReason("MAP_NOT_FOUND");
}

/// The reason why this process will store nothing more of this open map, or OK. The store may hold another revision
/// than the last commit left: then it has committed an edit whose answer was lost and which the writer has taken back.
/// The map must be loaded again, which shows the edit; clients reconnect as after a change of the owner.
Status LossBy(const Status& outcome) {
  if (outcome.reason() == Reason("NOT_OWNER") || outcome.reason() == Reason("MAP_NOT_FOUND")) return CopyOf(outcome);
  if (outcome.reason() != Reason("STALE_REVISION")) return Status::Ok();
  return Unavailable("an edit was stored whose answer had been lost: the map is loaded anew").WithReason("NOT_OWNER");
}

}  // namespace

CommitWorker::CommitWorker(MapStore& store, const std::shared_ptr<const MapSnapshot>& committed, double retry_s,
                           Observer observer, Keeper keeper)
    : store_(store),
      retry_s_(retry_s),
      observer_(std::move(observer)),
      keeper_(std::move(keeper)),
      committed_(std::make_shared<const StateMarks>(*committed, nullptr, kLacksLeft)),
      committed_state_(committed) {}

CommitWorker::~CommitWorker() { Stop(); }

void CommitWorker::Request(std::shared_ptr<const MapSnapshot> snapshot, Durability durability, Done done) {
  Enqueue(std::move(snapshot), {.durability = durability, .done = std::move(done)});
}

Status CommitWorker::CommitUnseen(std::shared_ptr<const MapSnapshot> snapshot, std::shared_ptr<const EditRecord> edit) {
  std::promise<Status> outcome;
  Enqueue(std::move(snapshot), {.durability = Durability::kFull,
                                .done = [&outcome](const Status& status) { outcome.set_value(CopyOf(status)); },
                                .is_unseen = true,
                                .edit = std::move(edit)});
  return outcome.get_future().get();
}

void CommitWorker::Enqueue(std::shared_ptr<const MapSnapshot> snapshot, Waiter waiter) {
  Status refused;
  {
    const MutexLock lock(mutex_);
    if (deleted_) {
      refused = MapIsDeleted(*committed_);
    } else if (!loss_.ok()) {
      refused = CopyOf(loss_);
    } else if (stopping_) {
      refused = ShuttingDown();
    } else if (refused = thread_.Start([this] { Loop(); }); refused.ok()) {
      waiters_.push_back(std::move(waiter));  // first: an unseen state must not remain without a waiter
      newest_ = std::move(snapshot);
      wake_.NotifyOne();
      return;
    }
  }
  if (waiter.done) TellSafely([&] { waiter.done(refused); });
}

void CommitWorker::EvictPages(const std::shared_ptr<const MapSnapshot>& same) {
  if (const auto stored = StoredState(); stored != nullptr) AdoptStored(*stored, same);
  std::shared_ptr<const MapSnapshot> before;  // freed after the mutex is released, because it may take long
  const MutexLock lock(mutex_);
  left_ = same;
  if (newest_ != nullptr && newest_->revision() == same->revision()) before = std::exchange(newest_, same);
  if (committed_->revision() == same->revision()) committed_state_ = same;
}

void CommitWorker::DeleteMap(Done done) {
  Status refused;
  {
    const MutexLock lock(mutex_);
    refused = stopping_ ? ShuttingDown() : thread_.Start([this] { Loop(); });
    if (refused.ok()) {
      deletions_.push_back(std::move(done));
      wake_.NotifyOne();
      return;
    }
  }
  TellSafely([&] { done(refused); });
}

std::int64_t CommitWorker::committed_revision() const {
  const MutexLock lock(mutex_);
  return committed_->revision();
}

bool CommitWorker::lacks_left() const {
  const MutexLock lock(mutex_);
  return committed_->lacks_left();
}

std::int64_t CommitWorker::committed_frames() const {
  const MutexLock lock(mutex_);
  return committed_->info().num_frames;
}

std::optional<std::int64_t> CommitWorker::committed_sequence(const std::string& session) const {
  const MutexLock lock(mutex_);
  return committed_->info().sessions.LastOf(session);
}

std::shared_ptr<const MapSnapshot> CommitWorker::StoredState() const {
  const MutexLock lock(mutex_);
  return committed_state_.lock();
}

std::shared_ptr<const MapSnapshot> CommitWorker::LastLeft() const {
  const MutexLock lock(mutex_);
  return left_.lock();
}

Status CommitWorker::loss() const {
  const MutexLock lock(mutex_);
  return CopyOf(loss_);
}

Status CommitWorker::last_outcome() const {
  const MutexLock lock(mutex_);
  return CopyOf(last_outcome_);
}

void CommitWorker::Stop() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  wake_.NotifyOne();
  thread_.Join();
}

void CommitWorker::Loop() {
  NameThisThread("map-commit");
  (void)TakeTurns(Turns::kOrdinary);  // a thread with quick turns may have started this one
  const auto retry = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(retry_s_));
  const MutexLock lock(mutex_);
  while (true) {
    const auto is_ready = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || HasWork(); };
    if (last_outcome_.ok() || deleted_ || !loss_.ok()) {
      if (!wake_.WaitFor(mutex_, LazyThread::kIdle, is_ready)) return thread_.Retire();
    } else if (!wake_.WaitFor(mutex_, retry, is_ready)) {
      CommitNewest();  // behind, with no request pending: try again
      continue;
    }
    const bool last_round = stopping_;
    if (!deletions_.empty()) DeleteNow();
    if (!waiters_.empty() || (last_round && newest_ != nullptr)) CommitNewest();
    if (last_round && !HasWork()) return;
  }
}

/// Returns the marks of the stored state. On a failure or exception the stored state is unchanged.
Result<CommitWorker::Marks> CommitWorker::Store(const Marks& before, const MapSnapshot* after, Durability durability,
                                                const EditRecord* edit) {
  if (after == nullptr) return before;
  // Before storing, because nothing may fail afterwards.
  auto marks = std::make_shared<const StateMarks>(*after, before.get(), edit != nullptr && kLacksLeft);
  try {
    DHPMAP_RETURN_IF_ERROR(edit != nullptr ? store_.CommitEdit(*before, *after, *edit)
                                           : store_.Commit(*before, *after, durability));
  } catch (...) {
    if (!IsStored(*before, *after)) throw;
  }
  return Marks(std::move(marks));
}

/// For a commit that threw, possibly after it was written: starting the next one at `before` would always fail. What an
/// edit left is committed at the edit's revision: it is written once more, which changes nothing.
bool CommitWorker::IsStored(const StateMarks& before, const MapSnapshot& after) {
  if (before.revision() == after.revision()) return false;
  const auto stored = Guarded<Result<StoredMap>>([&] { return store_.GetMap(after.info().name); });
  return stored.ok() && IsSameState(stored->info, after.info());
}

Status CommitWorker::Delete(const std::string& name) {
  try {
    return store_.DeleteMap(name);
  } catch (...) {  // possibly after deleting it
    const auto stored = Guarded<Result<StoredMap>>([&] { return store_.GetMap(name); });
    if (stored.status().code() != StatusCode::kNotFound) throw;
  }
  return Status::Ok();
}

// In both functions only guarded calls may throw: else the mutex would stay locked, and waiters without an answer.

void CommitWorker::CommitNewest() {
  auto before = committed_;
  const bool is_missing = newest_ != nullptr;
  auto after = is_missing ? newest_ : committed_state_.lock();  // nothing is missing: does the store work
  const auto is_unseen = [](const Waiter& waiter) { return waiter.is_unseen; };
  std::vector<Waiter> served = std::exchange(waiters_, {});
  const bool full = stopping_ || std::any_of(served.begin(), served.end(), [](const Waiter& waiter) {
                      return waiter.durability == Durability::kFull;
                    });
  const bool is_deleted = deleted_;
  const Status loss = CopyOf(loss_);  // of a request that came before it was known
  mutex_.Unlock();

  const auto start = Clock::now();
  const auto has_edit = [](const Waiter& waiter) { return waiter.edit != nullptr; };
  const auto edited = std::find_if(served.begin(), served.end(), has_edit);
  const auto marks = Guarded<Result<Marks>>([&]() -> Result<Marks> {
    if (is_deleted) return MapIsDeleted(*before);
    if (!loss.ok()) return loss;
    return Store(before, after.get(), full ? Durability::kFull : Durability::kNormal,
                 edited != served.end() ? edited->edit.get() : nullptr);
  });
  const Status lost = LossBy(marks.status());
  if (!is_deleted) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (keeper_ && marks.ok() && after != nullptr) TellSafely([&] { keeper_(after); });
    if (observer_) TellSafely([&] { observer_(elapsed_s, marks.status()); });
    if (marks.ok() && after != nullptr) TellSafely([&] { AdoptStored(*after, LastLeft()); });
    mutex_.Lock();
    if (marks.ok()) {
      committed_ = *marks;
      // It may be another object by now: see EvictPages.
      const bool is_newest = newest_ != nullptr && after != nullptr && newest_->revision() == after->revision();
      if (is_newest) committed_state_ = std::exchange(newest_, nullptr);
      else if (is_missing) committed_state_ = after;
    } else if (std::any_of(served.begin(), served.end(), is_unseen)) {
      newest_ = nullptr;
    }
    if (!lost.ok()) {
      loss_ = CopyOf(lost);
      newest_ = nullptr;
    }
    last_outcome_ = CopyOf(marks.status());
    mutex_.Unlock();
  }
  for (const Waiter& waiter : served) {
    if (waiter.done) TellSafely([&] { waiter.done(lost.ok() ? marks.status() : lost); });
  }
  served.clear();  // freeing these may take long: not under the lock
  before.reset();
  after.reset();
  mutex_.Lock();
}

void CommitWorker::DeleteNow() {
  const std::vector<Done> served = std::exchange(deletions_, {});
  const auto committed = committed_;
  const bool was_deleted = deleted_;
  mutex_.Unlock();
  const Status status =
      Guarded<Status>([&] { return was_deleted ? MapIsDeleted(*committed) : Delete(committed->info().name); });
  mutex_.Lock();
  if (status.ok()) {
    deleted_ = true;
    newest_ = nullptr;
  }
  mutex_.Unlock();
  for (const Done& done : served) TellSafely([&] { done(status); });
  mutex_.Lock();
}

}  // namespace dhpmap
