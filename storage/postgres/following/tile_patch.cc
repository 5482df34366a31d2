// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/following/tile_patch.h"

#include <string>
#include <utility>
#include <vector>

#include "storage/codec/free_codec.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap::postgres {
namespace {

TileIndex IndexOf(const std::array<std::int32_t, 3>& place) { return {place[0], place[1], place[2]}; }

bool HasLayer(std::uint32_t layers, std::int64_t number) { return (layers >> number & 1u) != 0; }

}  // namespace

TilePatch::TilePatch(const CommitPlaces::Owner& places, std::uint16_t store) : store_(store) {
  for (const auto& [place, layers] : places.tiles) {
    Changed& changed = tiles_[place];
    for (const ObjectLayer& layer : ObjectLayers()) {
      changed.differs[static_cast<std::size_t>(layer.layer)] = HasLayer(layers, layer.number);
    }
  }
}

Status TilePatch::Add(const TileRow& row) {
  const ObjectLayer* layer = FindObjectLayer(row.layer);
  if (layer == nullptr) return FailedPrecondition("a tile is of a layer unknown to this version");
  const auto found = tiles_.find({row.index.x, row.index.y, row.index.z});
  if (found == tiles_.end() || row.blob.empty()) return DataLoss("a tile is missing, or was not asked for");
  const auto i = static_cast<std::size_t>(layer->layer);
  found->second.keys[i] = row.blob_key;
  found->second.blobs[i].assign(row.blob.begin(), row.blob.end());
  return Status::Ok();
}

void TilePatch::Decode(TileIndex index, Changed& changed) const {
  for (const ObjectLayer& layer : ObjectLayers()) {
    const auto i = static_cast<std::size_t>(layer.layer);
    if (changed.keys[i] == 0) continue;
    if (changed.tile == nullptr) changed.tile = std::make_shared<BlockTile>();
    changed.status = layer.decode(changed.blobs[i], index, *changed.tile);
    if (!changed.status.ok()) return;
    changed.tile->stored(layer.layer).Set(store_, changed.keys[i]);
  }
}

Result<std::shared_ptr<const Submap>> TilePatch::Apply(const Submap& before, const SubmapRow& row, ThreadPool& pool) {
  std::vector<std::pair<TileIndex, Changed*>> jobs;
  for (auto& [place, changed] : tiles_) jobs.emplace_back(IndexOf(place), &changed);
  pool.ParallelFor(jobs.size(), [&](std::size_t i) { Decode(jobs[i].first, *jobs[i].second); });
  auto submap = std::make_shared<Submap>(before);
  submap->mutable_info() = row.info;
  for (const auto& [index, changed] : jobs) {
    if (!changed->status.ok()) return changed->status;
    submap->PutLayers(index, changed->tile.get(), changed->differs);
  }
  submap->set_bounding_sphere(row.sphere);
  DHPMAP_RETURN_IF_ERROR(Check(*submap, row));
  submap->kept_outline().Keep(row.outline);
  return std::shared_ptr<const Submap>(std::move(submap));
}

/// The sum of the rows covers all tiles, so it shows whether the shared tiles are still the stored ones.
Status TilePatch::Check(const Submap& submap, const SubmapRow& row) const {
  DHPMAP_RETURN_IF_ERROR(CheckCounts(CountBlocks(submap), row.counts));
  constexpr std::uint16_t kNone = 0;
  if (!row.CoversTiles() || store_ == kNone) return Status::Ok();
  TileTotals totals;
  for (const TileEntry& entry : submap.blocks().tiles()) {
    for (const ObjectLayer& layer : ObjectLayers()) {
      const std::int64_t key = entry.tile->stored(layer.layer).In(store_);
      if (key != 0) totals.Add(entry.index, layer.number, {.key = key});
    }
  }
  return totals.sum == row.tiles_sum ? Status::Ok() : DataLoss("a submap has other tiles than were stored");
}

LayerPatch::LayerPatch(const FreeSpace& before, const CommitPlaces::Owner& places, BlobKind kind) : kind_(kind) {
  for (const auto& [place, layers] : places.tiles) {
    if (!HasLayer(layers, LayerNumber(kind))) continue;
    if (after_ == nullptr) after_ = std::make_shared<FreeSpace>(before);
    after_->Erase(IndexOf(place));
  }
}

bool LayerPatch::IsOf(const TileRow& row) const { return after_ != nullptr && row.layer == LayerNumber(kind_); }

Status LayerPatch::Add(const TileRow& row) {
  auto tile = std::make_shared<FreeTile>();
  DHPMAP_RETURN_IF_ERROR(DecodeFreeTile(kind_, row.blob, row.index, *tile));
  after_->Put(row.index, std::move(tile));
  return Status::Ok();
}

std::shared_ptr<const FreeSpace> LayerPatch::Finish(const std::shared_ptr<const FreeSpace>& before) const {
  return after_ == nullptr ? before : after_;
}

}  // namespace dhpmap::postgres
