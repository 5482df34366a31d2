// SPDX-License-Identifier: BSD-3-Clause
#include "storage/verify.h"

#include <array>
#include <bitset>
#include <set>
#include <unordered_map>
#include <utility>

#include "storage/change_history.h"
#include "storage/codec/free_codec.h"
#include "storage/edit_log.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;
using Kind = MapFault::Kind;

constexpr char kTask[] = "verify the map";
constexpr char kRepairTask[] = "repair the map";

/// How often a request to stop is looked for.
constexpr std::int64_t kTilesALook = 64;

std::string SubmapName(SubmapId id) { return "submap " + std::to_string(id.value); }

Status NewerLayer(const std::string& place) {
  return FailedPrecondition(place + " is of a layer or codec unknown to this version").WithReason("NEWER_LAYER");
}

/// Which voxels settled objects hold, and how many more than one does.
class SharedVoxels {
 public:
  void Add(const BlockTile& tile) {
    for (const BlockEntry& entry : tile.entries()) {
      if (entry.tsdf == nullptr) continue;
      if (held_.size() >= kMaxBlocks && !held_.contains(entry.index)) {
        is_too_large_ = true;
        continue;
      }
      Voxels& held = held_[entry.index];
      for (int v = 0; v < kBlockVoxels; ++v) {
        if (!entry.Shows(v)) continue;
        num_shared_ += held.test(static_cast<std::size_t>(v));
        held.set(static_cast<std::size_t>(v));
      }
    }
  }
  [[nodiscard]] std::int64_t num_shared() const { return is_too_large_ ? -1 : num_shared_; }

 private:
  using Voxels = std::bitset<kBlockVoxels>;
  static constexpr std::size_t kMaxBlocks = 1 << 20;  // some 100 MB
  std::unordered_map<BlockIndex, Voxels, BlockIndexHash> held_;
  std::int64_t num_shared_ = 0;
  bool is_too_large_ = false;
};

class Verifier {
 public:
  Verifier(Database& database, const std::string& name, const std::stop_token& stop)
      : database_(database), name_(name), stop_(stop) {}

