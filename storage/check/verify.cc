// SPDX-License-Identifier: BSD-3-Clause
#include "storage/check/verify.h"

#include <utility>

#include "storage/codec/free_codec.h"
#include "storage/paging/shared_voxels.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

using Kind = MapFault::Kind;

/// How often a request to stop is looked for.
constexpr std::int64_t kTilesALook = 64;

std::string SubmapName(SubmapId id) { return "submap " + std::to_string(id.value); }

Status NewerLayer(const std::string& place) {
  return FailedPrecondition(place + " is of a layer or codec unknown to this version").WithReason("NEWER_LAYER");
}

class Verifier {
 public:
  Verifier(VerifiedRows& rows, VerifyScope scope, const std::stop_token& stop)
      : rows_(rows), scope_(scope), stop_(stop) {}

  Result<Verification> Run() {
    DHPMAP_ASSIGN_OR_RETURN(const MapRow map, ReadMapRow());
    if (found_.is_map_row_bad) return std::move(found_);
    std::vector<SubmapRow> damaged;
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> submaps, rows_.ReadSubmapRows(damaged));
    for (const SubmapRow& row : damaged) {
      Fault(Kind::kRow, SubmapName(row.info.id), "its row has a wrong checksum");
      found_.bad_submaps.push_back(row.key);
    }
    const auto num_rows = static_cast<std::int64_t>(submaps.size() + damaged.size());
    found_.report.num_submaps = num_rows;
    if (num_rows != map.num_submaps) {
      Fault(Kind::kCount, "map",
            "has " + std::to_string(num_rows) + " submaps, not " + std::to_string(map.num_submaps));
      found_.is_number_wrong = true;
    }
    for (const SubmapRow& row : submaps) DHPMAP_RETURN_IF_ERROR(VerifySubmap(row));
    DHPMAP_RETURN_IF_ERROR(VerifyOwnTiles(map));
    if (scope_ == VerifyScope::kAll) {
      const auto check_stop = [this] { return CheckStop(); };
      const auto fault = [this](Kind kind, std::string place, std::string what) {
        Fault(kind, std::move(place), std::move(what));
      };
      DHPMAP_ASSIGN_OR_RETURN(found_.history, VerifyHistory(rows_.History(), map, check_stop, fault));
    }
    DHPMAP_RETURN_IF_ERROR(VerifyReferences());
    found_.report.num_shared_voxels = shared_.num_shared();
    found_.report.shared_places = shared_.places();
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
    Result<MapRow> row = rows_.ReadMapRow();
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
    TileTotals totals;
    SubmapCounts counts;
    BlockTile tile;
    TileIndex index;
    DHPMAP_RETURN_IF_ERROR(rows_.ForEachTile(row.key, [&](const TileRow& stored) -> Status {
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
    DHPMAP_ASSIGN_OR_RETURN(const std::string problem, rows_.ProblemOfBounds(row));
    if (!problem.empty()) Fault(Kind::kBounds, SubmapName(row.info.id), problem);
    if (found_.report.num_faults != num_faults_before) found_.wrong_submaps.push_back(row.key);
    return Status::Ok();
  }

  Status VerifyTile(const SubmapRow& row, const TileRow& stored, BlockTile& tile, SubmapCounts& counts) {
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
    if (stored.cells != 0 && stored.cells != decoded.cells()) {
      Fault(Kind::kCount, place, "holds blocks at other cells than its row says");
    }
    const bool is_tsdf = layer->layer == BlockLayer::kTsdf;
    if (stored.extent != 0 && (!is_tsdf || stored.extent != decoded.Extent().Code())) {
      Fault(Kind::kCount, place, "has observed voxels elsewhere than its row says");
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

  /// Checks that need all layers of a tile.
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
    if (is_settled) shared_.Add(row.info.id, tile);
  }

  Status VerifyOwnTiles(const MapRow& map) {
    TileTotals totals;
    const std::int64_t num_faults_before = found_.report.num_faults;
    const Status read = rows_.ForEachTile(rows_.OwnerOfMapTiles(), [&](const TileRow& row) -> Status {
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
      found_.bad_tiles.push_back({rows_.OwnerOfMapTiles(), row.index, row.layer});
      return Status::Ok();
    });
    DHPMAP_RETURN_IF_ERROR(read);
    if (totals.num_rows != map.tiles.num_rows || (map.CoversTiles() && totals.sum != map.tiles.sum)) {
      Fault(Kind::kCount, "map", "has other tiles of its own than were stored");
    }
    found_.are_own_tiles_wrong = found_.report.num_faults != num_faults_before;
    return Status::Ok();
  }

  Status VerifyReferences() {
    const std::int64_t num_faults_before = found_.report.num_faults;
    DHPMAP_RETURN_IF_ERROR(rows_.ForEachStray([this](std::string what) -> Status {
      Fault(Kind::kReference, "database", std::move(what));
      return CheckStop();
    }));
    found_.are_references_wrong = found_.report.num_faults != num_faults_before;
    return Status::Ok();
  }

  VerifiedRows& rows_;
  const VerifyScope scope_;
  const std::stop_token& stop_;
  Verification found_;
  SharedVoxels shared_;
  std::int64_t num_looks_ = 0;
};

}  // namespace

Result<Verification> Verify(VerifiedRows& rows, VerifyScope scope, const std::stop_token& stop) {
  return Verifier(rows, scope, stop).Run();
}

}  // namespace dhpmap
