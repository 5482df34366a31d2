// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "mapping/base/thread_pool.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/following/tile_patch.h"
#include "storage/postgres/tiles/commit_places.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// Makes a later state from an earlier one and the rows written since. Thread-compatible.
class StatePatch {
 public:
  /// `map`: the present row, filled. All outlive it.
  StatePatch(const StateToRead& before, MapRow& map, const CommitPlaces& places, ThreadPool& pool)
      : before_(before), map_(map), places_(places), pool_(pool) {}

  /// Reads the present rows at the places, in the connection's transaction. DATA_LOSS; FAILED_PRECONDITION for a layer
  /// of a later version.
  Status Read(Connection& connection);
  /// Takes the row's info. DATA_LOSS if the result is not the stored state.
  Result<std::shared_ptr<const MapSnapshot>> Make();

 private:
  Status ReadRows(Connection& connection);
  Status ReadChangedTiles(Connection& connection);
  bool AddPlaces(Values& values) const;
  Status ReadWhole(Connection& connection);

  const StateToRead& before_;
  MapRow& map_;
  const CommitPlaces& places_;
  ThreadPool& pool_;
  std::map<std::int64_t, SubmapRow> rows_;     ///< all written submaps that exist now
  std::map<std::int64_t, TilePatch> patches_;  ///< of those that existed before
  std::set<std::int64_t> whole_;               ///< the others
  std::optional<LayerPatch> free_, vacated_;
  std::map<std::int64_t, std::shared_ptr<const Submap>> submaps_;  ///< in the end, all
};

}  // namespace dhpmap::postgres