  Result<Verification> Run() {
    DHPMAP_ASSIGN_OR_RETURN(const MapRow map, ReadMapRow());
    if (found_.is_map_row_bad) return std::move(found_);
    std::vector<SubmapRow> damaged;
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> submaps, ReadSubmaps(database_, map.key, &damaged));
    for (const SubmapRow& row : damaged) {
      Fault(Kind::kRow, SubmapName(row.info.id), "its row has a wrong checksum");
      found_.bad_submaps.push_back(row.key);
    }
    const auto num_rows = static_cast<std::int64_t>(submaps.size() + damaged.size());
    found_.report.num_submaps = num_rows;
    if (num_rows != map.num_submaps) {
      Fault(Kind::kCount, "map",
            "has " + std::to_string(num_rows) + " submaps, not " + std::to_string(map.num_submaps));
    }
    for (const SubmapRow& row : submaps) DHPMAP_RETURN_IF_ERROR(VerifySubmap(row));
    DHPMAP_RETURN_IF_ERROR(VerifyOwnTiles(map));
    DHPMAP_RETURN_IF_ERROR(VerifyReferences());
    found_.report.num_shared_voxels = shared_.num_shared();
    return std::move(found_);
  }

 private:
  void Fault(Kind kind, std::string place, std::string what) {
    ++found_.report.num_faults;
    if (found_.report.faults.size() < VerifyReport::kMaxFaults) {
      found_.report.faults.push_back({kind, std::move(place), std::move(what)});
    }
  }

  Status CheckStop() {
    if (++num_looks_ % kTilesALook != 0 || !stop_.stop_requested()) return Status::Ok();
    return Cancelled("nobody waits for the verification any more");
  }

  Result<MapRow> ReadMapRow() {
    Result<MapRow> row = ReadMap(database_, name_);
    if (row.status().code() != StatusCode::kDataLoss) {
      if (row.ok()) found_.report.revision = row->info.revision;
      return row;
    }
    Fault(Kind::kRow, "map", row.status().message());
    found_.is_map_row_bad = true;
    return MapRow();
  }

  Status VerifySubmap(const SubmapRow& row) {
    const std::int64_t num_faults_before = found_.report.num_faults;
    DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database_));
    TileTotals totals;
    SubmapCounts counts;
    BlockTile tile;
    TileIndex index;
    DHPMAP_RETURN_IF_ERROR(rows.ForEach(row.key, [&](const TileRowReader::Row& stored) -> Status {
      if (stored.index != index) FinishTile(row, std::exchange(tile, BlockTile()));
      index = stored.index;
      totals.Add(stored.index, stored.layer, {.key = stored.blob_key});
      return VerifyTile(row, stored, tile, counts);
    }));
    FinishTile(row, tile);
    for (const ObjectLayer& layer : ObjectLayers()) {
      if (layer.count == nullptr || counts.*layer.count == row.counts.*layer.count) continue;
      Fault(Kind::kCount, SubmapName(row.info.id),
            "has " + std::to_string(counts.*layer.count) + " " + std::string(layer.name) + " blocks, not " +
                std::to_string(row.counts.*layer.count));
    }
    if (row.CoversTiles() && totals.sum != row.tiles_sum) {
      Fault(Kind::kCount, SubmapName(row.info.id), "has other tiles than were stored");
    }
    DHPMAP_RETURN_IF_ERROR(VerifyBox(row));
    if (found_.report.num_faults != num_faults_before) found_.wrong_submaps.push_back(row.key);
    return Status::Ok();
  }

  Status VerifyTile(const SubmapRow& row, const TileRowReader::Row& stored, BlockTile& tile, SubmapCounts& counts) {
    const std::string place = TileName(row.info.id.value, stored.layer, stored.index);
    const ObjectLayer* layer = FindObjectLayer(stored.layer);
    if (layer == nullptr) return NewerLayer(place);
    DHPMAP_RETURN_IF_ERROR(CheckStop());
    ++found_.report.num_tiles;
    found_.report.blob_bytes += static_cast<std::int64_t>(stored.blob.size());
    BlockTile decoded;
    const Status status =
        stored.is_missing ? DataLoss("is missing") : layer->decode(stored.blob, stored.index, decoded);
    if (status.code() == StatusCode::kFailedPrecondition) return NewerLayer(place);
    if (!status.ok()) {
      Fault(Kind::kBlob, place, status.message());
      found_.bad_tiles.push_back({row.key, stored.index, stored.layer});
      return Status::Ok();
    }
    const auto num_blocks = static_cast<std::int64_t>(decoded.entries().size());
    found_.report.num_blocks += num_blocks;
    if (layer->count != nullptr) counts.*layer->count += num_blocks;
    if (num_blocks != stored.num_blocks) {
      Fault(Kind::kCount, place,
            "holds " + std::to_string(num_blocks) + " blocks, not " + std::to_string(stored.num_blocks));
    }
    for (const BlockEntry& entry : decoded.entries()) {
      ForEachLayer(
          [](BlockLayer, const auto& from, auto& to) {
            if (from != nullptr) to = from;
          },
          entry, tile.FindOrInsert(entry.index));
    }
    return Status::Ok();
  }

  /// What can be said of a tile once all of its layers are read.
  void FinishTile(const SubmapRow& row, const BlockTile& tile) {
    const double side_m = kBlockSide * row.info.voxel_size_m;
    for (const BlockEntry& entry : tile.entries()) {
      const Eigen::Vector3d center_m =
          (Eigen::Vector3d(entry.index.x, entry.index.y, entry.index.z) + Eigen::Vector3d::Constant(0.5)) * side_m;
      const Eigen::Vector3d farthest_m =
          (center_m - row.sphere.center_m).cwiseAbs() + Eigen::Vector3d::Constant(side_m / 2);
      constexpr double kRounding = 1 + 1e-9;
      if (farthest_m.norm() <= row.sphere.radius_m * kRounding) continue;
      Fault(Kind::kBounds, SubmapName(row.info.id),
            "its sphere does not contain block (" + std::to_string(entry.index.x) + ", " +
                std::to_string(entry.index.y) + ", " + std::to_string(entry.index.z) + ")");
      break;
    }
    const bool is_settled = row.info.activity == Activity::kInactive && row.info.presence == Presence::kPresent &&
                            !row.info.is_placed && !row.info.is_locked && row.info.id != kUnknownSubmap &&
                            row.info.T_map_submap.matrix() == Transform::Identity().matrix();
    if (is_settled) shared_.Add(tile);
  }

  Status VerifyBox(const SubmapRow& row) {
    if (row.sphere.IsEmpty()) return Status::Ok();
    DHPMAP_ASSIGN_OR_RETURN(Statement select, database_.Prepare("SELECT min_x_m, max_x_m, min_y_m, max_y_m, min_z_m, "
                                                                "max_z_m FROM submap_boxes WHERE submap_key = ?",
                                                                kTask));
    DHPMAP_ASSIGN_OR_RETURN(const bool has_box, select.Bind(row.key).Step());
    if (!has_box) {
      Fault(Kind::kBounds, SubmapName(row.info.id), "has no box");
      return Status::Ok();
    }
    const Eigen::Vector3d center_m = row.info.T_map_submap * row.sphere.center_m;
    for (int axis = 0; axis < 3; ++axis) {
      if (select.Real(2 * axis) <= center_m[axis] - row.sphere.radius_m &&
          select.Real(2 * axis + 1) >= center_m[axis] + row.sphere.radius_m) {
        continue;
      }
      Fault(Kind::kBounds, SubmapName(row.info.id), "its box does not contain its sphere");
      break;
    }
    return Status::Ok();
  }

  Status VerifyOwnTiles(const MapRow& map) {
    DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database_));
    TileTotals totals;
    const std::int64_t num_faults_before = found_.report.num_faults;
    const Status read = rows.ForEach(OwnerOfMap(map.key), [&](const TileRowReader::Row& row) -> Status {
      DHPMAP_RETURN_IF_ERROR(CheckStop());
      const bool is_free = row.layer == LayerNumber(BlobKind::kFreeV1);
      const std::string place = NameOfTile(is_free ? "free-space" : "vacated", row.index);
      if (!is_free && row.layer != LayerNumber(BlobKind::kVacatedV1)) {
        return NewerLayer(NameOfTile("layer " + std::to_string(row.layer), row.index));
      }
      totals.Add(row.index, row.layer, {.key = row.blob_key});
      ++found_.report.num_tiles;
      found_.report.blob_bytes += static_cast<std::int64_t>(row.blob.size());
      FreeTile tile;
      const BlobKind kind = is_free ? BlobKind::kFreeV1 : BlobKind::kVacatedV1;
      const Status status = row.is_missing ? DataLoss("is missing") : DecodeFreeTile(kind, row.blob, row.index, tile);
      if (status.code() == StatusCode::kFailedPrecondition) return NewerLayer(place);
      if (status.ok()) return status;
      Fault(Kind::kBlob, place, status.message());
      found_.bad_tiles.push_back({OwnerOfMap(map.key), row.index, row.layer});
      return Status::Ok();
    });
    DHPMAP_RETURN_IF_ERROR(read);
    if (totals.num_rows != map.tiles.num_rows || (map.CoversTiles() && totals.sum != map.tiles.sum)) {
      Fault(Kind::kCount, "map", "has other tiles of its own than were stored");
    }
    found_.are_own_tiles_wrong = found_.report.num_faults != num_faults_before;
    return Status::Ok();
  }

  /// Of all maps: blobs that nobody refers to and that are not listed as such, and wrong counts of those that refer.
  Status VerifyReferences() {
    DHPMAP_ASSIGN_OR_RETURN(
        const std::int64_t num_orphans,
        database_.QueryInt(
            "SELECT count(*) FROM (SELECT blob_key FROM tile_blobs EXCEPT SELECT blob_key FROM blob_references "
            "EXCEPT SELECT blob_key FROM dead_blobs)",
            kTask));
    DHPMAP_ASSIGN_OR_RETURN(
        const std::int64_t num_wrong,
        database_.QueryInt(
            "SELECT (SELECT count(*) FROM (SELECT blob_key, count(*) - 1 FROM blob_references GROUP BY blob_key "
            "HAVING count(*) > 1 EXCEPT SELECT blob_key, num_more FROM shared_blobs)) + "
            "(SELECT count(*) FROM (SELECT blob_key, num_more FROM shared_blobs EXCEPT "
            "SELECT blob_key, count(*) - 1 FROM blob_references GROUP BY blob_key)) + "
            "(SELECT count(*) FROM dead_blobs WHERE blob_key IN (SELECT blob_key FROM blob_references))",
            kTask));
    if (num_orphans > 0) Fault(Kind::kReference, "database", std::to_string(num_orphans) + " blobs belong to nothing");
    if (num_wrong > 0) {
      Fault(Kind::kReference, "database",
            std::to_string(num_wrong) + " blobs have a wrong count of what refers to them");
    }
    found_.are_references_wrong = num_orphans + num_wrong > 0;
    return Status::Ok();
  }

  Database& database_;
  const std::string& name_;
  const std::stop_token& stop_;
  Verification found_;
  SharedVoxels shared_;
  std::int64_t num_looks_ = 0;
};

