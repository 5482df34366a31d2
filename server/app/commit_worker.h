// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "storage/store.h"

namespace dhpmap {

/// Brings a map's published snapshots into the store on a thread of its own, so that fusion never waits for the disk.
/// Requests that come while a commit runs are answered by one commit of the newest snapshot. A failed commit changes
/// nothing: the next one again writes everything since the last state that is in the store. Thread-safe.
class CommitWorker {
 public:
  using Done = std::function<void(const Status&)>;
  using Observer = std::function<void(double seconds, const Status& status)>;

  /// `committed`: what the store holds. After a failure the worker tries again every `retry_s`. `observer` (may be
  /// empty) hears of every commit, on the worker's thread.
  CommitWorker(MapStore& store, std::shared_ptr<const MapSnapshot> committed, double retry_s, Observer observer);
  /// Stop().
  ~CommitWorker();
  CommitWorker(const CommitWorker&) = delete;
  CommitWorker& operator=(const CommitWorker&) = delete;

  /// Asks for `snapshot` to be committed, which must not be older than those of earlier calls. `done` (may be empty)
  /// runs on the worker's thread once this snapshot or a newer one is in the store, or the attempt has failed.
  void Request(std::shared_ptr<const MapSnapshot> snapshot, Durability durability, Done done = {});

  /// Removes the map from the store; from then on requests fail with NOT_FOUND. On error nothing has changed.
  void DeleteMap(Done done);

  [[nodiscard]] std::int64_t committed_revision() const;
  /// Outcome of the last commit: OK, or why the store is behind.
  [[nodiscard]] Status last_outcome() const;

  /// Serves what is asked for, tries once more to commit what is not in the store, and ends the thread. Later requests
  /// fail with UNAVAILABLE.
  void Stop();

 private:
  struct Waiter {
    Durability durability;
    Done done;
  };

  void Loop();
  void CommitNewest(std::unique_lock<std::mutex>& lock);
  void DeleteNow(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] bool HasWork() const { return !waiters_.empty() || !deletions_.empty(); }

  MapStore& store_;
  const double retry_s_;
  const Observer observer_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  // Guarded by mutex_.
  std::shared_ptr<const MapSnapshot> committed_;
  std::shared_ptr<const MapSnapshot> newest_;
  std::vector<Waiter> waiters_;
  std::vector<Done> deletions_;
  Status last_outcome_;
  bool stopping_ = false;
  bool deleted_ = false;

  std::thread thread_;
};

}  // namespace dhpmap
