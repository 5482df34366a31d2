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

/// How tiles are left on the disk until somebody reads them.
struct Paging {
  std::shared_ptr<TileBlobs> blobs;
  /// Submaps of which some row does not say which blocks it has are read as a whole; else reading ends there.
  bool reads_the_rest = true;
  bool lacks_cells = false;  ///< outcome: there was one; see NoteTileCells
};

/// Reads a map within the caller's transaction; decodes on `pool`. Its tiles know that they are in `store`. Without
/// `paging` (may be null) all of them are in memory. NOT_FOUND; DATA_LOSS naming map, submap, layer and tile where
/// something is damaged or missing.
Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        std::uint16_t store, ThreadPool& pool,
                                                        Paging* paging = nullptr);

}  // namespace dhpmap
