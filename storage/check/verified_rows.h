// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "storage/check/verified_history.h"
#include "storage/commit/tile_totals.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap {

/// What a verification reads of one map, all of one state: each store reads it by statements of its own. Errors are
/// those of the store, and of visitors.
class VerifiedRows {
 public:
  using VisitTile = std::function<Status(const TileRow& row)>;
  using VisitStray = std::function<Status(std::string what)>;

  virtual ~VerifiedRows() = default;
  /// NOT_FOUND; DATA_LOSS if it is damaged; FAILED_PRECONDITION for a config of another version.
  virtual Result<MapRow> ReadMapRow() = 0;
  // Of that map, once it is read:

  /// By ascending id; damaged ones are added to `damaged`. Their keys are owners of tiles.
  virtual Result<std::vector<SubmapRow>> ReadSubmapRows(std::vector<SubmapRow>& damaged) = 0;
  [[nodiscard]] virtual std::int64_t OwnerOfMapTiles() const = 0;
  /// By tile, then layer. Blobs are valid during the visit.
  virtual Status ForEachTile(std::int64_t owner_key, const VisitTile& visit) = 0;
  /// What is wrong with an index of bounds that the store has beside the rows; empty: nothing, or there is none.
  virtual Result<std::string> ProblemOfBounds(const SubmapRow& /*submap*/) { return std::string(); }
  /// What belongs to nothing, and wrong counts of what refers to blobs.
  virtual Status ForEachStray(const VisitStray& visit) = 0;
  virtual VerifiedHistory& History() = 0;
};

}  // namespace dhpmap
