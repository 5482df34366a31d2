// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "storage/check/verify_history.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// A row of tiles with an unreadable blob.
struct BadTile {
  std::int64_t owner_key = 0;
  TileIndex index;
  std::int64_t layer = 0;
};

/// Result of VerifyRows, and the data to drop so that the rest can be read.
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

/// Verifies a map within the caller's transaction, tile by tile: little memory, and as long as loading it and its undo
/// data. NOT_FOUND, CANCELLED; FAILED_PRECONDITION, reason NEWER_LAYER, NEWER_CONFIG or RETIRED_CONFIG, for a map of
/// another version.
Result<Verification> VerifyRows(sqlite::Database& database, const std::string& name, VerifyScope scope,
                                const std::stop_token& stop);

/// Within the caller's transaction: drops unreadable data of a map that was not written since, and updates rows to the
/// rest, as a new revision; watchers list it again. Readable edits stay in the log, and their undo data unless the
/// state is wrong. Data that belong to no map are deleted. DATA_LOSS if the map's own row is damaged.
Status RepairRows(sqlite::Database& database, const std::string& name, Verification& found);

}  // namespace dhpmap
