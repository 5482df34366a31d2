// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "mapping/paging/tile_spill.h"
#include "server/app/session/map_writer.h"
#include "server/app/states/kept_states.h"

namespace dhpmap {

struct PageOptions {
  /// Of voxels in memory, and of what is known of those on the disk, of all maps of the process together: near it they
  /// are left in the store, or in `spill`, and past states go; 0: no bound. Without `spill` those that were read from
  /// the store count alone, and nothing else can go.
  std::int64_t budget_bytes = 0;
  std::shared_ptr<TileSpill> spill = nullptr;  ///< takes what was written since it was read; shared by all maps
};

/// What counts against the budget now.
std::int64_t ResidentBytes(const PageOptions& options);
/// Of the budget, from where on voxels are left on the disk: the rest is for what is read meanwhile.
std::int64_t BytesToKeep(const PageOptions& options);
/// How much of what they have read requests may hold together: see PageReaderLimit.
std::int64_t BytesOfReaders(const PageOptions& options);

/// Leaves voxels of a map on the disk while those in memory take more than the budget. Thread-safe where not said
/// otherwise.
class PageEvictor {
 public:
  /// `kept`: the map's past states.
  PageEvictor(MapWriter writer, PageOptions options, std::shared_ptr<KeptStates> kept)
      : writer_(std::move(writer)), options_(std::move(options)), kept_(std::move(kept)) {}

  /// Has the writer evict pages soon, if there are too many. States that somebody holds keep what they have read.
  void EvictSoon();
  /// Evicts pages now, if there are too many. On the writer thread, between jobs. Does not throw.
  void Evict();
  /// The newest of `kept` has just been stored, and is kept with all that was read of it. On the commit thread.
  void OnKept();

 private:
  [[nodiscard]] bool HasTooManyPages() const;
  void EvictThoseOf(bool even_used);

  const MapWriter writer_;
  const PageOptions options_;
  const std::shared_ptr<KeptStates> kept_;
  std::atomic<bool> is_asked_ = false;        ///< a job that evicts waits
  std::atomic<bool> has_kept_pages_ = false;  ///< a state was kept with pages since the last eviction
  std::atomic<std::int64_t> held_bytes_ = 0;  ///< what was left of them the last time, if that was too much
};

}  // namespace dhpmap
