// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "storage/postgres/answer.h"
#include "storage/postgres/values.h"
#include "storage/rows/map_row.h"

namespace dhpmap::postgres {

/// A row of table maps: what every store keeps of a map, and what commits from several servers are ordered by.
struct MapHead {
  MapRow row;
  std::int64_t commit_id = 0;    ///< counts commits of any kind
  std::int64_t owner = 0;        ///< the server that writes the map
  std::int64_t owner_epoch = 0;  ///< counts owners
  std::int64_t next_blob_key = 1;
  std::int64_t seen_ns = 0;  ///< time during which servers had the map open, as SeenClock
};

/// SELECTs of heads by map_key ($1), by name ($1), and by name after $1, $2 at most.
const std::string& HeadByKey();
const std::string& HeadByName();
const std::string& HeadsAfter();
/// The present row; false if a column has a wrong type.
bool ReadHead(Answer& answer, MapHead& head);

/// Adds the row.
Call InsertHead(const MapHead& head);
/// Writes `after` in place of `before`, if that is still there under its epoch and commit. Else an error (22012, see
/// IsFenced), so that nothing after it runs.
Call ReplaceHead(const MapHead& before, const MapHead& after);
bool IsFenced(const std::string& sqlstate);

}  // namespace dhpmap::postgres
