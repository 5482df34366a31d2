// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_storage_bench DATASET [predicted|groundtruth|none] [FRAMES] [DATABASE]: maps a data set in process, commits
// after every frame as a server does, and reports sizes and rates of codec and store, what tiles write beyond the
// blocks that changed, and what a clone and a move of an object of a million voxels cost.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "mapping/pipeline/map_builder.h"
#include "storage/sqlite/database.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "storage/tiles/object_layers.h"
#include "tests/bench/cpu_time.h"
#include "tests/support/diff_snapshots.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

template <typename T>
T Must(Result<T> result) {
  if (result.ok()) return std::move(result).value();
  std::fprintf(stderr, "%s\n", result.status().ToString().c_str());
  std::exit(1);
}
void Must(const Status& status) {
  if (status.ok()) return;
  std::fprintf(stderr, "%s\n", status.ToString().c_str());
  std::exit(1);
}

std::int64_t NumBlocks(const BlockTile& tile, BlockLayer wanted) {
  std::int64_t count = 0;
  for (const BlockEntry& entry : tile.entries()) {
    ForEachLayer([&](BlockLayer layer, const auto& block) { count += layer == wanted && block != nullptr; }, entry);
  }
  return count;
}

/// Of one layer, over all tiles of a map.
struct CodecSums {
  std::int64_t num_tiles = 0, num_blocks = 0, bytes = 0;
  double encode_s = 0, decode_s = 0;
};

/// One thread.
void MeasureCodecs(const MapSnapshot& map) {
  std::array<CodecSums, kNumBlockLayers> sums{};
  for (const auto& submap : map.submaps()) {
    for (const TileEntry& entry : submap->blocks().tiles()) {
      for (const ObjectLayer& layer : ObjectLayers()) {
        CodecSums& sum = sums[static_cast<std::size_t>(layer.layer)];
        const std::int64_t num_blocks = NumBlocks(*entry.tile, layer.layer);
        if (num_blocks == 0) continue;
        double begin = bench::ThreadCpu_s();
        const Bytes blob = layer.encode(*entry.tile, entry.index, submap->info());
        sum.encode_s += bench::ThreadCpu_s() - begin;
        BlockTile tile;
        begin = bench::ThreadCpu_s();
        Must(layer.decode(blob, entry.index, tile));
        sum.decode_s += bench::ThreadCpu_s() - begin;
        sum.num_tiles += 1;
        sum.num_blocks += num_blocks;
        sum.bytes += static_cast<std::int64_t>(blob.size());
      }
    }
  }
  for (const ObjectLayer& layer : ObjectLayers()) {
    const CodecSums& sum = sums[static_cast<std::size_t>(layer.layer)];
    if (sum.num_tiles == 0) continue;
    const auto tiles = static_cast<double>(sum.num_tiles), blocks = static_cast<double>(sum.num_blocks);
    const auto bytes = static_cast<double>(sum.bytes);
    std::printf(
        "%-6s %6lld tiles of %.1f blocks, %.0f B/tile, %.1f B/block, %.3f B/voxel; encode %.0f us a tile, %.1f a "
        "block; "
        "decode %.0f us a tile, %.1f a block\n",
        std::string(layer.name).c_str(), static_cast<long long>(sum.num_tiles), blocks / tiles, bytes / tiles,
        bytes / blocks, bytes / blocks / kBlockVoxels, 1e6 * sum.encode_s / tiles, 1e6 * sum.encode_s / blocks,
        1e6 * sum.decode_s / tiles, 1e6 * sum.decode_s / blocks);
  }
}

/// Bytes of what commits wrote, and what they would have in tiles of other sizes.
struct Written {
  std::size_t block_bytes = 0;  ///< the blocks that changed, one by one
  std::size_t cube_bytes = 0;   ///< the cubes of 2^3 blocks around them
  std::size_t tile_bytes = 0;   ///< their tiles

  [[nodiscard]] double Amplification(std::size_t bytes) const {
    return static_cast<double>(bytes) / static_cast<double>(block_bytes);
  }
};

/// The blocks of a tile that lie in one of its cubes of 2^3; `cube` is of one of its blocks.
BlockTile CubeOf(const BlockTile& tile, BlockIndex cube) {
  BlockTile part;
  for (const BlockEntry& entry : tile.entries()) {
    const BlockIndex b = entry.index;
    if ((b.x >> 1) == cube.x && (b.y >> 1) == cube.y && (b.z >> 1) == cube.z) part.FindOrInsert(b) = entry;
  }
  return part;
}

