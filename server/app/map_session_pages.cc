// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <utility>

#include "mapping/base/free_memory.h"
#include "mapping/base/guarded.h"
#include "mapping/base/memory_count.h"
#include "mapping/paging/tile_page.h"
#include "server/app/map_session.h"

namespace dhpmap {

std::int64_t ResidentBytes(const SessionOptions& options) {
  if (options.spill == nullptr) return CountPages().resident_bytes;
  return static_cast<std::int64_t>(CountOf(MemoryKind::kBlocks).now_bytes()) + CountPages().table_bytes;
}

std::int64_t BytesToKeep(const SessionOptions& options) { return options.page_bytes - options.page_bytes / 4; }

std::int64_t BytesOfReaders(const SessionOptions& options) {
  constexpr std::int64_t kLeast = std::int64_t{64} << 20;  // some 200 tiles: what is around a robot must fit
  return options.page_bytes == 0 ? 0 : std::max(options.page_bytes / 2, kLeast);
}

/// Where readers hold more than there may be, it is tried again when an eighth has come on top.
bool MapSession::HasTooManyPages() const {
  if (options_.page_bytes == 0) return false;
  const std::int64_t resident_bytes = ResidentBytes(options_);
  const std::int64_t held_bytes = held_page_bytes_.load(std::memory_order_relaxed);
  return resident_bytes > BytesToKeep(options_) && (has_kept_pages_ || held_bytes == 0 || resident_bytes < held_bytes ||
                                                    resident_bytes > held_bytes + options_.page_bytes / 8);
}

/// On the commit thread. Meanwhile nothing of the state could go, which is kept now with all that was read of it.
void MapSession::OnStored(const std::shared_ptr<const MapSnapshot>& state) {
  kept_states_->Keep(state);
  if (options_.page_bytes == 0 || ResidentBytes(options_) <= BytesToKeep(options_)) return;
  if (!kept_states_->HoldBlocks(options_.spill != nullptr)) return;
  has_kept_pages_ = true;
  KeepPagesInBounds();
}

void MapSession::KeepPagesInBounds() {
  if (!HasTooManyPages() || is_asked_for_pages_.exchange(true)) return;
  try {
    Post({.run = [this] { is_asked_for_pages_ = false; },  // after each job the writer looks
          .refuse = [this](const Status&) { is_asked_for_pages_ = false; }});
  } catch (...) {
    is_asked_for_pages_ = false;  // there is no memory for it: the next one asks again
  }
}

/// On the writer, between jobs. First what nobody has asked for since the last time, then, if need be, all. Before what
/// was fused is published nothing can go: so that comes early.
void MapSession::LetGoOfPages() {
  if (!HasTooManyPages()) return;
  if (options_.spill != nullptr && num_unpublished_ > 0) TellSafely([this] { Publish(); });
  if (builder_.map().is_changed()) return;
  has_kept_pages_ = false;  // first: what comes from now on may come too late
  const std::int64_t resident_bytes = ResidentBytes(options_);
  TellSafely([this, resident_bytes] {
    for (const bool even_used : {false, true}) {
      auto before = builder_.map().published();
      auto same = builder_.map().LetGoOfPages(even_used, options_.spill.get());
      if (same != before) commits_.LetGoOfPages(same);
      // At last whatever there is: a commit under way may have added one with all that was read. Where another map's
      // readers hold too much, states that hold nothing of it stay.
      if (same != before || (even_used && kept_states_->HoldBlocks(options_.spill != nullptr)))
        kept_states_->LetGoOfPages(same);
      before.reset();
      auto view = shown_->Newest();
      // Else that state is not to be seen yet.
      if (view->shared_snapshot() != same && view->snapshot().revision() == same->revision()) {
        shown_->Show(std::make_shared<const MapView>(std::move(same), view.get()));
      }
      view.reset();
      if (ResidentBytes(options_) <= BytesToKeep(options_)) break;
    }
    if (ResidentBytes(options_) < resident_bytes) GiveBackFreeMemory();
  });
  const std::int64_t left_bytes = ResidentBytes(options_);
  held_page_bytes_ = left_bytes > BytesToKeep(options_) ? left_bytes : 0;
}

}  // namespace dhpmap