/// Has the row of a submap say what can be read of it.
Status Reseal(Database& database, const SubmapRow& row, std::int64_t revision) {
  constexpr std::uint64_t kGeneration = 1;
  Submap submap(row.info, kGeneration);
  submap.mutable_info().revision = revision;
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader rows, TileRowReader::Prepare(database));
  TileTotals totals;
  std::vector<StoredBlob> miscounted;
  const Status read = rows.ForEach(row.key, [&](const TileRowReader::Row& stored) -> Status {
    BlockTile tile;
    DHPMAP_RETURN_IF_ERROR(FindObjectLayer(stored.layer)->decode(stored.blob, stored.index, tile));
    totals.Add(stored.index, stored.layer,
               {.key = stored.blob_key, .bytes = static_cast<std::int64_t>(stored.blob.size())});
    for (const BlockEntry& entry : tile.entries()) submap.AddLayers(entry);
    const auto num_blocks = static_cast<std::int64_t>(tile.entries().size());
    if (num_blocks != stored.num_blocks) miscounted.push_back({.key = stored.blob_key, .num_blocks = num_blocks});
    return Status::Ok();
  });
  DHPMAP_RETURN_IF_ERROR(read);
  DHPMAP_ASSIGN_OR_RETURN(Statement count,
                          database.Prepare("UPDATE tile_blobs SET num_blocks = ? WHERE blob_key = ?", kRepairTask));
  for (const StoredBlob& blob : miscounted) DHPMAP_RETURN_IF_ERROR(count.Bind(blob.num_blocks).Bind(blob.key).Run());
  submap.UpdateBoundingSphere();
  SubmapCounts counts = CountBlocks(submap);
  counts.blob_bytes = totals.bytes;
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter writer, SubmapRowWriter::Prepare(database));
  return writer.Write(row.map_key, submap, counts, totals.sum).status();
}

