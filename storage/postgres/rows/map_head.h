// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "storage/postgres/answer.h"
#include "storage/postgres/values.h"
#include "storage/rows/map_row.h"

namespace dhpmap::postgres {

/// A row of table `maps`: what every store keeps of a map, and the columns that order commits of several servers.
struct MapHead {
  MapRow row;
  std::int64_t commit_id = 0;    ///< counts commits of any kind
  std::int64_t owner = 0;        ///< the server that writes the map
  std::int64_t owner_epoch = 0;  ///< counts owners
  std::int64_t next_blob_key = 1;
  std::int64_t seen_ns = 0;  ///< time during which servers had the map open, see SeenClock
};

/// Select heads: by map_key ($1); by name ($1); at most $2 by name, after $1.
const std::string& HeadByKey();
const std::string& HeadByName();
const std::string& HeadsAfter();
/// Reads the present row of the answer; false if a column has a wrong type.
bool ReadHead(Answer& answer, MapHead& head);

/// Adds the row.
Call InsertHead(const MapHead& head);
/// Replaces `before` by `after` if the row still has the epoch and commit of `before`. Else it fails (22012, see
/// IsFenced), and no later statement of the pipeline runs.
Call ReplaceHead(const MapHead& before, const MapHead& after);
bool IsFenced(const std::string& sqlstate);

}  // namespace dhpmap::postgres