void Count(const MapSnapshot& before, const MapSnapshot& after, Written& written) {
  for (const SubmapTileChange& change : DiffTiles(before, after)) {
    for (const TileChange& tile : change.tiles) {
      for (const ObjectLayer& layer : ObjectLayers()) {
        const auto i = static_cast<std::size_t>(layer.layer);
        if (!tile.is_written[i] || tile.num_after[i] == 0) continue;
        written.tile_bytes += layer.encode(*tile.after, tile.index, change.after->info()).size();
      }
    }
  }
  for (const SubmapChange& change : DiffSnapshots(before, after)) {
    std::set<std::pair<BlockLayer, BlockIndex>> cubes;
    const auto count = [&](BlockLayer layer, const std::vector<const BlockEntry*>& blocks) {
      const ObjectLayer& codec = ObjectLayers()[static_cast<std::size_t>(layer)];
      for (const BlockEntry* entry : blocks) {
        const TileIndex index = TileOf(entry->index);
        BlockTile one;
        one.FindOrInsert(entry->index) = *entry;
        written.block_bytes += codec.encode(one, index, change.after->info()).size();
        const BlockIndex cube{entry->index.x >> 1, entry->index.y >> 1, entry->index.z >> 1};
        if (!cubes.insert({layer, cube}).second) continue;
        const BlockTile part = CubeOf(*change.after->blocks().FindTile(index)->tile, cube);
        written.cube_bytes += codec.encode(part, index, change.after->info()).size();
      }
    };
    count(BlockLayer::kTsdf, change.written_tsdf);
    count(BlockLayer::kLabels, change.written_labels);
    count(BlockLayer::kGone, change.written_gone);
  }
}

