// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/publisher.h"

#include <algorithm>
#include <utility>

namespace dhpmap {

Publisher::Publisher(Map& map, Committer& committer, PublishOptions options, const CommitOptions& commit,
                     UtcClock now_ns)
    : map_(map),
      committer_(committer),
      options_(std::move(options)),
      longest_preparation_s_(std::min(options_.delay_s, commit.delay_s)),  // visibility has no callback
      retry_s_(commit.retry_s),
      now_ns_(std::move(now_ns)),
      shown_(std::make_shared<VisibleSnapshot>(std::make_shared<const MapView>(map.published()), options_.prepare)) {}

Publisher::View Publisher::Publish() {
  auto view = MakeView();
  if (view == nullptr) {
    shown_->ShowNewest();
    return Visible();
  }
  shown_->Show(view);
  num_changes_ = 0;
  return view;
}

void Publisher::PublishPrepared() {
  auto view = MakeView();
  if (view == nullptr) return;
  shown_->ShowPrepared(std::move(view));
  num_changes_ = 0;
  show_due_ = DueIn(longest_preparation_s_);
}

/// A view of the changes; null if it must not be visible yet, which postpones the next attempt.
Publisher::View Publisher::MakeView() {
  auto snapshot = map_.Publish(now_ns_());
  if (!committer_.MayBeSeen(*snapshot)) {
    num_changes_ = std::min(num_changes_, 1);
    publish_due_ = DueIn(retry_s_);
    return nullptr;
  }
  auto newest = shown_->Newest();
  if (newest->shared_snapshot() == snapshot) return newest;
  return std::make_shared<const MapView>(std::move(snapshot), newest.get());
}

void Publisher::NoteChange() {
  if (num_changes_++ == 0) publish_due_ = DueIn(options_.delay_s);
}

bool Publisher::IsDue(DueTime now) const {
  return num_changes_ > 0 && (num_changes_ >= options_.frames || now >= publish_due_);
}

void Publisher::ShowIfDue(DueTime now) {
  if (now >= show_due_) shown_->ShowNewest();
}

std::optional<DueTime> Publisher::Due() const {
  std::optional<DueTime> due;
  if (num_changes_ > 0) due = publish_due_;
  if (shown_->IsWaiting()) due = due ? std::min(*due, show_due_) : show_due_;
  return due;
}

}  // namespace dhpmap
