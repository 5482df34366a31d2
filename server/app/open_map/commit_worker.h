// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/changes/state_marks.h"
#include "server/app/open_map/lazy_thread.h"
#include "storage/store.h"

namespace dhpmap {

/// Commits a map's published snapshots on its own thread, so that fusion never waits for the disk. Requests that arrive
/// during a commit are merged into one commit of the newest snapshot. A failed commit changes nothing: the next one
/// writes everything since the last stored state. Exceptions of the store count as failures, RESOURCE_EXHAUSTED for
/// std::bad_alloc, else INTERNAL; exceptions of callbacks are dropped. The worker gives up, and drops all unstored
/// changes, if the store reports another owner (NOT_OWNER), a deleted map (MAP_NOT_FOUND), or another state
/// (STALE_REVISION). Thread-safe.
class CommitWorker {
 public:
  using Done = std::function<void(const Status&)>;
  using Observer = std::function<void(double seconds, const Status& status)>;
  using Keeper = std::function<void(const std::shared_ptr<const MapSnapshot>& state)>;

  /// `committed`: the stored state; not pinned. After a failure the worker retries every `retry_s`. On the worker's
  /// thread, `observer` (may be empty) is called for every commit; `keeper` (may be empty) for every stored state,
  /// before all other callbacks.
  CommitWorker(MapStore& store, const std::shared_ptr<const MapSnapshot>& committed, double retry_s, Observer observer,
               Keeper keeper = {});
  /// Calls Stop().
  ~CommitWorker();
  CommitWorker(const CommitWorker&) = delete;
  CommitWorker& operator=(const CommitWorker&) = delete;

  /// Requests a commit of `snapshot`, which must not be older than earlier ones. `done` (may be empty) runs on the
  /// worker's thread once this snapshot or a newer one is stored, or the attempt has failed. If this throws
  /// std::bad_alloc, nothing is requested and `done` never runs.
  void Request(std::shared_ptr<const MapSnapshot> snapshot, Durability durability, Done done = {});

  /// Commits `snapshot`, which is not visible yet, with a full sync, and waits. On error, or if it throws, the snapshot
  /// is dropped without a trace: no later commit writes it. Not concurrently with Request or CommitUnseen. `edit` is
  /// logged with it; null: none.
  Status CommitUnseen(std::shared_ptr<const MapSnapshot> snapshot, std::shared_ptr<const EditRecord> edit = nullptr);

  /// `same` is a pending or stored state with evicted voxels (Map::EvictPages); it replaces the original, which would
  /// keep them in memory.
  void EvictPages(const std::shared_ptr<const MapSnapshot>& same) DHPMAP_EXCLUDES(mutex_);

  /// Removes the map from the store; later requests fail with NOT_FOUND. On error nothing has changed.
  void DeleteMap(Done done);

  // Of the stored state.
  [[nodiscard]] std::int64_t committed_revision() const;
  /// Whether the old place of its edit's object (MapSnapshot::leaving) is not stored yet; the next commit writes it.
  [[nodiscard]] bool lacks_left() const;
  [[nodiscard]] std::int64_t committed_frames() const;
  /// The sequence of the feed session's last stored frame; nothing if there is none.
  [[nodiscard]] std::optional<std::int64_t> committed_sequence(const std::string& session) const;
  /// Not OK: another process owns the map, or the map was deleted. Does not throw.
  [[nodiscard]] Status loss() const;
  /// Outcome of the last commit: OK, or why the store is behind. Does not throw.
  [[nodiscard]] Status last_outcome() const;

  /// Serves pending requests, tries once more to commit unstored changes, and ends the thread. Later requests fail with
  /// UNAVAILABLE.
  void Stop();

 private:
  struct Waiter {
    Durability durability;
    Done done;
    bool is_unseen = false;
    std::shared_ptr<const EditRecord> edit = nullptr;
  };

  void Enqueue(std::shared_ptr<const MapSnapshot> snapshot, Waiter waiter);

  [[nodiscard]] std::shared_ptr<const MapSnapshot> StoredState() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::shared_ptr<const MapSnapshot> LastLeft() const DHPMAP_EXCLUDES(mutex_);
  void Loop();
  // Both release the mutex while they work.
  void CommitNewest() DHPMAP_REQUIRES(mutex_);
  void DeleteNow() DHPMAP_REQUIRES(mutex_);
  using Marks = std::shared_ptr<const StateMarks>;
  [[nodiscard]] Result<Marks> Store(const Marks& before, const MapSnapshot* after, Durability durability,
                                    const EditRecord* edit);
  [[nodiscard]] bool IsStored(const StateMarks& before, const MapSnapshot& after);
  [[nodiscard]] Status Delete(const std::string& name);
  [[nodiscard]] bool HasWork() const DHPMAP_REQUIRES(mutex_) { return !waiters_.empty() || !deletions_.empty(); }

  MapStore& store_;
  const double retry_s_;
  const Observer observer_;
  const Keeper keeper_;

  mutable Mutex mutex_;
  CondVar wake_;
  // Marks of the stored state: pinning the state itself would soon keep a second copy of each block that mapping
  // changes.
  std::shared_ptr<const StateMarks> committed_ DHPMAP_GUARDED_BY(mutex_);
  std::weak_ptr<const MapSnapshot> committed_state_ DHPMAP_GUARDED_BY(mutex_);  // if pinned elsewhere
  std::shared_ptr<const MapSnapshot> newest_ DHPMAP_GUARDED_BY(mutex_);         // null: everything is stored
  std::weak_ptr<const MapSnapshot> left_ DHPMAP_GUARDED_BY(mutex_);             // last argument of EvictPages
  std::vector<Waiter> waiters_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<Done> deletions_ DHPMAP_GUARDED_BY(mutex_);
  Status last_outcome_ DHPMAP_GUARDED_BY(mutex_);
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool deleted_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status loss_ DHPMAP_GUARDED_BY(mutex_);

  LazyThread thread_;  // started and retired under the mutex; joined by Stop, after the last start
};

}  // namespace dhpmap
