// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/map/map.h"
#include "server/app/open_map/committer.h"
#include "server/app/open_map/due_time.h"
#include "server/app/open_map/publisher.h"

namespace dhpmap {

/// Schedules when changes of a map become visible and when they are stored: in batches, because each snapshot and each
/// commit costs time. Writer thread only.
class Batches {
 public:
  /// All outlive this. Failures are retried after `retry_s`.
  Batches(Map& map, Publisher& publisher, Committer& committer, double retry_s)
      : map_(map), publisher_(publisher), committer_(committer), retry_s_(retry_s) {}

  /// A change for the next batch, due alone after a while.
  void NoteChange();
  /// Next time to publish, show or commit; nothing: none.
  [[nodiscard]] std::optional<DueTime> Due() const;
  /// Does not throw: failures are retried later.
  void DoThoseDue();

  /// Publishes everything and requests a commit with a full sync. `done` as in CommitWorker::Request.
  void StoreAll(CommitWorker::Done done = {});
  /// The same at the end. An error if the request itself failed.
  Status StoreTheRest();

 private:
  void StoreHeldBatch();

  Map& map_;
  Publisher& publisher_;
  Committer& committer_;
  const double retry_s_;
};

}  // namespace dhpmap