/// Once what is no longer needed is collected.
std::int64_t UsedBytes(const std::string& path) {
  auto database = Must(sqlite::Database::Open(path, sqlite::OpenMode::kReadOnly, 1000));
  while (Must(database.QueryInt("SELECT count(*) FROM dead_blobs", "measure")) > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  constexpr std::int64_t kPageBytes = 4096;
  return kPageBytes * (Must(database.QueryInt("PRAGMA page_count", "measure")) -
                       Must(database.QueryInt("PRAGMA freelist_count", "measure")));
}

/// What a change of one object costs that touches none of its voxels, with nothing else to commit.
template <typename Change>
void MeasureEdit(const char* what, MapStore& store, const std::string& path, Map& map, Change&& change) {
  constexpr int kTimes = 40;
  constexpr double kWantedBlocks = 1e6 / kBlockVoxels;
  const auto off = [](const Submap& submap) {
    return std::abs(static_cast<double>(submap.blocks().size()) - kWantedBlocks);
  };
  const Submap* subject = map.submaps()[0].get();
  for (const auto& submap : map.submaps()) {
    if (off(*submap) < off(*subject)) subject = submap.get();
  }
  const SubmapId id = subject->id();
  const std::size_t num_blocks = subject->blocks().size(), num_tiles = subject->blocks().tiles().size();
  StateMarks marks(*map.published());
  const std::int64_t bytes_before = UsedBytes(path);
  std::vector<double> times_ms, cpu_ms;
  for (int n = 0; n < kTimes; ++n) {
    const auto begin = Clock::now();
    const double cpu_begin_s = bench::ProcessCpu_s();
    change(map, id, n);
    const auto after = map.Publish(n);
    Must(store.Commit(marks, *after, Durability::kFull));
    times_ms.push_back(1e3 * SecondsSince(begin));
    cpu_ms.push_back(1e3 * (bench::ProcessCpu_s() - cpu_begin_s));
    marks = StateMarks(*after, &marks);
  }
  std::sort(times_ms.begin(), times_ms.end());
  std::sort(cpu_ms.begin(), cpu_ms.end());
  const double bytes = static_cast<double>(UsedBytes(path) - bytes_before) / kTimes;
  std::printf(
      "%s of %.2f M voxels in %zu tiles: durable in %.1f ms (median of %d; slowest %.1f), CPU %.1f ms; "
      "%.0f B on disk, %.1f a tile\n",
      what, static_cast<double>(num_blocks) * kBlockVoxels / 1e6, num_tiles, times_ms[kTimes / 2], kTimes,
      times_ms.back(), cpu_ms[kTimes / 2], bytes, bytes / static_cast<double>(num_tiles));
}

int Run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: dhpmap_storage_bench DATASET [predicted|groundtruth|none] [FRAMES] [DATABASE]\n");
    return 2;
  }
  const LabelSource labels = Must(ParseLabelSource(argc > 2 ? argv[2] : "groundtruth"));
  const auto dataset = Must(OpenDataset(argv[1], kAnyFormat, labels));
  const std::size_t num_frames =
      std::min(dataset->num_frames(), static_cast<std::size_t>(argc > 3 ? std::atoi(argv[3]) : 1 << 20));
  const testing::TempDir folder;
  const std::string path = argc > 4 ? argv[4] : (folder.path() / "bench.db").string();
  auto store = Must(OpenSqliteStore(path));

  MapInfo info;
  info.name = "bench";
  Must(ApplyPreset(dataset->preset(), info.config));
  info.label_set = std::make_shared<const LabelSet>(Must(LabelSet::Create(dataset->label_classes())));
  MapBuilder builder(info, 0);
  auto committed = builder.map().Publish(0);
  Must(store->CreateMap(*committed));
  StateMarks marks(*committed);

  double fuse_s = 0, commit_s = 0, commit_cpu_s = 0, slowest_commit_s = 0;
  std::size_t num_written = 0;
  Written written;
  for (std::size_t f = 0; f < num_frames; ++f) {
    const PanopticFrame frame = Must(DecodeFrame(Must(dataset->Read(f)), dataset->has_persistent_ids()));
    auto begin = Clock::now();
    Must(builder.Integrate(frame));
    fuse_s += SecondsSince(begin);
    const auto after = builder.map().Publish(static_cast<std::int64_t>(f));
    for (const SubmapChange& change : DiffSnapshots(committed.get(), *after)) {
      num_written += change.written_tsdf.size() + change.written_labels.size();
    }
    constexpr std::size_t kCountEvery = 3;
    if (f % kCountEvery == 0) Count(*committed, *after, written);
    begin = Clock::now();
    const double cpu_begin_s = bench::ProcessCpu_s();
    Must(store->Commit(marks, *after, Durability::kNormal));
    marks = StateMarks(*after, &marks);  // as CommitWorker
    commit_cpu_s += bench::ProcessCpu_s() - cpu_begin_s;
    const double seconds = SecondsSince(begin);
    commit_s += seconds;
    slowest_commit_s = std::max(slowest_commit_s, seconds);
    committed = after;
  }
  const auto frames = static_cast<double>(num_frames);
  std::printf(
      "%zu frames: fusion %.1f ms, commit %.1f ms a frame (slowest %.1f, CPU %.1f), %.0f layer blocks a commit, CPU "
      "%.1f us a block\n",
      num_frames, 1e3 * fuse_s / frames, 1e3 * commit_s / frames, 1e3 * slowest_commit_s, 1e3 * commit_cpu_s / frames,
      static_cast<double>(num_written) / frames, 1e6 * commit_cpu_s / static_cast<double>(num_written));

  std::printf(
      "written: %.1f MB of blocks that changed; %.2f times that in cubes of 2^3 blocks, %.2f times in tiles of 4^3\n",
      static_cast<double>(written.block_bytes) / 1e6, written.Amplification(written.cube_bytes),
      written.Amplification(written.tile_bytes));
  MeasureCodecs(*committed);
  const StoredMap stored = Must(store->GetMap("bench"));
  std::size_t memory_bytes = 0;
  for (const auto& submap : committed->submaps()) memory_bytes += submap->MemoryBytes();
  auto begin = Clock::now();
  const double load_cpu_begin_s = bench::ProcessCpu_s();
  const auto loaded = Must(store->LoadMap("bench"));
  const double load_s = SecondsSince(begin), load_cpu_s = bench::ProcessCpu_s() - load_cpu_begin_s;

  // The same map once more, in one commit.
  MapInfo copy_info = committed->info();
  copy_info.name = "copy";
  begin = Clock::now();
  const double save_cpu_begin_s = bench::ProcessCpu_s();
  Must(store->CreateMap(
      MapSnapshot(copy_info, committed->submaps(), committed->free_space(), VacatedSpace{committed->vacated()})));
  const double save_s = SecondsSince(begin), save_cpu_s = bench::ProcessCpu_s() - save_cpu_begin_s;
  begin = Clock::now();
  Must(store->DeleteMap("copy"));
  const double delete_s = SecondsSince(begin);
  std::int64_t num_blocks = 0;
  for (const auto& submap : committed->submaps()) num_blocks += static_cast<std::int64_t>(submap->blocks().size());
  const double used = static_cast<double>(UsedBytes(path));
  std::printf("%.1f MB in use in the file, %.3f B an allocated voxel\n", used / 1e6,
              used / static_cast<double>(num_blocks) / kBlockVoxels);
  Map& map = builder.map();
  MeasureEdit("move", *store, path, map, [](Map& edited, SubmapId id, int n) {
    edited.FindMutable(id)->mutable_info().T_map_submap.translation().x() = 0.01 * n;
  });
  MeasureEdit("clone", *store, path, map, [](Map& edited, SubmapId id, int) { edited.Clone(id); });
  store = nullptr;
  const double mb = static_cast<double>(memory_bytes) / 1e6;
  std::printf(
      "map: %lld submaps, %.1f MB in memory, %.1f MB of blobs; save %.0f MB/s (CPU %.0f), load %.0f MB/s (CPU %.0f), "
      "delete %.0f ms\n",
      static_cast<long long>(stored.num_submaps), mb, static_cast<double>(stored.blob_bytes) / 1e6, mb / save_s,
      mb / save_cpu_s, mb / load_s, mb / load_cpu_s, 1e3 * delete_s);
  std::printf("database file %.1f MB\n", static_cast<double>(std::filesystem::file_size(path)) / 1e6);
  return 0;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) { return dhpmap::Run(argc, argv); }
