// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "mapping/map/map.h"
#include "server/app/open_map/committer.h"
#include "server/app/open_map/due_time.h"
#include "server/app/states/map_view.h"
#include "server/app/states/visible_snapshot.h"

namespace dhpmap {

struct PublishOptions {
  // Fused frames become visible to queries after this many, or this long after the first of them.
  int frames = 10;
  double delay_s = 0.2;
  /// Prepares caches for queries before a state becomes visible; may be empty. May delay a state of frames by another
  /// delay_s, or CommitOptions::delay_s if that is less.
  VisibleSnapshot::Prepare prepare = {};
};

/// Makes the states of a map's writer visible to queries. View and shown are thread-safe; all else is for the writer
/// thread.
class Publisher {
 public:
  using View = std::shared_ptr<const MapView>;

  /// `map` and `committer` outlive this; `commit` are the options of the latter.
  Publisher(Map& map, Committer& committer, PublishOptions options, const CommitOptions& commit, UtcClock now_ns);

  /// The visible state, and its holder.
  [[nodiscard]] View Visible() const { return shown_->Get(); }
  [[nodiscard]] VisibleSnapshot& shown() const { return *shown_; }

  /// Publishes all changes, makes them visible, and returns the visible state: the previous one if numbers could not be
  /// reserved. If it throws, the changes stay pending.
  View Publish();
  /// The same once the state is prepared, or has waited long enough.
  void PublishPrepared();

  // Scheduling: changes are published in batches.
  void NoteChange();
  [[nodiscard]] bool has_changes() const { return num_changes_ > 0; }
  [[nodiscard]] bool IsDue(DueTime now) const;
  /// Makes a state visible whose preparation has taken too long.
  void ShowIfDue(DueTime now);
  /// When to check these; nothing: not before the next change.
  [[nodiscard]] std::optional<DueTime> Due() const;
  /// After a failed attempt: due again at that time.
  void PutOff(DueTime until) { publish_due_ = until; }

 private:
  View MakeView();

  Map& map_;
  Committer& committer_;
  const PublishOptions options_;
  const double longest_preparation_s_;
  const double retry_s_;
  const UtcClock now_ns_;
  const std::shared_ptr<VisibleSnapshot> shown_;  // preparations may outlive this

  int num_changes_ = 0;  ///< frames, or changes by finishing
  DueTime publish_due_;
  DueTime show_due_;  ///< of a state being prepared
};

}  // namespace dhpmap
