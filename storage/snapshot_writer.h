// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/changes/state_marks.h"
#include "storage/history/edit_history.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Under which keys tiles in memory were stored by a transaction that may not have committed yet.
class WrittenTiles {
 public:
  using Keys = std::array<std::int64_t, kNumBlockLayers>;  ///< 0: that layer was not looked at

  void Note(const BlockTile& tile, BlockLayer layer, std::int64_t key) {
    keys_[&tile][static_cast<std::size_t>(layer)] = key;
  }
  void NoteNewBlob() { ++num_new_blobs_; }
  /// Blobs that were not there before.
  [[nodiscard]] std::int64_t num_new_blobs() const { return num_new_blobs_; }
  /// 0 if it was not written.
  [[nodiscard]] std::int64_t Find(const BlockTile& tile, BlockLayer layer) const {
    const auto found = keys_.find(&tile);
    return found != keys_.end() ? found->second[static_cast<std::size_t>(layer)] : 0;
  }
  /// Lets the tiles know, once it is certain: a key that was rolled back may be given out again.
  void TellTiles(std::uint16_t store) const;

 private:
  std::unordered_map<const BlockTile*, Keys> keys_;
  std::int64_t num_new_blobs_ = 0;
};

/// Writes the submaps, tiles and blobs that `changes` name, within the caller's transaction; encodes on `pool`. What
/// the tiles in memory know to be in `store` already is referred to instead. On error the caller rolls back.
/// `recorder` (may be null) is told which blobs they were and are.
/// FAILED_PRECONDITION if the stored tiles are not those that the changes started from.
Result<WrittenTiles> WriteChanges(sqlite::Database& database, std::int64_t map_key,
                                  const std::vector<SubmapTileChange>& changes, std::uint16_t store, ThreadPool& pool,
                                  EditTileRecorder* recorder = nullptr);

}  // namespace dhpmap
