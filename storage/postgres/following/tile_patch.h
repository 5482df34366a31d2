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
#include "storage/postgres/commit/commit_places.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {

/// Changed tiles of a submap, to be put in place of those that it had. Thread-compatible.
class TilePatch {
 public:
  /// Tiles get storage keys of `store`. What is in `places` and not added is erased.
  TilePatch(const CommitPlaces::Owner& places, std::uint16_t store);

  /// A row of those places. DATA_LOSS for another one or without a blob; FAILED_PRECONDITION for a layer of a later
  /// version.
  Status Add(const TileRow& row);

  /// The submap of `row`: `before` with these tiles, the others shared. DATA_LOSS if these are not the tiles that `row`
  /// tells of.
  Result<std::shared_ptr<const Submap>> Apply(const Submap& before, const SubmapRow& row, ThreadPool& pool);

 private:
  struct Changed {
    BlockLayers differs{};
    std::array<std::int64_t, kNumBlockLayers> keys{};  ///< 0: there is no row any more
    std::array<Bytes, kNumBlockLayers> blobs;
    std::shared_ptr<BlockTile> tile;
    Status status;
  };
  void Decode(TileIndex index, Changed& changed) const;
  [[nodiscard]] Status Check(const Submap& submap, const SubmapRow& row) const;

  const std::uint16_t store_;
  std::map<std::array<std::int32_t, 3>, Changed> tiles_;
};

/// The same of a layer of the map itself: free or vacated space.
class LayerPatch {
 public:
  /// `before` outlives it.
  LayerPatch(const FreeSpace& before, const CommitPlaces::Owner& places, BlobKind kind);

  [[nodiscard]] bool IsOf(const TileRow& row) const;
  Status Add(const TileRow& row);
  /// `before` itself where nothing has changed.
  [[nodiscard]] std::shared_ptr<const FreeSpace> Finish(const std::shared_ptr<const FreeSpace>& before) const;

 private:
  const BlobKind kind_;
  std::shared_ptr<FreeSpace> after_;  ///< null: nothing changes
};

}  // namespace dhpmap::postgres
