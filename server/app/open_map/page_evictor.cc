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
  constexpr std::int64_t kLeast = std::int64_t{64} << 20;  // about 200 tiles: the robot's surroundings must fit
  return options.budget_bytes == 0 ? 0 : std::max(options.budget_bytes / 2, kLeast);
}

/// If readers hold more than the budget, tries again after growth by an eighth.
bool PageEvictor::HasTooManyPages() const {
  if (options_.budget_bytes == 0) return false;
  const std::int64_t resident_bytes = ResidentBytes(options_);
  const std::int64_t held_bytes = held_bytes_.load(std::memory_order_relaxed);
  return resident_bytes > BytesToKeep(options_) && (has_kept_pages_ || held_bytes == 0 || resident_bytes < held_bytes ||
                                                    resident_bytes > held_bytes + options_.budget_bytes / 8);
}

/// Pages of the state could not be evicted while it was being stored.
void PageEvictor::OnKept() {
  if (options_.budget_bytes == 0 || ResidentBytes(options_) <= BytesToKeep(options_)) return;
  if (!kept_->HoldBlocks(options_.spill != nullptr)) return;
  has_kept_pages_ = true;
  EvictSoon();
}

void PageEvictor::EvictSoon() {
  if (!HasTooManyPages() || is_asked_.exchange(true)) return;
  try {
    writer_.queue.Post({.run = [this] { is_asked_ = false; },  // the writer checks after each job
                        .refuse = [this](const Status&) { is_asked_ = false; }});
  } catch (...) {
    is_asked_ = false;  // memory has run out: the next request tries again
  }
}

/// Evicts unused pages first, then all if necessary. Publishes first, because nothing can be evicted before fused
/// frames are published.
void PageEvictor::Evict() {
  if (!HasTooManyPages()) return;
  if (options_.spill != nullptr && writer_.publisher.has_changes()) {
    TellSafely([this] { writer_.publisher.Publish(); });
  }
  if (writer_.map().is_changed()) return;
  has_kept_pages_ = false;  // first, so that later requests are not lost
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

/// Evicts from the writer's map, and from all holders of the same state.
void PageEvictor::EvictThoseOf(bool even_used) {
  auto before = writer_.map().published();
  auto same = writer_.map().EvictPages(even_used, options_.spill.get());
  if (same != before) writer_.committer.EvictPages(same);
  // Finally evicts all: a running commit may have added a state with all read pages. States without pages stay, if
  // readers of another map exceed the budget.
  if (same != before || (even_used && kept_->HoldBlocks(options_.spill != nullptr))) kept_->EvictPages(same);
  before.reset();
  const auto view = writer_.publisher.shown().Newest();
  // Otherwise that state must not be visible yet.
  if (view->shared_snapshot() != same && view->snapshot().revision() == same->revision()) {
    writer_.publisher.shown().Show(std::make_shared<const MapView>(std::move(same), view.get()));
  }
}

}  // namespace dhpmap
