// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "mapping/map/map.h"
#include "server/app/session/committer.h"
#include "server/app/session/due_time.h"
#include "server/app/states/map_view.h"
#include "server/app/states/shown_view.h"

namespace dhpmap {

struct PublishOptions {
  // Fused frames become visible to queries after so many of them, or so long after the first of them.
  int frames = 10;
  double delay_s = 0.2;
  /// What is made ready for queries before they see a state; may be empty. May keep one that frames have made from them
  /// for another delay_s, or CommitOptions::delay_s if that is less.
  ShownView::Prepare prepare = {};
};

/// Makes the states of a map that its writer works on visible to queries. View and shown are thread-safe; all else is
/// for the writer thread.
class Publisher {
 public:
  using View = std::shared_ptr<const MapView>;

  /// `map` and `committer` outlive this; `commit` is what the latter was made with.
  Publisher(Map& map, Committer& committer, PublishOptions options, const CommitOptions& commit, UtcClock now_ns);

  /// The state that is seen, and all that decides which one is.
  [[nodiscard]] View Visible() const { return shown_->Get(); }
  [[nodiscard]] ShownView& shown() const { return *shown_; }

  /// Publishes what has changed, so that all see it, and returns what is seen then: the state before, where numbers
  /// could not be reserved for it. If it throws, what is to be seen still is.
  View Publish();
  /// The same once the state is prepared, or has waited for that long enough.
  void PublishPrepared();

  // When: changes are published together.
  void NoteChange();
  [[nodiscard]] bool has_changes() const { return num_changes_ > 0; }
  [[nodiscard]] bool IsDue(DueTime now) const;
  /// Shows a state that has waited long enough for its preparation.
  void ShowIfDue(DueTime now);
  /// When to look at these; nothing: not before something changes.
  [[nodiscard]] std::optional<DueTime> Due() const;
  /// An attempt has failed: it is due again at that time.
  void PutOff(DueTime until) { publish_due_ = until; }

 private:
  View MakeView();

  Map& map_;
  Committer& committer_;
  const PublishOptions options_;
  const double longest_preparation_s_;
  const double retry_s_;
  const UtcClock now_ns_;
  const std::shared_ptr<ShownView> shown_;  // outlived by what prepares

  int num_changes_ = 0;  ///< frames, or what finishing did
  DueTime publish_due_;
  DueTime show_due_;  ///< of a state that is prepared
};

}  // namespace dhpmap
