// SPDX-License-Identifier: BSD-3-Clause
#include "storage/snapshot_reader.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/guarded.h"
#include "mapping/paging/tile_directory.h"
#include "storage/paging/map_layers.h"
#include "storage/paging/stored_submap.h"
#include "storage/paging/tile_cells.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {
namespace {

/// Bounds the memory for blobs not yet decoded: some 1 MB.
constexpr std::size_t kTilesDecodedABatch = 128;

/// The blobs of one tile, and what they decode to.
struct DecodeJob {
  TileIndex index;
  TileKeys keys{};
  std::array<Bytes, kNumBlockLayers> blobs;
  bool is_shared = false;  ///< another submap may have the very same tile
  std::shared_ptr<const BlockTile> tile;
  const ObjectLayer* failed = nullptr;
  Status status;
};

void Decode(DecodeJob& job, std::uint16_t store) {
  auto tile = std::make_shared<BlockTile>();
  for (const ObjectLayer& layer : ObjectLayers()) {
    const auto i = static_cast<std::size_t>(layer.layer);
    if (job.keys[i] == 0) continue;
    job.status = layer.decode(job.blobs[i], job.index, *tile);
    if (!job.status.ok()) {
      job.failed = &layer;
      return;
    }
    tile->stored(layer.layer).Set(store, job.keys[i]);
  }
  job.tile = std::move(tile);
}

/// Whether the row says of the tiles what is so.
Status CheckStored(const SubmapRow& row, const Submap& submap, const TileTotals& totals) {
  Status checked = CheckCounts(CountBlocks(submap), row.counts);
  if (checked.ok() && row.CoversTiles() && totals.sum != row.tiles_sum) {
    checked = DataLoss("has other tiles than were stored");
  }
  if (checked.ok()) return checked;
  return DataLoss("submap " + std::to_string(row.info.id.value) + ": " + checked.message());
}

/// Whether enough is known of its tiles; `without_cells`: those of which some do not say which blocks they have,
/// sorted.
bool CanBeLeftUnread(const SubmapRow& row, const std::vector<std::int64_t>& without_cells) {
  const bool has_any = row.counts.num_tsdf_blocks + row.counts.num_label_blocks + row.counts.num_gone_blocks > 0;
  return has_any && !std::binary_search(without_cells.begin(), without_cells.end(), row.key);
}

/// With its tiles left on the disk.
Result<std::shared_ptr<const Submap>> Unread(const SubmapRow& row, std::uint16_t store, const Paging& paging,
                                             const std::shared_ptr<SharedTiles>& shared, const std::string& map) {
  constexpr std::uint64_t kOlderThanAnyWriter = 0;
  auto stored = std::make_shared<StoredSubmap>(paging.blobs, store, shared, map, row);
  auto submap =
      std::make_shared<Submap>(row.info, kOlderThanAnyWriter, std::make_shared<const UnreadTiles>(std::move(stored)));
  submap->set_bounding_sphere(row.sphere);
  submap->kept_outline().Keep(row.outline);
  if (!row.CoversTiles()) {  // nothing would tell later whether they are still the same
    Status read = Guarded<Status>([&submap] {
      (void)submap->blocks().tiles();
      return Status::Ok();
    });
    if (!read.ok()) return read;
  }
  return std::shared_ptr<const Submap>(std::move(submap));
}

class SubmapReader {
 public:
  SubmapReader(TileRowReader& rows, std::uint16_t store, ThreadPool& pool) : rows_(rows), store_(store), pool_(pool) {}

  Result<std::shared_ptr<const Submap>> Read(const SubmapRow& row) {
    constexpr std::uint64_t kOlderThanAnyWriter = 0;
    auto submap = std::make_shared<Submap>(row.info, kOlderThanAnyWriter);
    submap->set_bounding_sphere(row.sphere);
    TileTotals totals;
    DHPMAP_RETURN_IF_ERROR(rows_.ForEach(row.key, [&](const TileRowReader::Row& tile) -> Status {
      totals.Add(tile.index, tile.layer, {.key = tile.blob_key});
      return Take(tile, *submap);
    }));
    DHPMAP_RETURN_IF_ERROR(DecodeBatch(*submap));
    DHPMAP_RETURN_IF_ERROR(CheckStored(row, *submap, totals));
    submap->kept_outline().Keep(row.outline);
    return std::shared_ptr<const Submap>(std::move(submap));
  }

