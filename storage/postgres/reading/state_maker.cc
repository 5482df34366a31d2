// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/state_maker.h"

#include <limits>
#include <string>
#include <utility>

#include "storage/paging/map_layers.h"
#include "storage/postgres/reading/paged_submap.h"
#include "storage/postgres/reading/tile_answer.h"
#include "storage/postgres/tiles/tile_owner.h"
#include "storage/submap_maker.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadTilesTask[] = "read the map";

/// Makes a map from its rows, which come by owner: those of the map itself first.
class StateMaker {
 public:
  StateMaker(const std::vector<SubmapRow>& rows, std::uint16_t store, ThreadPool& pool)
      : rows_(rows), maker_(store, pool) {}

  Status Add(Answer& answer) {
    const std::int64_t owner = answer.Int();
    if (owner == kMapsOwner) return layers_.Add(TileOf(answer));
    DHPMAP_RETURN_IF_ERROR(GoTo(owner));
    const bool has_row = next_ < rows_.size() && std::int64_t{rows_[next_].info.id.value} == owner;
    return has_row ? maker_.Add(TileOf(answer)) : DataLoss("has tiles of submap " + std::to_string(owner) + " alone");
  }
  Status Finish() {
    DHPMAP_RETURN_IF_ERROR(GoTo(std::numeric_limits<std::int64_t>::max()));
    return Status::Ok();
  }
  Result<MapLayers> Layers(const MapRow& map) { return layers_.Finish(map); }
  std::vector<std::shared_ptr<const Submap>>& submaps() { return submaps_; }

 private:
  /// Finishes the submaps before that one.
  Status GoTo(std::int64_t owner) {
    if (!has_begun_ && next_ < rows_.size()) maker_.Begin(rows_[next_]);
    has_begun_ = true;
    while (next_ < rows_.size() && std::int64_t{rows_[next_].info.id.value} < owner) {
      DHPMAP_ASSIGN_OR_RETURN(auto submap, maker_.Finish());
      submaps_.push_back(std::move(submap));
      if (++next_ < rows_.size()) maker_.Begin(rows_[next_]);
    }
    return Status::Ok();
  }

  const std::vector<SubmapRow>& rows_;
  SubmapMaker maker_;
  MapLayersMaker layers_;
  std::size_t next_ = 0;
  bool has_begun_ = false;
  std::vector<std::shared_ptr<const Submap>> submaps_;
};

std::shared_ptr<const MapSnapshot> StateOf(MapRow& map, std::vector<std::shared_ptr<const Submap>> submaps,
                                           MapLayers layers) {
  return std::make_shared<const MapSnapshot>(std::move(map.info), std::move(submaps), std::move(layers.free_space),
                                             VacatedSpace{std::move(layers.vacated), map.leaving()});
}

}  // namespace

Result<std::shared_ptr<const MapSnapshot>> MakeState(Connection& connection, MapRow& map,
                                                     const std::vector<SubmapRow>& rows, std::uint16_t store,
                                                     ThreadPool& pool) {
  StateMaker maker(rows, store, pool);
  Call call{&AllTilesText()};
  call.values.Add(map.key);
  DHPMAP_RETURN_IF_ERROR(
      connection.Stream(call, kReadTilesTask, [&maker](Answer& row) -> Status { return maker.Add(row); }));
  DHPMAP_RETURN_IF_ERROR(maker.Finish());
  DHPMAP_ASSIGN_OR_RETURN(MapLayers layers, maker.Layers(map));
  return StateOf(map, std::move(maker.submaps()), std::move(layers));
}

Result<std::shared_ptr<const MapSnapshot>> MakePagedState(Connection& connection, MapRow& map,
                                                          const std::vector<SubmapRow>& rows, std::uint16_t store,
                                                          ThreadPool& pool, const std::shared_ptr<PageReader>& pages) {
  MapLayersMaker layers_maker;
  Call call{&TilesOfOwnerText()};
  call.values.Add(map.key).Add(kMapsOwner);
  DHPMAP_RETURN_IF_ERROR(connection.Stream(call, kReadTilesTask, [&layers_maker](Answer& row) -> Status {
    (void)row.Int();  // the owner
    return layers_maker.Add(TileOf(row));
  }));
  DHPMAP_ASSIGN_OR_RETURN(MapLayers layers, layers_maker.Finish(map));
  const PagedMap paged{pages, map.key, map.info.revision};
  const auto shared = std::make_shared<SharedTiles>();
  SubmapMaker without_tiles(store, pool);
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(rows.size());
  for (const SubmapRow& row : rows) {
    std::shared_ptr<const Submap>& submap = submaps.emplace_back();
    if (HasTiles(row)) {
      auto unread = std::make_shared<PagedSubmap>(paged, store, shared, map.info.name, row);
      DHPMAP_ASSIGN_OR_RETURN(submap, UnreadSubmap(row, std::move(unread)));
    } else {
      without_tiles.Begin(row);
      DHPMAP_ASSIGN_OR_RETURN(submap, without_tiles.Finish());
    }
  }
  return StateOf(map, std::move(submaps), std::move(layers));
}

}  // namespace dhpmap::postgres
