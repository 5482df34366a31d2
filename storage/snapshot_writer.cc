// SPDX-License-Identifier: BSD-3-Clause
#include "storage/snapshot_writer.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>

#include "mapping/base/status_error.h"
#include "mapping/submap/submap_outline.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {
namespace {

/// Limits the memory of encoded tiles to about 1 MB.
constexpr std::size_t kTilesEncodedABatch = 256;

/// One submap with rows to write.
struct Target {
  const Submap* submap = nullptr;
  std::int64_t key = 0;
  SubmapCounts counts;  ///< as stored, updated with each write
  TileTotals tiles;     ///< the same for bytes and checksum
  bool is_new = false;
  bool is_copy = false;  ///< its rows equal the original's; undo data of an edit include them
};

/// One layer of one tile to encode.
struct EncodeJob {
  std::size_t target = 0;
  const TileChange* change = nullptr;
  const ObjectLayer* layer = nullptr;
  StoredBlob before;
};

/// Finds the outline of an inactive thing, so that its row contains it: once each time that it becomes inactive. An
/// active thing changes with each commit, and its outline would cost more than the rest of the commit.
void KeepOutlineOfSettled(const Submap& submap) {
  const SubmapInfo& info = submap.info();
  if (info.panoptic != Panoptic::kThing || info.activity != Activity::kInactive) return;
  if (submap.blocks().unread() != nullptr) return;  // not changed
  const std::span<const TileEntry> tiles = submap.blocks().tiles();
  if (!std::all_of(tiles.begin(), tiles.end(), [](const TileEntry& tile) { return tile.tile->IsRead(); })) return;
  try {
    (void)FindLevelOutline(submap);
  } catch (const StatusError&) {
    return;  // evicted meanwhile
  }
}

class SnapshotWriter {
 public:
  SnapshotWriter(SubmapTable& submaps, TileTable& tiles, std::uint16_t store, ThreadPool& pool, EditTiles* recorder)
      : submaps_(submaps), tiles_(tiles), store_(store), pool_(pool), recorder_(recorder) {}

  Result<WrittenTiles> Write(std::int64_t map_key, const std::vector<SubmapTileChange>& changes) {
    for (const SubmapTileChange& change : changes) {  // first, while the originals of copies are unchanged
      if (change.copy_of) DHPMAP_RETURN_IF_ERROR(WriteSubmap(map_key, change));
    }
    for (const SubmapTileChange& change : changes) {
      if (change.copy_of) continue;
      DHPMAP_RETURN_IF_ERROR(change.after ? WriteSubmap(map_key, change) : RemoveSubmap(map_key, change.id));
    }
    DHPMAP_RETURN_IF_ERROR(Flush());
    for (const Target& target : targets_) {
      SubmapCounts counts = target.counts;
      counts.blob_bytes = target.tiles.bytes;
      if (recorder_ != nullptr && target.is_new) {
        DHPMAP_RETURN_IF_ERROR(recorder_->NoteNew(target.submap->id(), target.key, counts.blob_bytes, target.is_copy));
      }
      KeepOutlineOfSettled(*target.submap);
      DHPMAP_RETURN_IF_ERROR(submaps_.Write(map_key, *target.submap, counts, target.tiles.sum).status());
    }
    return std::move(written_);
  }

 private:
  static Status NotTheStateBefore(SubmapId id) {
    return FailedPrecondition("the store holds another state of submap " + std::to_string(id.value) +
                              " than the one the commit starts from")
        .WithReason("STALE_STATE");
  }

  Status RemoveSubmap(std::int64_t map_key, SubmapId id) {
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<SubmapTable::Stored> stored, submaps_.Find(map_key, id));
    if (!stored) return NotTheStateBefore(id);
    tiles_.NoteDeadBlobs();
    if (recorder_ != nullptr)
      DHPMAP_RETURN_IF_ERROR(recorder_->NoteRemoved(id, stored->key, stored->counts.blob_bytes));
    return submaps_.Erase(stored->key);
  }