 private:
  Status Take(const TileRowReader::Row& row, Submap& submap) {
    const ObjectLayer* layer = FindObjectLayer(row.layer);
    const std::uint32_t id = submap.id().value;
    if (layer == nullptr) {
      return FailedPrecondition(TileName(id, row.layer, row.index) + " is of a layer unknown to this version");
    }
    if (row.is_missing) return DataLoss(TileName(id, row.layer, row.index) + " is missing");
    if (jobs_.empty() || jobs_.back().index != row.index) {
      if (jobs_.size() == kTilesDecodedABatch) DHPMAP_RETURN_IF_ERROR(DecodeBatch(submap));
      jobs_.emplace_back().index = row.index;
    }
    DecodeJob& job = jobs_.back();
    const auto i = static_cast<std::size_t>(layer->layer);
    job.keys[i] = row.blob_key;
    job.blobs[i].assign(row.blob.begin(), row.blob.end());
    job.is_shared = job.is_shared || row.is_shared;
    return Status::Ok();
  }

  Status DecodeBatch(Submap& submap) {
    for (DecodeJob& job : jobs_) {
      const auto known = job.is_shared ? shared_.find(job.keys) : shared_.end();
      if (known != shared_.end()) job.tile = known->second;
    }
    pool_.ParallelFor(jobs_.size(), [this](std::size_t i) {
      if (jobs_[i].tile == nullptr) Decode(jobs_[i], store_);
    });
    for (DecodeJob& job : jobs_) {
      if (!job.status.ok()) {
        return {job.status.code(),
                TileName(submap.id().value, job.failed->number, job.index) + " " + job.status.message()};
      }
      if (job.is_shared) shared_.emplace(job.keys, job.tile);
      submap.PutTile(job.index, std::move(job.tile));
    }
    jobs_.clear();
    return Status::Ok();
  }

  TileRowReader& rows_;
  const std::uint16_t store_;
  ThreadPool& pool_;
  std::vector<DecodeJob> jobs_;
  std::map<TileKeys, std::shared_ptr<const BlockTile>> shared_;  ///< clones share them in memory, too
};

Result<std::vector<std::shared_ptr<const Submap>>> ReadSubmapsWithTiles(sqlite::Database& database, const MapRow& map,
                                                                        std::uint16_t store, ThreadPool& pool,
                                                                        Paging* paging) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> rows, ReadSubmaps(database, map.key));
  if (static_cast<std::int64_t>(rows.size()) != map.num_submaps) {
    return DataLoss("has " + std::to_string(rows.size()) + " submaps, not " + std::to_string(map.num_submaps));
  }
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader tiles, TileRowReader::Prepare(database));
  SubmapReader reader(tiles, store, pool);
  std::vector<std::int64_t> without_cells;
  if (paging != nullptr) {
    DHPMAP_ASSIGN_OR_RETURN(without_cells, OwnersWithoutCells(database, map.key));
    paging->lacks_cells = !without_cells.empty();
    if (paging->lacks_cells && !paging->reads_the_rest)
      return Unavailable("some tiles do not say which blocks they have");
  }
  const auto shared = std::make_shared<SharedTiles>();
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(rows.size());
  for (const SubmapRow& row : rows) {
    std::shared_ptr<const Submap>& submap = submaps.emplace_back();
    if (paging != nullptr && CanBeLeftUnread(row, without_cells)) {
      DHPMAP_ASSIGN_OR_RETURN(submap, Unread(row, store, *paging, shared, map.info.name));
    } else {
      DHPMAP_ASSIGN_OR_RETURN(submap, reader.Read(row));
    }
  }
  return submaps;
}

Status DamagedState(const std::string& name, const Status& status) {
  Status named(status.code(), "map '" + name + "': " + status.message());
  // What is refused here as not to be understood is of a version to come; all else is damage, or its cause.
  return status.code() == StatusCode::kFailedPrecondition ? named.WithReason("NEWER_LAYER")
                                                          : named.WithReason("DAMAGED_MAP");
}

}  // namespace

Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        std::uint16_t store, ThreadPool& pool, Paging* paging) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow map, ReadMap(database, name));
  Result<std::vector<std::shared_ptr<const Submap>>> submaps = ReadSubmapsWithTiles(database, map, store, pool, paging);
  if (!submaps.ok()) return DamagedState(name, submaps.status());
  Result<MapLayers> layers = ReadMapLayers(database, map);
  if (!layers.ok()) return DamagedState(name, layers.status());
  return std::make_shared<const MapSnapshot>(std::move(map.info), std::move(submaps).value(),
                                             std::move(layers->free_space),
                                             VacatedSpace{std::move(layers->vacated), map.leaving()});
}

}  // namespace dhpmap
