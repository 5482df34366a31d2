// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/map/map.h"
#include "server/app/session/committer.h"
#include "server/app/session/due_time.h"
#include "server/app/session/publisher.h"

namespace dhpmap {

/// Decides when changes of a map become visible, and when they are stored: several together, each of which alone would
/// cost a snapshot and a commit. For the writer thread alone.
class Batches {
 public:
  /// All outlive this. What has failed is tried again after `retry_s`.
  Batches(Map& map, Publisher& publisher, Committer& committer, double retry_s)
      : map_(map), publisher_(publisher), committer_(committer), retry_s_(retry_s) {}

  /// A change that is to be seen and stored with others, or alone after a while.
  void NoteChange();
  /// When there is something to publish, show or commit; nothing: there is not.
  [[nodiscard]] std::optional<DueTime> Due() const;
  /// Does not throw: what fails is done later.
  void DoThoseDue();

  /// Publishes everything, and asks for it to be stored with a full sync. `done` as in CommitWorker::Request.
  void StoreAll(CommitWorker::Done done = {});
  /// The same at the end. An error if it could not even be asked for.
  Status StoreTheRest();

 private:
  void StoreHeldBatch();

  Map& map_;
  Publisher& publisher_;
  Committer& committer_;
  const double retry_s_;
};

}  // namespace dhpmap
