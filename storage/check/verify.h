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

/// A row of tiles whose blob cannot be read.
struct BadTile {
  std::int64_t owner_key = 0;
  TileIndex index;
  std::int64_t layer = 0;
};

/// What VerifyRows found, and what to leave out so that the rest can be read.
struct Verification {
  VerifyReport report;
  bool is_map_row_bad = false;              ///< nothing can be trusted
  std::vector<std::int64_t> bad_submaps;    ///< keys of submaps whose rows cannot be read
  std::vector<std::int64_t> wrong_submaps;  ///< keys of those whose rows do not say what their tiles are
  std::vector<BadTile> bad_tiles;
  bool is_number_wrong = false;      ///< that of its submaps
  bool are_own_tiles_wrong = false;  ///< those of the map itself
  bool are_references_wrong = false;
  BadHistory history;

  /// Whether the map is another than what was stored, and not just its histories or what is counted of blobs.
  [[nodiscard]] bool IsStateWrong() const {
    return is_number_wrong || are_own_tiles_wrong ||
           !(bad_submaps.empty() && wrong_submaps.empty() && bad_tiles.empty());
  }
};

enum class VerifyScope {
  kAll,
  kState,  ///< not what commits changed, the edits, and what undoes them
};

/// Looks through a map within the caller's transaction, tile by tile: needs little memory, and as long as loading it
/// and what undoes its edits.
/// NOT_FOUND, CANCELLED; FAILED_PRECONDITION, reason NEWER_LAYER or NEWER_CONFIG, for a map of a later version.
Result<Verification> VerifyRows(sqlite::Database& database, const std::string& name, VerifyScope scope,
                                const std::stop_token& stop);

/// Within the caller's transaction: drops what cannot be read, of a map that was not written since, and has rows say
/// what is left, as a new revision: who follows it lists it again. Edits that can be read stay in their log; what
/// undoes them, too, unless the state is wrong. What belongs to no map, whoever's it was, goes. DATA_LOSS if the map's
/// own row is damaged: then there is nothing to go by.
Status RepairRows(sqlite::Database& database, const std::string& name, Verification& found);

}  // namespace dhpmap
