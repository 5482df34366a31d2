// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/changes/state_marks.h"
#include "storage/commit/state_tables.h"

namespace dhpmap {

/// Storage keys of tiles written by a transaction that may not have committed yet.
class WrittenTiles {
 public:
  using Keys = std::array<std::int64_t, kNumBlockLayers>;  ///< 0: not written

  void Note(const BlockTile& tile, BlockLayer layer, std::int64_t key) {
    keys_[&tile][static_cast<std::size_t>(layer)] = key;
  }
  void NoteNewBlob() { ++num_new_blobs_; }
  /// Number of newly written blobs.
  [[nodiscard]] std::int64_t num_new_blobs() const { return num_new_blobs_; }
  /// 0 if it was not written.
  [[nodiscard]] std::int64_t Find(const BlockTile& tile, BlockLayer layer) const {
    const auto found = keys_.find(&tile);
    return found != keys_.end() ? found->second[static_cast<std::size_t>(layer)] : 0;
  }
  /// Sets the keys in the tiles. Only after the commit: a key that was rolled back may be reused.
  void TellTiles(std::uint16_t store) const;

 private:
  std::unordered_map<const BlockTile*, Keys> keys_;
  std::int64_t num_new_blobs_ = 0;
};

/// Writes the submaps, tiles and blobs of `changes` to the tables of a store, encoding on `pool`. Refers to
/// blobs whose keys in `store` the tiles already have. On error the caller rolls back. `recorder` (may be null) records
/// the blobs before and after. FAILED_PRECONDITION if the stored tiles are not those that the changes start from.
Result<WrittenTiles> WriteChanges(SubmapTable& submaps, TileTable& tiles, std::int64_t map_key,
                                  const std::vector<SubmapTileChange>& changes, std::uint16_t store, ThreadPool& pool,
                                  EditTiles* recorder = nullptr);

}  // namespace dhpmap
