// SPDX-License-Identifier: BSD-3-Clause
// StatePatch: reads the rows written since the earlier state.
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "storage/postgres/following/state_patch.h"
#include "storage/postgres/rows/selects.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/postgres/tiles/tile_owner.h"
#include "storage/submap_maker.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadRowsTask[] = "read what was committed";
// A scalar subquery: the planner must look each key up by the index, however many it expects.
const std::string kTileColumns =
    "t.owner_id, t.x, t.y, t.z, t.layer, t.blob_key, (SELECT b.blob FROM tile_blobs b WHERE b.map_key = t.map_key AND "
    "b.blob_key = t.blob_key)";
const std::string kTilesAt =
    "SELECT " + kTileColumns +
    " FROM unnest($2, $3, $4, $5, $6) AS w (owner_id, x, y, z, layer) CROSS JOIN LATERAL (SELECT * FROM tiles s WHERE "
    "s.map_key = $1 AND s.owner_id = w.owner_id AND s.x = w.x AND s.y = w.y AND s.z = w.z AND s.layer = w.layer "
    "OFFSET 0) t";
const std::string kTilesOf = "SELECT " + kTileColumns +
                             " FROM tiles t WHERE t.map_key = $1 AND t.owner_id = ANY ($2) ORDER BY t.owner_id, t.x, "
                             "t.y, t.z, t.layer";

TileRow ChangedTileOf(Answer& answer) {
  TileRow row;
  for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) *axis = static_cast<std::int32_t>(answer.Int());
  row.layer = answer.Int();
  row.blob_key = answer.Int();
  row.blob = answer.Blob();
  row.is_missing = row.blob.empty();
  return row;
}

}  // namespace

/// The present rows of written submaps.
Status StatePatch::ReadRows(Connection& connection) {
  std::vector<std::int64_t> ids;
  for (const auto& [owner, places] : places_.owners()) {
    if (owner != kMapsOwner) ids.push_back(owner);
  }
  Call call{&SubmapsById()};
  call.values.Add(map_.key).Add(std::span<const std::int64_t>(ids));
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadRowsTask));
  while (answer.Next()) {
    SubmapRow row;
    if (!ReadRow(Submaps(), answer, row) || !Submaps().IsIntact(row, row.seal)) {
      return DataLoss("a submap's row has a wrong checksum");
    }
    const std::int64_t id{row.info.id.value};
    if (places_.owners().at(id).is_emptied || before_.snapshot->Find(row.info.id) == nullptr) whole_.insert(id);
    else patches_.emplace(id, TilePatch(places_.owners().at(id), before_.store));
    rows_.emplace(id, std::move(row));
  }
  return Status::Ok();
}

Status StatePatch::ReadChangedTiles(Connection& connection) {
  static const CommitPlaces::Owner kNothing;
  const auto maps_own = places_.owners().find(kMapsOwner);
  const CommitPlaces::Owner& layers = maps_own == places_.owners().end() ? kNothing : maps_own->second;
  free_.emplace(*before_.snapshot->free_space(), layers, BlobKind::kFreeV1);
  vacated_.emplace(*before_.snapshot->noted_vacated(), layers, BlobKind::kVacatedV1);
  Call call{&kTilesAt};
  if (!AddPlaces(call.values)) return Status::Ok();
  return connection.Stream(call, kReadRowsTask, [this](Answer& answer) -> Status {
    const std::int64_t owner = answer.Int();
    const TileRow row = ChangedTileOf(answer);
    if (owner != kMapsOwner) return patches_.at(owner).Add(row);
    if (free_->IsOf(row)) return free_->Add(row);
    return vacated_->IsOf(row) ? vacated_->Add(row) : FailedPrecondition("a tile is of a later version's layer");
  });
}

/// False: there are none.
bool StatePatch::AddPlaces(Values& values) const {
  std::array<std::vector<std::int64_t>, 5> columns;
  for (const auto& [owner, places] : places_.owners()) {
    if (owner != kMapsOwner && !patches_.contains(owner)) continue;
    for (const auto& [index, layers] : places.tiles) {
      for (std::int64_t layer = 0; layer < static_cast<std::int64_t>(kNumLayerNumbers); ++layer) {
        if ((layers >> layer & 1u) == 0) continue;
        columns[0].push_back(owner);
        for (std::size_t axis = 0; axis < 3; ++axis) columns[1 + axis].push_back(index[axis]);
        columns[4].push_back(layer);
      }
    }
  }
  values.Add(map_.key);
  for (const auto& column : columns) values.Add(std::span<const std::int64_t>(column));
  return !columns[0].empty();
}

/// Reads new submaps, and those that were erased meanwhile, as loading does.
Status StatePatch::ReadWhole(Connection& connection) {
  if (whole_.empty()) return Status::Ok();
  SubmapMaker maker(before_.store, pool_);
  auto next = whole_.begin();
  maker.Begin(rows_.at(*next));
  const auto go_to = [&](std::int64_t owner) -> Status {
    while (next != whole_.end() && *next < owner) {
      DHPMAP_ASSIGN_OR_RETURN(submaps_[*next], maker.Finish());
      if (++next != whole_.end()) maker.Begin(rows_.at(*next));
    }
    return Status::Ok();
  };
  const std::vector<std::int64_t> owners(whole_.begin(), whole_.end());
  Call call{&kTilesOf};
  call.values.Add(map_.key).Add(std::span<const std::int64_t>(owners));
  const Status read = connection.Stream(call, kReadRowsTask, [&](Answer& answer) -> Status {
    const Status gone_to = go_to(answer.Int());
    return gone_to.ok() ? maker.Add(ChangedTileOf(answer)) : gone_to;
  });
  DHPMAP_RETURN_IF_ERROR(read);
  return go_to(std::numeric_limits<std::int64_t>::max());
}

}  // namespace dhpmap::postgres
