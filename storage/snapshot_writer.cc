// SPDX-License-Identifier: BSD-3-Clause
#include "storage/snapshot_writer.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "storage/codec/gone_codec.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "storage/rows/block_rows.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap {
namespace {

/// Bounds the memory for encoded blocks: some 1 MB.
constexpr std::size_t kBlocksABatch = 1024;

/// One submap with rows to write.
struct Target {
  const Submap* submap = nullptr;
  std::int64_t key = 0;
  bool is_new = false;
  SubmapCounts counts;  ///< as stored, kept up to date with what is written
};

/// One block to write.
struct Job {
  std::size_t target = 0;
  Layer layer = Layer::kTsdf;
  const BlockEntry* entry = nullptr;
};

class Writer {
 public:
  Writer(SubmapRowWriter submaps, BlockRowWriter tsdf, BlockRowWriter labels, BlockRowWriter gone, ThreadPool& pool)
      : submaps_(std::move(submaps)),
        tsdf_(std::move(tsdf)),
        labels_(std::move(labels)),
        gone_(std::move(gone)),
        pool_(pool) {}

  Status Write(std::int64_t map_key, const std::vector<SubmapChange>& changes) {
    for (const SubmapChange& change : changes) {
      DHPMAP_RETURN_IF_ERROR(change.after ? WriteRow(map_key, change) : RemoveSubmap(map_key, change.id));
    }
    for (std::size_t begin = 0; begin < jobs_.size(); begin += kBlocksABatch) {
      const std::size_t end = std::min(jobs_.size(), begin + kBlocksABatch);
      DHPMAP_RETURN_IF_ERROR(WriteBatch(std::span(jobs_).subspan(begin, end - begin)));
    }
    for (const Target& target : targets_) DHPMAP_RETURN_IF_ERROR(Finish(target));
    return Status::Ok();
  }

 private:
  static Status NotTheStateBefore(SubmapId id) {
    return FailedPrecondition("the store holds another state of submap " + std::to_string(id.value) +
                              " than the one the commit starts from")
        .WithReason("STALE_STATE");
  }

  Status RemoveSubmap(std::int64_t map_key, SubmapId id) {
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<SubmapRowWriter::Stored> stored, submaps_.Find(map_key, id));
    return stored ? submaps_.Erase(stored->key) : NotTheStateBefore(id);
  }

  /// Writes the row, deletes what is gone, and lists the blocks to write.
  Status WriteRow(std::int64_t map_key, const SubmapChange& change) {
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<SubmapRowWriter::Stored> stored, submaps_.Find(map_key, change.id));
    if (stored.has_value() == change.is_new) return NotTheStateBefore(change.id);
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t key, submaps_.Write(map_key, *change.after));
    Target target{change.after, key, change.is_new, stored ? stored->counts : SubmapCounts{}};
    for (const BlockIndex index : change.erased_tsdf) DHPMAP_RETURN_IF_ERROR(Erase(target, Layer::kTsdf, index));
    for (const BlockIndex index : change.erased_labels) DHPMAP_RETURN_IF_ERROR(Erase(target, Layer::kLabels, index));
    for (const BlockIndex index : change.erased_gone) DHPMAP_RETURN_IF_ERROR(Erase(target, Layer::kGone, index));
    for (const BlockEntry* entry : change.written_tsdf) jobs_.push_back({targets_.size(), Layer::kTsdf, entry});
    for (const BlockEntry* entry : change.written_labels) jobs_.push_back({targets_.size(), Layer::kLabels, entry});
    for (const BlockEntry* entry : change.written_gone) jobs_.push_back({targets_.size(), Layer::kGone, entry});
    targets_.push_back(target);
    return Status::Ok();
  }

  Status WriteBatch(std::span<const Job> jobs) {
    std::vector<Bytes> blobs(jobs.size());
    pool_.ParallelFor(jobs.size(), [&](std::size_t i) { blobs[i] = Encode(jobs[i]); });
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      Target& target = targets_[jobs[i].target];
      DHPMAP_ASSIGN_OR_RETURN(const BlockDelta delta,
                              RowsOf(jobs[i].layer).Write(target.key, jobs[i].entry->index, blobs[i], target.is_new));
      Count(target, jobs[i].layer, delta);
    }
    return Status::Ok();
  }

  [[nodiscard]] Bytes Encode(const Job& job) const {
    const BlockEntry& entry = *job.entry;
    switch (job.layer) {
      case Layer::kTsdf: break;
      case Layer::kLabels: return EncodeLabelBlock(*entry.labels, entry.index);
      case Layer::kGone: return EncodeGoneBlock(*entry.gone, entry.index);
    }
    return EncodeTsdfBlock(*entry.tsdf, entry.index, targets_[job.target].submap->info().truncation_m);
  }

  Status Erase(Target& target, Layer layer, BlockIndex index) {
    DHPMAP_ASSIGN_OR_RETURN(const BlockDelta delta, RowsOf(layer).Erase(target.key, index));
    Count(target, layer, delta);
    return Status::Ok();
  }

  static void Count(Target& target, Layer layer, BlockDelta delta) {
    SubmapCounts& counts = target.counts;
    switch (layer) {
      case Layer::kTsdf: counts.num_tsdf_blocks += delta.rows; break;
      case Layer::kLabels: counts.num_label_blocks += delta.rows; break;
      case Layer::kGone: counts.num_gone_blocks += delta.rows; break;
    }
    counts.blob_bytes += delta.bytes;
  }

  /// The rows there are now must be the blocks that the submap has.
  Status Finish(const Target& target) {
    const SubmapCounts wanted = CountBlocks(*target.submap);
    if (target.counts.num_tsdf_blocks != wanted.num_tsdf_blocks ||
        target.counts.num_label_blocks != wanted.num_label_blocks ||
        target.counts.num_gone_blocks != wanted.num_gone_blocks) {
      return NotTheStateBefore(target.submap->id());
    }
    return submaps_.SetBlobBytes(target.key, target.counts.blob_bytes);
  }

  BlockRowWriter& RowsOf(Layer layer) {
    switch (layer) {
      case Layer::kTsdf: break;
      case Layer::kLabels: return labels_;
      case Layer::kGone: return gone_;
    }
    return tsdf_;
  }

  SubmapRowWriter submaps_;
  BlockRowWriter tsdf_, labels_, gone_;
  ThreadPool& pool_;
  std::vector<Target> targets_;
  std::vector<Job> jobs_;
};

}  // namespace

Status WriteChanges(sqlite::Database& database, std::int64_t map_key, const std::vector<SubmapChange>& changes,
                    ThreadPool& pool) {
  DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter submaps, SubmapRowWriter::Prepare(database));
  DHPMAP_ASSIGN_OR_RETURN(BlockRowWriter tsdf, BlockRowWriter::Prepare(database, Layer::kTsdf));
  DHPMAP_ASSIGN_OR_RETURN(BlockRowWriter labels, BlockRowWriter::Prepare(database, Layer::kLabels));
  DHPMAP_ASSIGN_OR_RETURN(BlockRowWriter gone, BlockRowWriter::Prepare(database, Layer::kGone));
  return Writer(std::move(submaps), std::move(tsdf), std::move(labels), std::move(gone), pool).Write(map_key, changes);
}

}  // namespace dhpmap
