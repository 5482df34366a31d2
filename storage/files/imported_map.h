// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/map.h"
#include "storage/rows/submap_rows.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Checks that an imported file is one that the server could have written. Checksums detect accidents, not forgery. All
// errors are INVALID_ARGUMENT, BAD_MAP.

/// Limits of rows by kind, checked before the rows are read into memory. Where the model has no limit, they are far
/// beyond real maps: so many tiles are hundreds of millions of blocks.
struct RowBounds {
  std::int64_t num_maps = 1'000;  ///< enough to report the number of maps
  std::int64_t num_submaps = 1'000'000;
  std::int64_t num_classes = 65'535;  ///< all ids but the reserved one
  std::int64_t num_config_keys = 10'000;
  std::int64_t num_sessions = SessionMarks::kMost;
  std::int64_t num_kept_clear = KeptClear::kMost;
  std::int64_t num_merged_ids = 1'000'000;
  std::int64_t num_pairs = 1'000'000;
  std::int64_t num_tiles = 20'000'000;  ///< likewise for blobs, and for blocks of older files
};

/// For a file of any schema. Counts only up to the limits.
Status CheckRowCounts(sqlite::Database& file, const RowBounds& bounds = {});

/// Whether all voxel indices fit into 32 bits. For a file of the present schema.
Status CheckTileIndices(sqlite::Database& file);

/// Finds values that violate the rules of maps and submaps but that reading accepts; names the first such field.
/// `submaps`: all, as read.
Status ValidateImported(const MapInfo& map, const std::vector<SubmapRow>& submaps);

}  // namespace dhpmap
