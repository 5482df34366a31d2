// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/committer.h"

#include <future>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {
namespace {

/// Calls on_commit after every commit, and on_stored after successful ones.
CommitWorker::Observer ObserverOf(const CommitOptions& options) {
  return [on_commit = options.on_commit, on_stored = options.on_stored](double seconds, const Status& status) {
    if (on_commit) TellSafely([&] { on_commit(seconds, status); });
    if (on_stored && status.ok()) TellSafely(on_stored);
  };
}

}  // namespace

Committer::Committer(MapStore& store, const State& stored, CommitOptions options, CommitWorker::Keeper keeper)
    : options_(std::move(options)),
      numbers_(store, {stored->revision(), stored->info().next_submap_id}),
      worker_(store, stored, options_.retry_s, ObserverOf(options_), std::move(keeper)) {}

void Committer::NoteChange() {
  if (num_changes_++ == 0) batch_due_ = DueIn(options_.delay_s);
}

bool Committer::IsBatchDue(DueTime now) const {
  return num_changes_ > 0 && !is_batch_held_ && (num_changes_ >= options_.frames || now >= batch_due_);
}

void Committer::HoldBatch() {
  is_batch_held_ = true;
  num_changes_ = 0;
}

std::optional<DueTime> Committer::BatchDue(bool is_visible) const {
  const bool is_something_due = is_batch_held_ ? is_visible : num_changes_ > 0;
  return is_something_due ? std::optional(batch_due_) : std::nullopt;
}

void Committer::StoreBatch(State published) {
  const std::string name = published->info().name;
  worker_.Request(std::move(published), Durability::kNormal, [this, name](const Status& stored) {
    if (stored.ok()) numbers_.GoAhead(name);
  });
  is_batch_held_ = false;
}

bool Committer::MayBeSeen(const MapSnapshot& state) {
  const Status covered = Guarded<Status>([&] { return numbers_.Cover(state.info()); });
  return covered.ok() || stored_revision() == state.revision();
}

void Committer::Request(State published, Durability durability, CommitWorker::Done done) {
  worker_.Request(std::move(published), durability, std::move(done));
  num_changes_ = 0;
  is_batch_held_ = false;
}

Status Committer::StoreFirst(const State& published) {
  if (stored_revision() == published->revision() && !lacks_left()) return Status::Ok();
  std::promise<Status> outcome;
  Request(published, Durability::kNormal, [&outcome](const Status& status) { outcome.set_value(CopyOf(status)); });
  return outcome.get_future().get();
}

/// More frames would only increase the loss in a crash.
Status Committer::CheckIsNotBehind() const {
  DHPMAP_RETURN_IF_ERROR(worker_.loss());
  const double behind_s = BehindSeconds();
  if (behind_s <= options_.max_behind_s) return Status::Ok();
  const std::string cause = last_outcome().message();
  return Unavailable("the store is " + std::to_string(static_cast<int>(behind_s)) + " s behind" +
                     (cause.empty() ? "" : ": " + cause) + "; send the frame again when it has caught up")
      .WithReason("STORE_BEHIND");
}

double Committer::BehindSeconds() const {
  lag_.OnStored(stored_frames());
  return lag_.Seconds(StoreLag::Clock::now());
}

Status Committer::DeleteMap() {
  return Guarded<Status>([this] {
    std::promise<Status> outcome;
    worker_.DeleteMap([&outcome](const Status& stored) { outcome.set_value(CopyOf(stored)); });
    return outcome.get_future().get();
  });
}

void Committer::ReleaseNumbers(const MapInfo& last) {
  if (!last_outcome().ok() || stored_revision() != last.revision) return;
  numbers_.Release(last);
}

}  // namespace dhpmap
