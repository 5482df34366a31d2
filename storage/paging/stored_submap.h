// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "storage/paging/submap_tiles.h"
#include "storage/paging/tile_blobs.h"

namespace dhpmap {

/// A submap with its tiles in an SQLite file: lists the tiles and reads their blocks. Thread-safe.
class StoredSubmap final : public SubmapTiles {
 public:
  /// See SubmapTiles.
  StoredSubmap(std::shared_ptr<TileBlobs> blobs, std::uint16_t store, std::shared_ptr<SharedTiles> shared,
               const std::string& map, const SubmapRow& row);

  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override { return blobs_->Read(name(), owner_, tile); }
  /// Also DATA_LOSS if the tiles are not those of the row; FAILED_PRECONDITION, reason NEWER_LAYER.
  Result<std::vector<Tile>> ReadAll() override;
  Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex index) override;

 private:
  /// Why the tiles are others than those of the row that was loaded.
  [[nodiscard]] Status WhyOthers(sqlite::Database& database) const;

  const std::shared_ptr<TileBlobs> blobs_;
  const TileOwner owner_;
};

}  // namespace dhpmap
