// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/page_evictor.h"

#include <algorithm>
#include <utility>

#include "mapping/base/free_memory.h"
#include "mapping/base/guarded.h"
#include "mapping/base/memory_count.h"
#include "mapping/paging/tile_page.h"

namespace dhpmap {

std::int64_t ResidentBytes(const PageOptions& options) {
  if (options.spill == nullptr) return CountPages().resident_bytes;
  return static_cast<std::int64_t>(CountOf(MemoryKind::kBlocks).now_bytes()) + CountPages().table_bytes;
}

std::int64_t BytesToKeep(const PageOptions& options) { return options.budget_bytes - options.budget_bytes / 4; }

std::int64_t BytesOfReaders(const PageOptions& options) {
  constexpr std::int64_t kLeast = std::int64_t{64} << 20;  // some 200 tiles: what is around a robot must fit
  return options.budget_bytes == 0 ? 0 : std::max(options.budget_bytes / 2, kLeast);
}

/// Where readers hold more than there may be, it is tried again when an eighth has come on top.
bool PageEvictor::HasTooManyPages() const {
  if (options_.budget_bytes == 0) return false;
  const std::int64_t resident_bytes = ResidentBytes(options_);
  const std::int64_t held_bytes = held_bytes_.load(std::memory_order_relaxed);
  return resident_bytes > BytesToKeep(options_) && (has_kept_pages_ || held_bytes == 0 || resident_bytes < held_bytes ||
                                                    resident_bytes > held_bytes + options_.budget_bytes / 8);
}

/// While the state was stored, nothing of it could go.
void PageEvictor::OnKept() {
  if (options_.budget_bytes == 0 || ResidentBytes(options_) <= BytesToKeep(options_)) return;
  if (!kept_->HoldBlocks(options_.spill != nullptr)) return;
  has_kept_pages_ = true;
  EvictSoon();
}

void PageEvictor::EvictSoon() {
  if (!HasTooManyPages() || is_asked_.exchange(true)) return;
  try {
    writer_.queue.Post({.run = [this] { is_asked_ = false; },  // after each job the writer looks
                        .refuse = [this](const Status&) { is_asked_ = false; }});
  } catch (...) {
    is_asked_ = false;  // there is no memory for it: the next one asks again
  }
}

/// First what nobody has asked for since the last time, then, if need be, all. Before what was fused is published
/// nothing can go: so that comes early.
void PageEvictor::Evict() {
  if (!HasTooManyPages()) return;
  if (options_.spill != nullptr && writer_.publisher.has_changes()) {
    TellSafely([this] { writer_.publisher.Publish(); });
  }
  if (writer_.map().is_changed()) return;
  has_kept_pages_ = false;  // first: what comes from now on may come too late
  const std::int64_t resident_bytes = ResidentBytes(options_);
  TellSafely([this, resident_bytes] {
    for (const bool even_used : {false, true}) {
      EvictThoseOf(even_used);
      if (ResidentBytes(options_) <= BytesToKeep(options_)) break;
    }
    if (ResidentBytes(options_) < resident_bytes) GiveBackFreeMemory();
  });
  const std::int64_t left_bytes = ResidentBytes(options_);
  held_bytes_ = left_bytes > BytesToKeep(options_) ? left_bytes : 0;
}

/// From the writer's map, and from all who keep the same state.
void PageEvictor::EvictThoseOf(bool even_used) {
  auto before = writer_.map().published();
  auto same = writer_.map().EvictPages(even_used, options_.spill.get());
  if (same != before) writer_.committer.EvictPages(same);
  // At last whatever there is: a commit under way may have added one with all that was read. Where another map's
  // readers hold too much, states that hold nothing of it stay.
  if (same != before || (even_used && kept_->HoldBlocks(options_.spill != nullptr))) kept_->EvictPages(same);
  before.reset();
  const auto view = writer_.publisher.shown().Newest();
  // Else that state is not to be seen yet.
  if (view->shared_snapshot() != same && view->snapshot().revision() == same->revision()) {
    writer_.publisher.shown().Show(std::make_shared<const MapView>(std::move(same), view.get()));
  }
}

}  // namespace dhpmap
