// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mapping/changes/state_marks.h"
#include "storage/postgres/commit/submap_writes.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/history/change_writes.h"
#include "storage/postgres/history/edit_tile_writes.h"
#include "storage/postgres/history/edit_writes.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/tiles/tile_writes.h"

namespace dhpmap::postgres {

/// The rows that a commit is going to change.
struct PlannedChanges {
  const std::vector<SubmapTileChange>& submaps;
  FreeSpaceChange free_space, vacated;
  bool is_edit = false;
  bool goes_on_with_edit = false;  ///< the commit adds what the last edit has left
  std::uint16_t store = 0;         ///< see StoredKey
};

/// The stored rows that a commit changes. Takes one round trip, or two if an edit has left something.
struct FetchedState {
  MapHead head;
  TileWrites tiles{0};
  SubmapWrites submaps{tiles};
  ChangeWrites changes;
  EditWrites edits;
  std::optional<EditHistoryRow> last_history;  ///< of the newest edit, where goes_on_with_edit asks for it
  std::optional<EditTileWrites> left;          ///< its rows of the map's own tiles

  FetchedState() = default;
  FetchedState(const FetchedState&) = delete;
  FetchedState& operator=(const FetchedState&) = delete;
};

/// NOT_FOUND if the map is gone.
Status Fetch(Connection& connection, const std::string& name, std::int64_t map_key, const PlannedChanges& changes,
             FetchedState& state);

}  // namespace dhpmap::postgres