/// With a TSDF all of the tile goes: labels of nothing, and what is gone of it, say nothing.
Status Drop(const BadTile& bad, TileRows& tiles) {
  DHPMAP_ASSIGN_OR_RETURN(const StoredLayers stored, tiles.Find(bad.owner_key, bad.index));
  const bool is_all = bad.layer == LayerNumber(BlobKind::kTsdfTile);
  TileTotals ignored;  // counted anew when all is dropped
  for (std::size_t layer = 0; layer < stored.size(); ++layer) {
    const auto number = static_cast<std::int64_t>(layer);
    if (!is_all && number != bad.layer) continue;
    DHPMAP_RETURN_IF_ERROR(tiles.Erase(bad.owner_key, bad.index, number, stored[layer], ignored));
  }
  return Status::Ok();
}

Status RepairReferences(Database& database) {
  return database.Execute(
      "DELETE FROM shared_blobs; INSERT INTO shared_blobs (blob_key, num_more) SELECT blob_key, count(*) - 1 FROM "
      "blob_references GROUP BY blob_key HAVING count(*) > 1; DELETE FROM dead_blobs; INSERT INTO dead_blobs "
      "(blob_key) SELECT "
      "blob_key "
      "FROM tile_blobs EXCEPT SELECT blob_key FROM blob_references",
      kRepairTask);
}

}  // namespace

Result<Verification> VerifyRows(Database& database, const std::string& name, const std::stop_token& stop) {
  return Verifier(database, name, stop).Run();
}

Status RepairRows(Database& database, const std::string& name, Verification& found) {
  if (found.report.num_faults == 0) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(MapRow map, ReadMap(database, name));
  DHPMAP_ASSIGN_OR_RETURN(TileRows tiles, TileRows::Prepare(database));
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter writer, SubmapRowWriter::Prepare(database));
  for (const BadTile& bad : found.bad_tiles) DHPMAP_RETURN_IF_ERROR(Drop(bad, tiles));
  for (const std::int64_t key : found.bad_submaps) DHPMAP_RETURN_IF_ERROR(writer.Erase(key));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> submaps, ReadSubmaps(database, map.key));
  const std::set<std::int64_t> wrong(found.wrong_submaps.begin(), found.wrong_submaps.end());
  for (const SubmapRow& row : submaps) {
    if (wrong.contains(row.key)) DHPMAP_RETURN_IF_ERROR(Reseal(database, row, map.info.revision + 1));
  }
  DHPMAP_RETURN_IF_ERROR(RepairReferences(database));
  DHPMAP_RETURN_IF_ERROR(ForgetChanges(database, map.key));
  DHPMAP_RETURN_IF_ERROR(ForgetEdits(database, map.key));
  DHPMAP_ASSIGN_OR_RETURN(map.tiles, tiles.Count(OwnerOfMap(map.key)));
  map.num_submaps = static_cast<std::int64_t>(submaps.size());
  DHPMAP_RETURN_IF_ERROR(WriteRepairedMap(database, map));
  found.report.is_repaired = true;
  found.report.revision = map.info.revision;
  return Status::Ok();
}

}  // namespace dhpmap