  Status WriteSubmap(std::int64_t map_key, const SubmapTileChange& change) {
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<SubmapTable::Stored> stored, submaps_.Find(map_key, change.id));
    if (stored.has_value() == change.is_new) return NotTheStateBefore(change.id);
    DHPMAP_ASSIGN_OR_RETURN(const Target target, stored           ? TargetOf(*change.after, *stored)
                                                 : change.copy_of ? CopiedTarget(map_key, change)
                                                                  : NewTarget(map_key, *change.after));
    targets_.push_back(target);
    targets_.back().is_new = change.is_new;
    for (const TileChange& tile : change.tiles) DHPMAP_RETURN_IF_ERROR(WriteTile(change, tile));
    return Status::Ok();
  }

  Result<Target> TargetOf(const Submap& submap, const SubmapTable::Stored& stored) {
    Target target{&submap, stored.key, stored.counts, {}};
    target.tiles.bytes = stored.counts.blob_bytes;
    target.tiles.sum = stored.tiles_sum;
    if (stored.covers_tiles) return target;
    DHPMAP_ASSIGN_OR_RETURN(const TileTotals totals, tiles_.Count(stored.key));
    target.tiles.sum = totals.sum;
    return target;
  }

  /// Written for its key; its tile counts follow.
  Result<Target> NewTarget(std::int64_t map_key, const Submap& submap) {
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t key, submaps_.Write(map_key, submap, {}, 0));
    return Target{&submap, key, {}, {}};
  }

  /// A new submap with the stored tiles of its original.
  Result<Target> CopiedTarget(std::int64_t map_key, const SubmapTileChange& change) {
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<SubmapTable::Stored> original, submaps_.Find(map_key, *change.copy_of));
    if (!original) return NotTheStateBefore(*change.copy_of);
    DHPMAP_ASSIGN_OR_RETURN(Target target, TargetOf(*change.after, *original));
    DHPMAP_ASSIGN_OR_RETURN(const Target copy, NewTarget(map_key, *change.after));
    target.key = copy.key;
    target.is_copy = change.tiles.empty();  // else some rows differ, and all are counted at the end
    const std::int64_t num_more = recorder_ != nullptr && target.is_copy ? 2 : 1;
    DHPMAP_RETURN_IF_ERROR(tiles_.Copy(original->key, target.key, num_more));
    return target;
  }

  Status WriteTile(const SubmapTileChange& submap, const TileChange& change) {
    Target& target = targets_.back();
    StoredLayers stored{};
    if (!submap.is_new || submap.copy_of) {
      DHPMAP_ASSIGN_OR_RETURN(stored, tiles_.Find(target.key, change.index));
    }
    if (change.after != nullptr && encoding_.contains(change.after.get())) DHPMAP_RETURN_IF_ERROR(Flush());
    for (const ObjectLayer& layer : ObjectLayers()) {
      const auto i = static_cast<std::size_t>(layer.layer);
      const StoredBlob& before = stored[layer.number];
      if (before.num_blocks != change.num_before[i]) return NotTheStateBefore(submap.id);
      if (layer.count != nullptr) target.counts.*layer.count += change.num_after[i] - change.num_before[i];
      DHPMAP_RETURN_IF_ERROR(WriteLayer(target, change, layer, before));
    }
    return Status::Ok();
  }

  Status WriteLayer(Target& target, const TileChange& change, const ObjectLayer& layer, const StoredBlob& before) {
    const auto i = static_cast<std::size_t>(layer.layer);
    if (change.num_after[i] == 0) {
      DHPMAP_RETURN_IF_ERROR(NoteChange(target, change, layer, before, StoredBlob()));
      return tiles_.Erase(target.key, change.index, layer.number, before, target.tiles);
    }
    if (!change.is_written[i]) {  // its blob becomes that of the tile in memory
      written_.Note(*change.after, layer.layer, before.key);
      return Status::Ok();
    }
    DHPMAP_ASSIGN_OR_RETURN(const std::optional<StoredBlob> known, FindStored(*change.after, layer.layer));
    if (!known) {
      jobs_.push_back({targets_.size() - 1, &change, &layer, before});
      encoding_.insert(change.after.get());
      return jobs_.size() < kTilesEncodedABatch ? Status::Ok() : Flush();
    }
    return Put(target, change, layer, before, *known);
  }

  /// The stored blob of a tile in memory, if there is one.
  Result<std::optional<StoredBlob>> FindStored(const BlockTile& tile, BlockLayer layer) {
    std::int64_t key = written_.Find(tile, layer);
    if (key == 0) key = tile.stored(layer).In(store_);
    if (key == 0) return std::optional<StoredBlob>();
    return tiles_.Share(key);
  }

  Status Put(Target& target, const TileChange& change, const ObjectLayer& layer, const StoredBlob& before,
             const StoredBlob& blob) {
    written_.Note(*change.after, layer.layer, blob.key);
    DHPMAP_RETURN_IF_ERROR(NoteChange(target, change, layer, before, blob));
    StoredBlob row = blob;
    row.cells = change.after->CellsWith(layer.layer);
    if (layer.layer == BlockLayer::kTsdf) row.extent = change.after->Extent().Code();
    return tiles_.Put(target.key, change.index, layer.number, before, row, target.tiles);
  }

  /// Records undo data of an edit. New submaps are recorded as a whole at the end.
  Status NoteChange(const Target& target, const TileChange& change, const ObjectLayer& layer, const StoredBlob& before,
                    const StoredBlob& after) {
    if (recorder_ == nullptr || target.is_new) return Status::Ok();
    return recorder_->Note(target.submap->id().value, change.index, layer.number, before, after);
  }

  /// Encodes and writes the collected tiles.
  Status Flush() {
    std::vector<Bytes> blobs(jobs_.size());
    pool_.ParallelFor(jobs_.size(), [&](std::size_t i) {
      const EncodeJob& job = jobs_[i];
      blobs[i] = job.layer->encode(*job.change->after, job.change->index, targets_[job.target].submap->info());
    });
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const EncodeJob& job = jobs_[i];
      const std::int64_t num_blocks = job.change->num_after[static_cast<std::size_t>(job.layer->layer)];
      DHPMAP_ASSIGN_OR_RETURN(const StoredBlob blob, tiles_.Insert(blobs[i], num_blocks));
      written_.NoteNewBlob();
      DHPMAP_RETURN_IF_ERROR(Put(targets_[job.target], *job.change, *job.layer, job.before, blob));
    }
    jobs_.clear();
    encoding_.clear();
    return Status::Ok();
  }

  SubmapTable& submaps_;
  TileTable& tiles_;
  const std::uint16_t store_;
  ThreadPool& pool_;
  EditTiles* const recorder_;  // null: not an edit
  std::vector<Target> targets_;
  std::vector<EncodeJob> jobs_;
  std::unordered_set<const BlockTile*> encoding_;  ///< tiles of the jobs
  WrittenTiles written_;
};

}  // namespace

void WrittenTiles::TellTiles(std::uint16_t store) const {
  for (const auto& [tile, keys] : keys_) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (keys[i] != 0) tile->stored(static_cast<BlockLayer>(i)).Set(store, keys[i]);
    }
  }
}

Result<WrittenTiles> WriteChanges(SubmapTable& submaps, TileTable& tiles, std::int64_t map_key,
                                  const std::vector<SubmapTileChange>& changes, std::uint16_t store, ThreadPool& pool,
                                  EditTiles* recorder) {
  return SnapshotWriter(submaps, tiles, store, pool, recorder).Write(map_key, changes);
}

}  // namespace dhpmap
