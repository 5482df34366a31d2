// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/app/session/commit_worker.h"
#include "server/app/session/due_time.h"
#include "server/app/session/number_reserve.h"
#include "server/app/session/store_lag.h"

namespace dhpmap {

struct CommitOptions {
  // Fused frames go to the store after so many of them, or so long after the first of them.
  int frames = 50;
  double delay_s = 2.0;
  double retry_s = 5.0;      ///< between attempts while the store refuses
  double max_behind_s = 30;  ///< what is fused may be so long not stored; then frames are refused
  std::function<void(double seconds, const Status& status)> on_commit = {};  ///< on the commit thread; may be empty
  std::function<void()> on_stored = {};  ///< the store has another state of the map; on the commit thread; may be empty
};

/// Brings the published states of a map into the store, and knows how far the store has got. Its questions are
/// thread-safe; all else is for the map's writer thread.
class Committer {
 public:
  using State = std::shared_ptr<const MapSnapshot>;

  /// `stored`: what the store has. `keeper`: see CommitWorker. The store outlives this.
  Committer(MapStore& store, const State& stored, CommitOptions options, CommitWorker::Keeper keeper);

  // A batch holds the changes since the last request to commit. It is held until its state is visible: watchers hear of
  // visible states only.
  void NoteChange();
  [[nodiscard]] bool IsBatchDue(DueTime now) const;
  void HoldBatch();
  [[nodiscard]] bool has_held_batch() const { return is_batch_held_; }
  /// Commits a batch on the commit thread, which also reserves numbers there: here fusion would wait for the store.
  void StoreBatch(State published);
  /// When to look at IsBatchDue; of a held batch, once `is_visible`.
  [[nodiscard]] std::optional<DueTime> BatchDue(bool is_visible) const;
  /// An attempt has failed: it is due again at that time.
  void PutOffBatch(DueTime until) { batch_due_ = until; }

  /// Whether others may see the state: after a crash none of its numbers would be given to something else.
  [[nodiscard]] bool MayBeSeen(const MapSnapshot& state);
  /// Commits everything up to `published`: see CommitWorker::Request. Ends the batch. If it throws, what is to be
  /// stored still is, and `done` never runs.
  void Request(State published, Durability durability, CommitWorker::Done done = {});
  /// The same, and waits. Not with a full sync: that comes with the commit of the edit that waits for this.
  Status StoreFirst(const State& published);
  /// See CommitWorker::CommitUnseen.
  Status StoreUnseen(State state, std::shared_ptr<const EditRecord> edit) {
    return worker_.CommitUnseen(std::move(state), std::move(edit));
  }
  /// Whether the last edit has left something to be stored: see CommitWorker::lacks_left.
  [[nodiscard]] bool lacks_left() const { return worker_.lacks_left(); }
  /// Stores that, without anybody waiting. The batch goes on: its frames may not be in this state.
  void StoreLeft(State published) { worker_.Request(std::move(published), Durability::kNormal); }
  /// See CommitWorker::LetGoOfPages.
  void LetGoOfPages(const State& same) { worker_.LetGoOfPages(same); }

  /// The map's frame number `num_frames` is fused. Does not throw.
  void OnFused(std::int64_t num_frames) { lag_.OnFused(num_frames, StoreLag::Clock::now()); }
  /// UNAVAILABLE, reason STORE_BEHIND, while the store is behind for longer than max_behind_s.
  [[nodiscard]] Status CheckIsNotBehind() const;

  // Questions: thread-safe.
  /// For how long what was fused has not been stored.
  [[nodiscard]] double BehindSeconds() const;
  [[nodiscard]] std::int64_t stored_revision() const { return worker_.committed_revision(); }
  [[nodiscard]] std::int64_t stored_frames() const { return worker_.committed_frames(); }
  /// Of the session's last frame; nothing if none of it is there.
  [[nodiscard]] std::optional<std::int64_t> StoredSequence(const std::string& session) const {
    return worker_.committed_sequence(session);
  }
  /// OK, or why the store is behind. Does not throw.
  [[nodiscard]] Status last_outcome() const { return worker_.last_outcome(); }

  /// Removes the map from the store, and waits. On any thread.
  Status DeleteMap();
  /// Ends the commit thread: see CommitWorker::Stop. On any thread, when the writer thread has ended.
  void Stop() { worker_.Stop(); }
  /// After Stop: if all of `last` is stored, numbering goes on without a gap when the map is opened again.
  void ReleaseNumbers(const MapInfo& last);

 private:
  const CommitOptions options_;
  NumberReserve numbers_;
  CommitWorker worker_;
  mutable StoreLag lag_;  // hears of commits when it is asked

  int num_changes_ = 0;  ///< of the batch
  DueTime batch_due_;
  bool is_batch_held_ = false;
};

}  // namespace dhpmap
