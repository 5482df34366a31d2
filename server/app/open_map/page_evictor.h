// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "mapping/paging/tile_spill.h"
#include "server/app/open_map/map_writer.h"
#include "server/app/states/snapshot_history.h"

namespace dhpmap {

struct PageOptions {
  /// Budget of voxels in memory and of metadata of evicted ones, over all maps of the process. Near it, voxels are
  /// evicted to the store or to `spill`, and past states are dropped; 0: unlimited. Without `spill`, only voxels that
  /// were read from the store count and can be evicted.
  std::int64_t budget_bytes = 0;
  std::shared_ptr<TileSpill> spill =
      nullptr;  ///< takes voxels that were written since they were read; shared by all maps
};

/// Bytes that count against the budget now.
std::int64_t ResidentBytes(const PageOptions& options);
/// Threshold of eviction within the budget; the rest is for concurrent reads.
std::int64_t BytesToKeep(const PageOptions& options);
/// Limit of the pages that all requests together hold: see PageReaderLimit.
std::int64_t BytesOfReaders(const PageOptions& options);

/// Evicts voxels of a map while memory exceeds the budget. Thread-safe unless noted.
class PageEvictor {
 public:
  /// `kept`: the map's past states.
  PageEvictor(MapWriter writer, PageOptions options, std::shared_ptr<SnapshotHistory> kept)
      : writer_(std::move(writer)), options_(std::move(options)), kept_(std::move(kept)) {}

  /// Asks the writer to evict pages soon, if necessary. Pinned states keep their pages.
  void EvictSoon();
  /// Evicts pages now, if necessary. On the writer thread, between jobs. Does not throw.
  void Evict();
  /// The newest of `kept` was just stored and pins its pages. On the commit thread.
  void OnKept();

 private:
  [[nodiscard]] bool HasTooManyPages() const;
  void EvictThoseOf(bool even_used);

  const MapWriter writer_;
  const PageOptions options_;
  const std::shared_ptr<SnapshotHistory> kept_;
  std::atomic<bool> is_asked_ = false;        ///< an eviction job is queued
  std::atomic<bool> has_kept_pages_ = false;  ///< a state was kept with pages since the last eviction
  std::atomic<std::int64_t> held_bytes_ = 0;  ///< bytes that the last eviction could not free, if still over the budget
};

}  // namespace dhpmap
