// SPDX-License-Identifier: BSD-3-Clause
#include "storage/snapshot_reader.h"

#include <utility>
#include <vector>

#include "storage/codec/gone_codec.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "storage/map_layers.h"
#include "storage/rows/block_rows.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap {
namespace {

/// Bounds the memory for blobs not yet decoded: some 1 MB.
constexpr std::size_t kBlocksABatch = 1024;

/// One blob, and what it decodes to.
struct Job {
  BlockIndex index;
  Bytes blob;
  std::shared_ptr<TsdfBlock> tsdf;
  std::shared_ptr<LabelBlock> labels;
  std::shared_ptr<GoneBlock> gone;
  Status status;
};

/// Layers are not made by make_shared: StateMarks would keep their memory.
void Decode(Layer layer, Job& job) {
  switch (layer) {
    case Layer::kTsdf:
      job.tsdf.reset(new TsdfBlock());
      job.status = DecodeTsdfBlock(job.blob, job.index, *job.tsdf);
      break;
    case Layer::kLabels:
      job.labels.reset(new LabelBlock());
      job.status = DecodeLabelBlock(job.blob, job.index, *job.labels);
      break;
    case Layer::kGone:
      job.gone = std::make_shared<GoneBlock>();
      job.status = DecodeGoneBlock(job.blob, job.index, *job.gone);
      break;
  }
}

/// Fills one layer of one submap.
class LayerReader {
 public:
  LayerReader(Layer layer, BlockRowReader& rows, ThreadPool& pool, Submap& submap)
      : layer_(layer), rows_(rows), pool_(pool), submap_(submap) {}

  Status Read(std::int64_t submap_key, std::int64_t num_expected) {
    Status first_error;
    std::int64_t num_blocks = 0;
    DHPMAP_RETURN_IF_ERROR(rows_.ForEach(submap_key, [&](BlockIndex index, ByteView blob) {
      ++num_blocks;
      if (!first_error.ok()) return;
      jobs_.push_back({.index = index,
                       .blob = Bytes(blob.begin(), blob.end()),
                       .tsdf = {},
                       .labels = {},
                       .gone = {},
                       .status = {}});
      if (jobs_.size() == kBlocksABatch) first_error = DecodeBatch();
    }));
    DHPMAP_RETURN_IF_ERROR(first_error);
    DHPMAP_RETURN_IF_ERROR(DecodeBatch());
    if (num_blocks == num_expected) return Status::Ok();
    return DataLoss("submap " + std::to_string(submap_.id().value) + ": has " + std::to_string(num_blocks) + " " +
                    std::string(LayerName(layer_)) + " blocks, not " + std::to_string(num_expected));
  }

 private:
  Status DecodeBatch() {
    pool_.ParallelFor(jobs_.size(), [this](std::size_t i) { Decode(layer_, jobs_[i]); });
    for (Job& job : jobs_) {
      if (!job.status.ok()) {
        return {job.status.code(), BlockName(submap_.id().value, layer_, job.index) + " " + job.status.message()};
      }
      Put(job);
    }
    jobs_.clear();
    return Status::Ok();
  }

  void Put(Job& job) {
    const BlockEntry* entry = submap_.blocks().Find(job.index);
    switch (layer_) {
      case Layer::kTsdf: submap_.PutBlock(job.index, std::move(job.tsdf), nullptr); break;
      case Layer::kLabels: submap_.PutBlock(job.index, entry ? entry->tsdf : nullptr, std::move(job.labels)); break;
      case Layer::kGone: submap_.PutGone(job.index, std::move(job.gone)); break;
    }
  }

  Layer layer_;
  BlockRowReader& rows_;
  ThreadPool& pool_;
  Submap& submap_;
  std::vector<Job> jobs_;
};

Result<std::vector<std::shared_ptr<const Submap>>> ReadSubmapsWithBlocks(sqlite::Database& database, const MapRow& map,
                                                                         ThreadPool& pool) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> rows, ReadSubmaps(database, map.key));
  if (static_cast<std::int64_t>(rows.size()) != map.num_submaps) {
    return DataLoss("has " + std::to_string(rows.size()) + " submaps, not " + std::to_string(map.num_submaps));
  }
  DHPMAP_ASSIGN_OR_RETURN(BlockRowReader tsdf, BlockRowReader::Prepare(database, Layer::kTsdf));
  DHPMAP_ASSIGN_OR_RETURN(BlockRowReader labels, BlockRowReader::Prepare(database, Layer::kLabels));
  DHPMAP_ASSIGN_OR_RETURN(BlockRowReader gone, BlockRowReader::Prepare(database, Layer::kGone));
  std::vector<std::shared_ptr<const Submap>> submaps;
  for (const SubmapRow& row : rows) {
    constexpr std::uint64_t kOlderThanAnyWriter = 0;
    auto submap = std::make_shared<Submap>(row.info, kOlderThanAnyWriter);
    submap->set_bounding_sphere(row.sphere);
    DHPMAP_RETURN_IF_ERROR(LayerReader(Layer::kTsdf, tsdf, pool, *submap).Read(row.key, row.counts.num_tsdf_blocks));
    DHPMAP_RETURN_IF_ERROR(
        LayerReader(Layer::kLabels, labels, pool, *submap).Read(row.key, row.counts.num_label_blocks));
    DHPMAP_RETURN_IF_ERROR(LayerReader(Layer::kGone, gone, pool, *submap).Read(row.key, row.counts.num_gone_blocks));
    submaps.push_back(std::move(submap));
  }
  return submaps;
}

Status Damaged(const std::string& name, const Status& status) {
  Status named(status.code(), "map '" + name + "': " + status.message());
  // What is refused here as not to be understood is of a version to come; all else is damage, or its cause.
  return status.code() == StatusCode::kFailedPrecondition ? named.WithReason("NEWER_LAYER")
                                                          : named.WithReason("DAMAGED_MAP");
}

}  // namespace

Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        ThreadPool& pool) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow map, ReadMap(database, name));
  Result<std::vector<std::shared_ptr<const Submap>>> submaps = ReadSubmapsWithBlocks(database, map, pool);
  if (!submaps.ok()) return Damaged(name, submaps.status());
  Result<MapLayers> layers = ReadMapLayers(database, map.key, map.num_tiles);
  if (!layers.ok()) return Damaged(name, layers.status());
  return std::make_shared<const MapSnapshot>(std::move(map.info), std::move(submaps).value(),
                                             std::move(layers->free_space), std::move(layers->vacated));
}

}  // namespace dhpmap
