// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/paging/tile_blobs.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Where to leave tiles on disk until they are requested.
struct Paging {
  std::shared_ptr<TileBlobs> blobs;
  /// Submaps with rows of unknown block occupancy are read completely; else reading stops there.
  bool reads_the_rest = true;
  bool lacks_cells = false;  ///< result: there was one; see NoteTileCells
};

/// Reads a map within the caller's transaction, decoding on `pool`. Its tiles get storage keys of `store`. Without
/// `paging` (may be null) all are read into memory. NOT_FOUND; DATA_LOSS naming map, submap, layer and tile of damaged
/// or missing data.
Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        std::uint16_t store, ThreadPool& pool,
                                                        Paging* paging = nullptr);

}  // namespace dhpmap
