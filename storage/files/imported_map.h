// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/map.h"
#include "storage/rows/submap_rows.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Checksums tell what has changed by accident, not who wrote a file: whoever forges one computes them. So a map that
// comes in as a file is also asked whether the server could have made it. All errors are INVALID_ARGUMENT, BAD_MAP.

/// How many rows a file may have of each kind: they are read whole, so their number is looked at before. Far beyond
/// what maps have, where the model itself sets no limit: so many tiles are hundreds of millions of blocks.
struct RowBounds {
  std::int64_t num_maps = 1'000;  ///< so that it can be said how many there are
  std::int64_t num_submaps = 1'000'000;
  std::int64_t num_classes = 65'535;  ///< all ids but the reserved one
  std::int64_t num_config_keys = 10'000;
  std::int64_t num_sessions = SessionMarks::kMost;
  std::int64_t num_kept_clear = KeptClear::kMost;
  std::int64_t num_merged_ids = 1'000'000;
  std::int64_t num_pairs = 1'000'000;
  std::int64_t num_tiles = 20'000'000;  ///< likewise of blobs, and of older files' blocks
};

/// Of a file of any schema. Counts no farther than up to the bounds.
Status CheckRowCounts(sqlite::Database& file, const RowBounds& bounds = {});

/// Whether all voxels of all tiles have numbers of 32 bits. Of a file of the present schema.
Status CheckTileIndices(sqlite::Database& file);

/// What is beyond the rules that maps and submaps are made by, and that reading them does not refuse; names the first
/// such field. `submaps`: as they were read, all of them.
Status ValidateImported(const MapInfo& map, const std::vector<SubmapRow>& submaps);

}  // namespace dhpmap
