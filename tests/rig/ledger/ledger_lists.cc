// SPDX-License-Identifier: BSD-3-Clause
// What the ledger is told of lists of edits, and of backups.
#include <utility>

#include "tests/rig/ledger/ledger.h"
#include "tests/rig/ledger/sights.h"

namespace dhpmap::rig {

/// One of them says whether the list is stale, so that it counts once.
void Ledger::PendAll(const std::vector<EditId>& list, const Pending& pending) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    Pending of = pending;
    of.is_stale = pending.is_stale && i == 0;
    Pend(list[i], std::move(of));
  }
}

std::optional<std::vector<EditId>> Ledger::BeginList(std::vector<SubmapEdit> list) {
  const MutexLock lock(mutex_);
  ++now_;
  if (list.empty()) return std::nullopt;
  Pending pending{.what = list.front().plan.what, .history = list.front().plan.history, .begun = now_};
  for (const SubmapEdit& edit : list) {
    pending.is_stale = pending.is_stale || (edit.etag && IsStale(*edit.etag, edit.plan.history));
  }
  std::vector<EditPlan> plans;
  plans.reserve(list.size());
  for (SubmapEdit& edit : list) {
    edit.plan.is_vain = pending.is_stale;  // one etag that does not hold is enough
    plans.push_back(std::move(edit.plan));
  }
  auto ids = book_.BeginList(std::move(plans), now_);
  if (ids) PendAll(*ids, pending);
  return ids;
}

std::optional<std::vector<EditId>> Ledger::BeginUndo(const std::vector<EditId>& made, bool is_redo) {
  const MutexLock lock(mutex_);
  const char* what = is_redo ? "RedoEdits" : "UndoEdits";
  auto ids = book_.BeginUndo(made, is_redo, what, ++now_);
  if (!ids) return std::nullopt;
  PendAll(*ids, {.what = what, .history = book_.HistoryOf(ids->front()), .begun = now_});
  ++tally_.num_undone;
  return ids;
}

void Ledger::OnListMade(const std::vector<EditId>& list, const std::vector<std::optional<std::int64_t>>& ids,
                        std::int64_t map_revision) {
  const MutexLock lock(mutex_);
  ++now_;
  ++tally_.num_lists_made;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Pending pending = Settle(list[i]);
    if (pending.is_stale) complaints_.push_back("law 5: made, with an etag that did not hold: " + pending.what);
    if (i == 0) {
      ProgressOf(pending.history).OnDurable(map_revision);
      ProgressOf(pending.history).OnRevision(map_revision, pending.begun, now_);
    }
    book_.OnMade(list[i], ids[i], nullptr, now_);
  }
}

void Ledger::OnListRefused(const std::vector<EditId>& list) {
  const MutexLock lock(mutex_);
  ++now_;
  ++tally_.num_lists_refused;
  for (const EditId edit : list) {
    (void)Settle(edit);
    book_.OnRefused(edit);
  }
}

void Ledger::OnListCut(const std::vector<EditId>& list) {
  const MutexLock lock(mutex_);
  ++tally_.num_lists_cut;
  for (const EditId edit : list) {
    (void)Settle(edit);
    book_.OnCut(edit);
  }
}

bool Ledger::IsHeld(const std::string& history, std::int64_t id) const {
  const MutexLock lock(mutex_);
  return book_.IsHeld({history, id});
}

std::int64_t Ledger::NumStoredFrames(const std::string& history) {
  const MutexLock lock(mutex_);
  return ProgressOf(history).num_stored();
}

void Ledger::OnBackup(const std::string& history, const v1::Map& map, const v1::ListSubmapsResponse& all,
                      std::int64_t num_stored, Moment asked, Moment answered) {
  const MutexLock lock(mutex_);
  ++tally_.num_backups;
  if (map.num_frames() < num_stored) {
    complaints_.push_back("law 6: a backup has " + std::to_string(map.num_frames()) + " frames of history " + history +
                          ", of which " + std::to_string(num_stored) + " were told to be stored before");
  }
  book_.OnWhole(history, SightsOf(all), asked, answered);
}

}  // namespace dhpmap::rig
