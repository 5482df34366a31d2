// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/commit/tile_totals.h"
#include "storage/rows/submap_rows.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {

/// Makes the submaps of a map of their rows, for every store: Begin, Add each row of its tiles by ascending tile,
/// Finish; then the next. Clones share their tiles in memory. Thread-compatible; decodes on `pool`.
class SubmapMaker {
 public:
  /// Tiles get storage keys of `store`.
  SubmapMaker(std::uint16_t store, ThreadPool& pool) : store_(store), pool_(pool) {}

  void Begin(const SubmapRow& row);
  /// DATA_LOSS naming submap, layer and tile of damaged or missing data; FAILED_PRECONDITION for a layer of a later
  /// version.
  Status Add(const TileRow& row);
  /// DATA_LOSS if these were not all tiles, or others.
  Result<std::shared_ptr<const Submap>> Finish();

 private:
  using Keys = std::array<std::int64_t, kNumBlockLayers>;
  /// The blobs of one tile, and what they decode to.
  struct DecodeJob {
    TileIndex index;
    Keys keys{};
    std::array<Bytes, kNumBlockLayers> blobs;
    bool is_shared = false;  ///< another submap may have the very same tile
    std::shared_ptr<const BlockTile> tile;
    const ObjectLayer* failed = nullptr;
    Status status;
  };
  void Decode(DecodeJob& job) const;
  Status DecodeBatch();

  const std::uint16_t store_;
  ThreadPool& pool_;
  SubmapRow row_;
  TileTotals totals_;
  std::shared_ptr<Submap> submap_;
  std::vector<DecodeJob> jobs_;
  std::map<Keys, std::shared_ptr<const BlockTile>> shared_;
};

/// The error for a map whose state cannot be made: with its name and a reason.
Status DamagedState(const std::string& name, const Status& status);

}  // namespace dhpmap
