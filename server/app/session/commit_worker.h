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
#include "server/app/session/lazy_thread.h"
#include "storage/store.h"

namespace dhpmap {

/// Brings a map's published snapshots into the store on a thread of its own, so that fusion never waits for the disk.
/// Requests that come while a commit runs are answered by one commit of the newest snapshot. A failed commit changes
/// nothing: the next one again writes everything since the last state that is in the store. What the store throws is a
/// failure, RESOURCE_EXHAUSTED for want of memory, else INTERNAL; what callbacks throw is dropped. Thread-safe.
class CommitWorker {
 public:
  using Done = std::function<void(const Status&)>;
  using Observer = std::function<void(double seconds, const Status& status)>;
  using Keeper = std::function<void(const std::shared_ptr<const MapSnapshot>& state)>;

  /// `committed`: what the store holds; it is not kept. After a failure the worker tries again every `retry_s`.
  /// `observer` (may be empty) hears of every commit, on the worker's thread; `keeper` (may be empty) likewise, and
  /// before anybody else, of every state that is in the store from then on.
  CommitWorker(MapStore& store, const std::shared_ptr<const MapSnapshot>& committed, double retry_s, Observer observer,
               Keeper keeper = {});
  /// Stop().
  ~CommitWorker();
  CommitWorker(const CommitWorker&) = delete;
  CommitWorker& operator=(const CommitWorker&) = delete;

  /// Asks for `snapshot` to be committed, which must not be older than those of earlier calls. `done` (may be empty)
  /// runs on the worker's thread once this snapshot or a newer one is in the store, or the attempt has failed.
  /// If this throws, for want of memory, nothing was asked for, and `done` never runs.
  void Request(std::shared_ptr<const MapSnapshot> snapshot, Durability durability, Done done = {});

  /// Asks for `snapshot`, which nobody has seen yet, to be committed with a full sync, and waits for the outcome. On
  /// error it is dropped, as if it had never been: no later commit writes it. Not while another call of Request or
  /// CommitUnseen is under way.
  /// The same if it throws. `edit` goes into the log with it; null: nothing does.
  Status CommitUnseen(std::shared_ptr<const MapSnapshot> snapshot, std::shared_ptr<const EditRecord> edit = nullptr);

  /// `same` is a state again that waits to be stored, or is, with voxels left in the store (Map::LetGoOfPages): it
  /// takes the place of that one, which this would keep in memory, or would look in vain for.
  void LetGoOfPages(const std::shared_ptr<const MapSnapshot>& same) DHPMAP_EXCLUDES(mutex_);

  /// Removes the map from the store; from then on requests fail with NOT_FOUND. On error nothing has changed.
  void DeleteMap(Done done);

  // Of what is in the store.
  [[nodiscard]] std::int64_t committed_revision() const;
  /// Whether what its edit has left is not (MapSnapshot::leaving): the next commit writes it.
  [[nodiscard]] bool lacks_left() const;
  [[nodiscard]] std::int64_t committed_frames() const;
  /// Of the session's last frame; nothing if none of it is there.
  [[nodiscard]] std::optional<std::int64_t> committed_sequence(const std::string& session) const;
  /// Outcome of the last commit: OK, or why the store is behind. Does not throw.
  [[nodiscard]] Status last_outcome() const;

  /// Serves what is asked for, tries once more to commit what is not in the store, and ends the thread. Later requests
  /// fail with UNAVAILABLE.
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
  // Both let go of the mutex while they work.
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
  // What is in the store, as marks: while a map is fed, each block of a state that is kept is soon a second copy.
  std::shared_ptr<const StateMarks> committed_ DHPMAP_GUARDED_BY(mutex_);
  std::weak_ptr<const MapSnapshot> committed_state_ DHPMAP_GUARDED_BY(mutex_);  // while somebody else keeps it
  std::shared_ptr<const MapSnapshot> newest_ DHPMAP_GUARDED_BY(mutex_);         // null: all is in the store
  std::weak_ptr<const MapSnapshot> left_ DHPMAP_GUARDED_BY(mutex_);             // the last that LetGoOfPages was given
  std::vector<Waiter> waiters_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<Done> deletions_ DHPMAP_GUARDED_BY(mutex_);
  Status last_outcome_ DHPMAP_GUARDED_BY(mutex_);
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool deleted_ DHPMAP_GUARDED_BY(mutex_) = false;

  LazyThread thread_;  // started and retired under the mutex, joined by Stop, after which nobody starts it
};

}  // namespace dhpmap
