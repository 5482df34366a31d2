// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "storage/commit/state_tables.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/tiles/commit_places.h"
#include "storage/postgres/tiles/tile_writes.h"
#include "storage/postgres/values.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {

/// The submap rows during a commit: those fetched and those to write.
class SubmapWrites final : public SubmapTable {
 public:
  /// `tiles` outlives it.
  explicit SubmapWrites(TileWrites& tiles) : tiles_(tiles) {}

  void Fetched(Answer& submaps);
  Result<std::optional<Stored>> Find(std::int64_t map_key, SubmapId id) override;
  Result<std::int64_t> Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                             std::int64_t tiles_sum) override;
  Status Erase(std::int64_t submap_key) override;

  void Write(std::int64_t map_key, std::vector<Call>& calls) const;
  /// As TileWrites::AddTo.
  void AddTo(CommitPlaces& places) const;

 private:
  TileWrites& tiles_;
  std::map<std::int64_t, SubmapRow> stored_, written_;
  std::vector<std::int64_t> erased_;
};

}  // namespace dhpmap::postgres
