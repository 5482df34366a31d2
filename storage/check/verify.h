// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "storage/check/verified_rows.h"
#include "storage/check/verify_history.h"
#include "storage/store.h"

namespace dhpmap {

/// A row of tiles with an unreadable blob.
struct BadTile {
  std::int64_t owner_key = 0;
  TileIndex index;
  std::int64_t layer = 0;
};

/// Result of Verify, and the data to drop so that the rest can be read.
struct Verification {
  VerifyReport report;
  bool is_map_row_bad = false;              ///< no data can be trusted
  std::vector<std::int64_t> bad_submaps;    ///< keys of submaps with unreadable rows
  std::vector<std::int64_t> wrong_submaps;  ///< keys of submaps with wrong counts or sums of tiles
  std::vector<BadTile> bad_tiles;
  bool is_number_wrong = false;      ///< wrong number of submaps
  bool are_own_tiles_wrong = false;  ///< wrong count or sum of the map's own tiles
  bool are_references_wrong = false;
  BadHistory history;

  /// Whether the map itself differs from the stored state, not merely its histories or reference counts.
  [[nodiscard]] bool IsStateWrong() const {
    return is_number_wrong || are_own_tiles_wrong ||
           !(bad_submaps.empty() && wrong_submaps.empty() && bad_tiles.empty());
  }
};

enum class VerifyScope {
  kAll,
  kState,  ///< without changes, edits and undo data
};

/// Verifies a map tile by tile: little memory, and as long as loading it and its undo data. NOT_FOUND, CANCELLED;
/// FAILED_PRECONDITION, reason NEWER_LAYER, NEWER_CONFIG or RETIRED_CONFIG, for a map of another version.
Result<Verification> Verify(VerifiedRows& rows, VerifyScope scope, const std::stop_token& stop);

}  // namespace dhpmap
