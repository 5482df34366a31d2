// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/many_tiles.h"

#include <algorithm>
#include <utility>

#include "mapping/map/history_id.h"
#include "mapping/map/map.h"

namespace dhpmap::bench {
namespace {

constexpr std::int64_t kTilesACommit = 20'000;
constexpr std::int64_t kTilesARow = 512;
constexpr double kVoxel_m = 0.05, kTruncation_m = 0.2;

/// A piece of a plane: eight voxels on either side of it.
void FillBlock(TsdfBlock& block, std::int64_t tile) {
  for (int i = 0; i < 16; ++i) {
    const int voxel = 8 * i + static_cast<int>(tile % 8);
    block.distance_m[voxel] = static_cast<float>((i % 2 == 0 ? 0.01 : -0.01) * (1 + static_cast<double>(tile % 5)));
    block.weight[voxel] = static_cast<float>(1 + tile % 20);
    block.color[voxel] = {static_cast<std::uint8_t>(tile), static_cast<std::uint8_t>(tile >> 8), 90};
  }
}

Status BeginManyTiles(MapStore& store) {
  MapInfo info;
  info.name = kManyTilesName;
  info.history_id = DrawHistoryId();
  info.config.voxel_size_m = kVoxel_m;
  info.config.truncation_m = kTruncation_m;
  DHPMAP_ASSIGN_OR_RETURN(LabelSet labels, LabelSet::Create({{.id = ClassId(1), .name = "thing"}}));
  info.label_set = std::make_shared<LabelSet>(std::move(labels));
  Map map(std::move(info));
  for (int n = 0; n < kManyTilesObjects; ++n) {
    SubmapInfo object;
    object.class_id = ClassId(1);
    object.voxel_size_m = kVoxel_m;
    object.truncation_m = kTruncation_m;
    object.activity = Activity::kInactive;
    map.Create(std::move(object));
  }
  return store.CreateMap(*map.Publish(1));
}

/// Tile number `tile` of the map, in the object whose turn it is.
void AddTile(std::int64_t tile, Map& map) {
  const std::int64_t place = tile / kManyTilesObjects;
  Submap& submap = *map.FindMutable(SubmapId(static_cast<std::uint32_t>(1 + tile % kManyTilesObjects)));
  const BlockIndex index{static_cast<std::int32_t>(kTileSide * (place % kTilesARow)),
                         static_cast<std::int32_t>(kTileSide * (place / kTilesARow)), 0};
  FillBlock(submap.MutableTsdf(index), tile);
}

/// What is there already stays in the store.
Status AddTiles(std::int64_t first, std::int64_t end, MapStore& store) {
  DHPMAP_ASSIGN_OR_RETURN(auto state, store.LoadMap(kManyTilesName));
  Map map(std::move(state));
  const StateMarks before(*map.published());
  for (std::int64_t tile = first; tile < end; ++tile) AddTile(tile, map);
  const double side_m = kVoxel_m * kBlockSide * kTileSide;
  const double rows = static_cast<double>(end) / kManyTilesObjects / static_cast<double>(kTilesARow) + 1;
  const double radius_m = side_m * (static_cast<double>(kTilesARow) + rows);  // reaches all from the first tile
  for (int n = 1; n <= kManyTilesObjects; ++n) {
    map.FindMutable(SubmapId(static_cast<std::uint32_t>(n)))->set_bounding_sphere({{0, 0, 0}, radius_m});
  }
  return store.Commit(before, *map.Publish(1 + end), Durability::kNormal);
}

}  // namespace

Status MakeManyTiles(MapStore& store, std::int64_t num_tiles) {
  DHPMAP_RETURN_IF_ERROR(BeginManyTiles(store));
  for (std::int64_t first = 0; first < num_tiles; first += kTilesACommit) {
    DHPMAP_RETURN_IF_ERROR(AddTiles(first, std::min(first + kTilesACommit, num_tiles), store));
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench
