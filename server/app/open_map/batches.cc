// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/batches.h"

#include <algorithm>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {

void Batches::NoteChange() {
  publisher_.NoteChange();
  committer_.NoteChange();
}

std::optional<DueTime> Batches::Due() const {
  // In this order: a state may become visible at any time, and only this thread lets a state wait. If the publisher has
  // nothing due, nothing waits below either, so a held batch is due.
  const std::optional<DueTime> publish_due = publisher_.Due();
  const std::optional<DueTime> commit_due = committer_.BatchDue(!publisher_.shown().IsWaiting());
  if (!publish_due || !commit_due) return publish_due ? publish_due : commit_due;
  return std::min(*publish_due, *commit_due);
}

void Batches::DoThoseDue() {
  const Status status = Guarded<Status>([this] {
    const auto now = DueTime::clock::now();
    publisher_.ShowIfDue(now);
    const bool is_commit_due = committer_.IsBatchDue(now);
    const bool is_publish_due = publisher_.IsDue(now);
    const auto is_visible = [this] { return !publisher_.shown().IsWaiting(); };
    if (committer_.has_held_batch() && (is_publish_due || is_visible())) StoreHeldBatch();
    if (is_publish_due || (is_commit_due && publisher_.has_changes())) publisher_.PublishPrepared();
    if (is_commit_due) {
      committer_.HoldBatch();
      if (is_visible()) StoreHeldBatch();
    }
    return Status::Ok();
  });
  if (status.ok()) return;
  const DueTime later = DueIn(retry_s_);
  publisher_.PutOff(later);
  committer_.PutOffBatch(later);
}

/// Makes the newest published state visible, then stores it: watchers must only hear of visible states.
void Batches::StoreHeldBatch() {
  publisher_.shown().ShowNewest();
  committer_.StoreBatch(map_.published());
}

void Batches::StoreAll(CommitWorker::Done done) {
  publisher_.Publish();
  committer_.Request(map_.published(), Durability::kFull, std::move(done));
}

/// A failure for lack of memory is retried once: the jobs have freed some.
Status Batches::StoreTheRest() {
  const auto store = [this] {
    StoreAll();
    return Status::Ok();
  };
  Status outcome = Guarded<Status>(store);
  if (!outcome.ok()) outcome = Guarded<Status>(store);
  return outcome;
}

}  // namespace dhpmap
