// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/app/open_map/commit_worker.h"
#include "server/app/open_map/due_time.h"
#include "server/app/open_map/number_reserve.h"
#include "server/app/open_map/store_lag.h"

namespace dhpmap {

struct CommitOptions {
  // Fused frames are stored after this many, or this long after the first of them.
  int frames = 50;
  double delay_s = 2.0;
  double retry_s = 5.0;      ///< between attempts while the store fails
  double max_behind_s = 30;  ///< maximum age of unstored frames; beyond it frames are refused (back pressure)
  std::function<void(double seconds, const Status& status)> on_commit = {};  ///< on the commit thread; may be empty
  std::function<void()> on_stored = {};  ///< the store has a new state of the map; on the commit thread; may be empty
};

/// Stores the published states of a map and knows the stored state. Const queries are thread-safe; all else is for the
/// map's writer thread.
class Committer {
 public:
  using State = std::shared_ptr<const MapSnapshot>;

  /// `stored`: the stored state. `keeper`: see CommitWorker. The store outlives this.
  Committer(MapStore& store, const State& stored, CommitOptions options, CommitWorker::Keeper keeper);

  // A batch holds the changes since the last commit request, until its state is visible: watchers see only visible
  // states.
  void NoteChange();
  [[nodiscard]] bool IsBatchDue(DueTime now) const;
  void HoldBatch();
  [[nodiscard]] bool has_held_batch() const { return is_batch_held_; }
  /// Commits a batch on the commit thread, which also reserves numbers there, so that fusion does not wait for the
  /// store.
  void StoreBatch(State published);
  /// When to check IsBatchDue; for a held batch, once `is_visible`.
  [[nodiscard]] std::optional<DueTime> BatchDue(bool is_visible) const;
  /// After a failed attempt: due again at that time.
  void PutOffBatch(DueTime until) { batch_due_ = until; }

  /// Whether the state may become visible: its numbers are reserved, so that they never get another meaning after a
  /// crash.
  [[nodiscard]] bool MayBeSeen(const MapSnapshot& state);
  /// Commits everything up to `published`: see CommitWorker::Request. Ends the batch. If it throws, the changes stay
  /// pending, and `done` never runs.
  void Request(State published, Durability durability, CommitWorker::Done done = {});
  /// The same, and waits. Without a full sync: the commit of the edit that waits for this does it.
  Status StoreFirst(const State& published);
  /// See CommitWorker::CommitUnseen.
  Status StoreUnseen(State state, std::shared_ptr<const EditRecord> edit) {
    return worker_.CommitUnseen(std::move(state), std::move(edit));
  }
  /// Whether the old place of the last edit's object is still to be stored: see CommitWorker::lacks_left.
  [[nodiscard]] bool lacks_left() const { return worker_.lacks_left(); }
  /// Stores it in the background. Does not end the batch: its frames may not be in this state.
  void StoreLeft(State published) { worker_.Request(std::move(published), Durability::kNormal); }
  /// See CommitWorker::EvictPages.
  void EvictPages(const State& same) { worker_.EvictPages(same); }

  /// The map's frame number `num_frames` is fused. Does not throw.
  void OnFused(std::int64_t num_frames) { lag_.OnFused(num_frames, StoreLag::Clock::now()); }
  /// UNAVAILABLE, reason STORE_BEHIND, while unstored frames are older than max_behind_s; CommitWorker::loss.
  [[nodiscard]] Status CheckIsNotBehind() const;

  // Queries: thread-safe.
  /// Age of the oldest unstored frame.
  [[nodiscard]] double BehindSeconds() const;
  [[nodiscard]] std::int64_t stored_revision() const { return worker_.committed_revision(); }
  [[nodiscard]] std::int64_t stored_frames() const { return worker_.committed_frames(); }
  /// The sequence of the feed session's last stored frame; nothing if there is none.
  [[nodiscard]] std::optional<std::int64_t> StoredSequence(const std::string& session) const {
    return worker_.committed_sequence(session);
  }
  /// See CommitWorker::loss.
  [[nodiscard]] Status loss() const { return worker_.loss(); }
  /// OK, or why the store is behind. Does not throw.
  [[nodiscard]] Status last_outcome() const { return worker_.last_outcome(); }

  /// Removes the map from the store, and waits. From any thread.
  Status DeleteMap();
  /// Ends the commit thread: see CommitWorker::Stop. From any thread, after the writer thread has ended.
  void Stop() { worker_.Stop(); }
  /// After Stop: if all of `last` is stored, numbers continue without a gap when the map is opened again.
  void ReleaseNumbers(const MapInfo& last);

 private:
  const CommitOptions options_;
  NumberReserve numbers_;
  CommitWorker worker_;
  mutable StoreLag lag_;  // updated by queries

  int num_changes_ = 0;  ///< of the batch
  DueTime batch_due_;
  bool is_batch_held_ = false;
};

}  // namespace dhpmap
