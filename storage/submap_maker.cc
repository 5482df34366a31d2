// SPDX-License-Identifier: BSD-3-Clause
#include "storage/submap_maker.h"

#include <string>
#include <utility>

#include "storage/tiles/object_layers.h"

namespace dhpmap {
namespace {

/// Limits the memory of blobs not yet decoded to about 1 MB.
constexpr std::size_t kTilesDecodedABatch = 128;

/// Whether the row's records of its tiles are correct.
Status CheckStored(const SubmapRow& row, const Submap& submap, const TileTotals& totals) {
  Status checked = CheckCounts(CountBlocks(submap), row.counts);
  if (checked.ok() && row.CoversTiles() && totals.sum != row.tiles_sum) {
    checked = DataLoss("has other tiles than were stored");
  }
  if (checked.ok()) return checked;
  return DataLoss("submap " + std::to_string(row.info.id.value) + ": " + checked.message());
}

}  // namespace

void SubmapMaker::Decode(DecodeJob& job) const {
  auto tile = std::make_shared<BlockTile>();
  for (const ObjectLayer& layer : ObjectLayers()) {
    const auto i = static_cast<std::size_t>(layer.layer);
    if (job.keys[i] == 0) continue;
    job.status = layer.decode(job.blobs[i], job.index, *tile);
    if (!job.status.ok()) {
      job.failed = &layer;
      return;
    }
    tile->stored(layer.layer).Set(store_, job.keys[i]);
  }
  job.tile = std::move(tile);
}

void SubmapMaker::Begin(const SubmapRow& row) {
  constexpr std::uint64_t kOlderThanAnyWriter = 0;
  row_ = row;
  totals_ = {};
  jobs_.clear();
  submap_ = std::make_shared<Submap>(row.info, kOlderThanAnyWriter);
  submap_->set_bounding_sphere(row.sphere);
}

Result<std::shared_ptr<const Submap>> SubmapMaker::Finish() {
  DHPMAP_RETURN_IF_ERROR(DecodeBatch());
  DHPMAP_RETURN_IF_ERROR(CheckStored(row_, *submap_, totals_));
  submap_->kept_outline().Keep(row_.outline);
  return std::shared_ptr<const Submap>(std::move(submap_));
}

Status SubmapMaker::Add(const TileRow& row) {
  totals_.Add(row.index, row.layer, {.key = row.blob_key});
  const ObjectLayer* layer = FindObjectLayer(row.layer);
  const std::uint32_t id = submap_->id().value;
  if (layer == nullptr) {
    return FailedPrecondition(TileName(id, row.layer, row.index) + " is of a layer unknown to this version");
  }
  if (row.is_missing) return DataLoss(TileName(id, row.layer, row.index) + " is missing");
  if (jobs_.empty() || jobs_.back().index != row.index) {
    if (jobs_.size() == kTilesDecodedABatch) DHPMAP_RETURN_IF_ERROR(DecodeBatch());
    jobs_.emplace_back().index = row.index;
  }
  DecodeJob& job = jobs_.back();
  const auto i = static_cast<std::size_t>(layer->layer);
  job.keys[i] = row.blob_key;
  job.blobs[i].assign(row.blob.begin(), row.blob.end());
  job.is_shared = job.is_shared || row.is_shared;
  return Status::Ok();
}

Status SubmapMaker::DecodeBatch() {
  for (DecodeJob& job : jobs_) {
    const auto known = job.is_shared ? shared_.find(job.keys) : shared_.end();
    if (known != shared_.end()) job.tile = known->second;
  }
  pool_.ParallelFor(jobs_.size(), [this](std::size_t i) {
    if (jobs_[i].tile == nullptr) Decode(jobs_[i]);
  });
  for (DecodeJob& job : jobs_) {
    if (!job.status.ok()) {
      return {job.status.code(),
              TileName(submap_->id().value, job.failed->number, job.index) + " " + job.status.message()};
    }
    if (job.is_shared) shared_.emplace(job.keys, job.tile);
    submap_->PutTile(job.index, std::move(job.tile));
  }
  jobs_.clear();
  return Status::Ok();
}

Status DamagedState(const std::string& name, const Status& status) {
  Status named(status.code(), "map '" + name + "': " + status.message());
  // Data that this version does not understand are of a newer one; all other errors mean damage, or its cause.
  return status.code() == StatusCode::kFailedPrecondition ? named.WithReason("NEWER_LAYER")
                                                          : named.WithReason("DAMAGED_MAP");
}

}  // namespace dhpmap
