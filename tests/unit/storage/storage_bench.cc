// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_storage_bench DATASET [predicted|groundtruth|none] [FRAMES] [DATABASE]: maps a data set in process, commits
// after every frame as a server does, and reports sizes and rates of codec and store.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "clients/datasets/dataset.h"
#include "mapping/pipeline/map_builder.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "storage/store.h"
#include "tests/bench/cpu_time.h"
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

void Report(const char* what, std::size_t num_blocks, std::size_t num_voxels, std::size_t bytes, std::size_t raw_bytes,
            double encode_s, double decode_s) {
  const auto blocks = static_cast<double>(num_blocks);
  std::printf(
      "%-6s %7zu blocks %7.1f B/block %6.3f B/voxel %6.2f B/seen voxel  encode %5.1f us %6.0f MB/s  decode %5.1f us "
      "%6.0f MB/s\n",
      what, num_blocks, static_cast<double>(bytes) / blocks, static_cast<double>(bytes) / blocks / kBlockVoxels,
      static_cast<double>(bytes) / static_cast<double>(num_voxels), 1e6 * encode_s / blocks,
      static_cast<double>(raw_bytes) / encode_s / 1e6, 1e6 * decode_s / blocks,
      static_cast<double>(raw_bytes) / decode_s / 1e6);
}

/// One thread; rates are of the blocks as they are in memory.
void MeasureCodecs(const MapSnapshot& map) {
  std::size_t num_tsdf = 0, num_observed = 0, tsdf_bytes = 0, num_labels = 0, num_labelled = 0, label_bytes = 0,
              label_raw = 0;
  double tsdf_encode_s = 0, tsdf_decode_s = 0, label_encode_s = 0, label_decode_s = 0;
  TsdfBlock tsdf;
  LabelBlock labels;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf) {
        double begin = bench::ThreadCpu_s();
        const Bytes blob = EncodeTsdfBlock(*entry.tsdf, entry.index, submap->info().truncation_m);
        tsdf_encode_s += bench::ThreadCpu_s() - begin;
        begin = bench::ThreadCpu_s();
        Must(DecodeTsdfBlock(blob, entry.index, tsdf));
        tsdf_decode_s += bench::ThreadCpu_s() - begin;
        ++num_tsdf, tsdf_bytes += blob.size();
        num_observed += static_cast<std::size_t>(entry.tsdf->NumObservedVoxels());
      }
      if (entry.labels) {
        double begin = bench::ThreadCpu_s();
        const Bytes blob = EncodeLabelBlock(*entry.labels, entry.index);
        label_encode_s += bench::ThreadCpu_s() - begin;
        begin = bench::ThreadCpu_s();
        Must(DecodeLabelBlock(blob, entry.index, labels));
        label_decode_s += bench::ThreadCpu_s() - begin;
        ++num_labels, label_bytes += blob.size(), label_raw += entry.labels->MemoryBytes();
        for (int i = 0; i < kBlockVoxels; ++i) num_labelled += !entry.labels->IsEmpty(i);
      }
    }
  }
  Report("tsdf", num_tsdf, num_observed, tsdf_bytes, num_tsdf * sizeof(TsdfBlock), tsdf_encode_s, tsdf_decode_s);
  if (num_labels > 0) {
    Report("labels", num_labels, num_labelled, label_bytes, label_raw, label_encode_s, label_decode_s);
  }
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
  for (std::size_t f = 0; f < num_frames; ++f) {
    const PanopticFrame frame = Must(DecodeFrame(Must(dataset->Read(f)), dataset->has_persistent_ids()));
    auto begin = Clock::now();
    Must(builder.Integrate(frame));
    fuse_s += SecondsSince(begin);
    const auto after = builder.map().Publish(static_cast<std::int64_t>(f));
    for (const SubmapChange& change : DiffSnapshots(committed.get(), *after)) {
      num_written += change.written_tsdf.size() + change.written_labels.size();
    }
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
  Must(store->CreateMap(MapSnapshot(copy_info, committed->submaps(), committed->free_space(), committed->vacated())));
  const double save_s = SecondsSince(begin), save_cpu_s = bench::ProcessCpu_s() - save_cpu_begin_s;
  begin = Clock::now();
  Must(store->DeleteMap("copy"));
  const double delete_s = SecondsSince(begin);
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
