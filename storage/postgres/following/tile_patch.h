// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>

#include "mapping/base/thread_pool.h"
#include "mapping/free/free_space.h"
#include "mapping/submap/submap.h"
#include "storage/codec/envelope.h"
#include "storage/commit/tile_totals.h"
#include "storage/postgres/tiles/commit_places.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {

/// The changed tiles of a submap. Thread-compatible.
class TilePatch {
 public:
  /// Tiles get storage keys of `store`. A tile in `places` that is not added is erased.
  TilePatch(const CommitPlaces::Owner& places, std::uint16_t store);

  /// Adds a row at one of the places. DATA_LOSS for another place or a missing blob; FAILED_PRECONDITION for a layer of
  /// a later version.
  Status Add(const TileRow& row);

  /// The submap of `row`: these tiles, and the other tiles of `before`, shared. DATA_LOSS if the result does not match
  /// `row`.
  Result<std::shared_ptr<const Submap>> Apply(const Submap& before, const SubmapRow& row, ThreadPool& pool);

 private:
  struct Changed {
    BlockLayers differs{};
    std::array<std::int64_t, kNumBlockLayers> keys{};  ///< 0: the row is gone
    std::array<Bytes, kNumBlockLayers> blobs;
    std::shared_ptr<BlockTile> tile;
    Status status;
  };
  void Decode(TileIndex index, Changed& changed) const;
  [[nodiscard]] Status Check(const Submap& submap, const SubmapRow& row) const;

  const std::uint16_t store_;
  std::map<std::array<std::int32_t, 3>, Changed> tiles_;
};

/// The same for a layer of the map itself: free or vacated space.
class LayerPatch {
 public:
  /// `before` outlives it.
  LayerPatch(const FreeSpace& before, const CommitPlaces::Owner& places, BlobKind kind);

  [[nodiscard]] bool IsOf(const TileRow& row) const;
  Status Add(const TileRow& row);
  /// Returns `before` itself if nothing has changed.
  [[nodiscard]] std::shared_ptr<const FreeSpace> Finish(const std::shared_ptr<const FreeSpace>& before) const;

 private:
  const BlobKind kind_;
  std::shared_ptr<FreeSpace> after_;  ///< null: nothing changes
};

}  // namespace dhpmap::postgres
