// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/retrieval.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <memory>
#include <thread>

#include "mapping/map/map.h"

namespace dhpmap::evaluator {
namespace {

constexpr int kNumOthers = 100;
constexpr std::uint32_t kObject = 1;  // the first submap that a map creates

struct RetrievedVoxel {
  VoxelIndex index;
  float distance_m = 0;
  float weight = 0;
  Color color;
};

struct FlatBlock {
  BlockIndex index;
  TsdfBlock tsdf;
  std::array<std::uint32_t, kBlockVoxels> instance{};
};

std::int64_t NumBlocks(std::int64_t num_voxels) { return (num_voxels + kBlockVoxels - 1) / kBlockVoxels; }

/// Position of the i-th block of a scene: rows of a slab.
BlockIndex PlaceOf(std::int64_t i) {
  constexpr std::int64_t kSide = 512;
  return {static_cast<std::int32_t>(i % kSide), static_cast<std::int32_t>(i / kSide % kSide),
          static_cast<std::int32_t>(i / (kSide * kSide))};
}

/// The i-th block of a scene. The last block of the object and of the rest may be partly filled.
struct BlockPlan {
  bool is_object = false;
  std::int64_t rank = 0;  ///< among the blocks of the object, or among the others
  int num_voxels = 0;
};

class ScenePlan {
 public:
  explicit ScenePlan(const RetrievalScene& scene)
      : num_object_(scene.num_object_voxels),
        num_rest_(scene.num_voxels - scene.num_object_voxels),
        num_object_blocks_(NumBlocks(num_object_)),
        num_blocks_(num_object_blocks_ + NumBlocks(num_rest_)) {}

  [[nodiscard]] std::int64_t num_blocks() const { return num_blocks_; }

  /// Spreads the object's blocks evenly over all blocks.
  [[nodiscard]] BlockPlan At(std::int64_t i) const {
    const std::int64_t before = i * num_object_blocks_ / num_blocks_;
    const bool is_object = (i + 1) * num_object_blocks_ / num_blocks_ > before;
    const std::int64_t rank = is_object ? before : i - before;
    const std::int64_t left = (is_object ? num_object_ : num_rest_) - rank * kBlockVoxels;
    return {is_object, rank, static_cast<int>(std::min<std::int64_t>(left, kBlockVoxels))};
  }

 private:
  std::int64_t num_object_, num_rest_, num_object_blocks_, num_blocks_;
};

void Fill(int num_voxels, TsdfBlock& tsdf) {
  for (int v = 0; v < num_voxels; ++v) {
    tsdf.distance_m[v] = 0.001f * static_cast<float>(v % 80);
    tsdf.weight[v] = 1.0f;
    tsdf.color[v] = {100, static_cast<std::uint8_t>(v & 0xff), 50};
  }
}

RetrievedVoxel Copy(BlockIndex index, const TsdfBlock& tsdf, int v) {
  return {VoxelIn(index, v), tsdf.distance_m[v], tsdf.weight[v], tsdf.color[v]};
}

template <typename Work>
double Median_s(int num_runs, const Work& work) {
  std::vector<double> times_s;
  for (int run = 0; run < num_runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times_s.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times_s.begin(), times_s.end());
  return times_s[times_s.size() / 2];
}

void MeasureFlat(const ScenePlan& plan, int num_runs, std::vector<RetrievedVoxel>& copied, RetrievalTimes& times) {
  std::vector<std::unique_ptr<FlatBlock>> blocks;
  for (std::int64_t i = 0; i < plan.num_blocks(); ++i) {
    const BlockPlan block = plan.At(i);
    blocks.push_back(std::make_unique<FlatBlock>());
    blocks.back()->index = PlaceOf(i);
    Fill(block.num_voxels, blocks.back()->tsdf);
    const std::uint32_t instance =
        block.is_object ? kObject : kObject + 1 + static_cast<std::uint32_t>(block.rank % kNumOthers);
    blocks.back()->instance.fill(instance);
  }
  times.flat_bytes = blocks.size() * (sizeof(FlatBlock) + sizeof(blocks[0]));
  times.traversal_s = Median_s(num_runs, [&] {
    copied.clear();
    for (const auto& block : blocks) {
      for (int v = 0; v < kBlockVoxels; ++v) {
        if (block->instance[static_cast<std::size_t>(v)] != kObject || !block->tsdf.IsObserved(v)) continue;
        copied.push_back(Copy(block->index, block->tsdf, v));
      }
    }
  });
}

void MeasureMap(const ScenePlan& plan, int num_runs, std::vector<RetrievedVoxel>& copied, RetrievalTimes& times) {
  Map map{MapInfo{}};
  for (int s = 0; s <= kNumOthers; ++s) map.Create({});
  for (std::int64_t i = 0; i < plan.num_blocks(); ++i) {
    const BlockPlan block = plan.At(i);
    const SubmapId id(block.is_object ? kObject : kObject + 1 + static_cast<std::uint32_t>(block.rank % kNumOthers));
    Fill(block.num_voxels, map.FindMutable(id)->MutableTsdf(PlaceOf(i)));
  }
  const std::shared_ptr<const MapSnapshot> snapshot = map.Publish(0);
  for (const auto& submap : snapshot->submaps()) times.map_bytes += submap->MemoryBytes();

  // One look-up is shorter than the clock's resolution.
  constexpr int kLookups = 1000;
  std::size_t num_blocks = 0;
  times.find_s = Median_s(num_runs,
                          [&] {
                            for (int n = 0; n < kLookups; ++n) {
                              num_blocks += snapshot->Find(SubmapId(kObject))->blocks().size();
                              asm volatile("" : "+r"(num_blocks));  // prevents merging of the look-ups
                            }
                          }) /
                 kLookups;
  times.copy_s = Median_s(num_runs, [&] {
    copied.clear();
    for (const BlockEntry& entry : snapshot->Find(SubmapId(kObject))->blocks().entries()) {
      for (int v = 0; v < kBlockVoxels; ++v) {
        if (entry.tsdf->IsObserved(v)) copied.push_back(Copy(entry.index, *entry.tsdf, v));
      }
    }
  });
}

}  // namespace

std::vector<RetrievalScene> PaperScenes() { return {{4'099'223, 61'745, 21.0}, {82'529'555, 22'842'416, 628.0}}; }

RetrievalTimes MeasureRetrieval(const RetrievalScene& scene, int num_runs) {
  RetrievalTimes times;
  times.scene = scene;
  const ScenePlan plan(scene);
  std::vector<RetrievedVoxel> copied;
  copied.reserve(static_cast<std::size_t>(scene.num_object_voxels));
  MeasureFlat(plan, num_runs, copied, times);
  times.num_copied = static_cast<std::int64_t>(copied.size());
  MeasureMap(plan, num_runs, copied, times);
  if (times.num_copied != static_cast<std::int64_t>(copied.size())) times.num_copied = -1;
  return times;
}

std::string ProcessorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) != 0 || line.find(':') == std::string::npos) continue;
    return line.substr(std::min(line.size(), line.find(':') + 2)) + ", " +
           std::to_string(std::thread::hardware_concurrency()) + " cores";
  }
  return std::to_string(std::thread::hardware_concurrency()) + " cores";
}

}  // namespace dhpmap::evaluator
