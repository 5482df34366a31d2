// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/voxel_merge.h"

#include <algorithm>

namespace dhpmap {
namespace {

constexpr std::uint32_t kOwnInstance = 0;

/// Exchanges "own" and `id`, and keeps the list sorted: from the voxel's own view to that of everybody, or back.
void Rename(std::uint32_t from, std::uint32_t to, std::vector<LabelCount>& instances) {
  const auto it =
      std::find_if(instances.begin(), instances.end(), [from](const LabelCount& entry) { return entry.id == from; });
  if (it == instances.end()) return;
  const LabelCount renamed{to, it->count};
  instances.erase(it);
  instances = SumCounts(instances, std::vector<LabelCount>{renamed});
}

}  // namespace

void ExchangeCounts(std::uint32_t a, std::uint32_t b, std::vector<LabelCount>& counts) {
  const auto count_of = [&counts](std::uint32_t id) {
    const auto it = std::find_if(counts.begin(), counts.end(), [id](const LabelCount& c) { return c.id == id; });
    return it == counts.end() ? 0u : it->count;
  };
  const std::uint32_t count_a = count_of(a), count_b = count_of(b);
  std::erase_if(counts, [a, b](const LabelCount& c) { return c.id == a || c.id == b; });
  std::vector<LabelCount> exchanged;
  if (count_b > 0) exchanged.push_back({a, count_b});
  if (count_a > 0) exchanged.push_back({b, count_a});
  std::sort(exchanged.begin(), exchanged.end(), [](LabelCount x, LabelCount y) { return x.id < y.id; });
  counts = SumCounts(counts, exchanged);
}

void Accumulate(const BlockEntry& block, SubmapId holder, int linear, MergedVoxel& merged) {
  if (merged.num_holders++ == 0 || merged.first_holder == kUnknownSubmap) merged.first_holder = holder;
  merged.tsdf.Add(*block.tsdf, static_cast<std::size_t>(linear));
  if (block.labels == nullptr || block.labels->IsEmpty(linear)) return;
  LabelHistograms histograms = block.labels->Get(linear);
  Rename(kOwnInstance, holder.value, histograms.instances);
  merged.histograms.classes = SumCounts(merged.histograms.classes, histograms.classes);
  merged.histograms.instances = SumCounts(merged.histograms.instances, histograms.instances);
}

void Store(const MergedVoxel& merged, SubmapId owner, int linear, TsdfBlock& tsdf, LabelBlock& labels) {
  merged.tsdf.Store(tsdf, static_cast<std::size_t>(linear));
  LabelHistograms histograms = merged.histograms;
  Rename(owner.value, kOwnInstance, histograms.instances);
  labels.Set(linear, histograms);
}

void Clear(int linear, TsdfBlock& tsdf, LabelBlock& labels) {
  const auto i = static_cast<std::size_t>(linear);
  tsdf.distance_m[i] = 0;
  tsdf.weight[i] = 0;
  tsdf.color[i] = {};
  labels.Clear(linear);
}

bool HasForeignVoxel(const LabelBlock& labels) {
  if (labels.NumOverflowVoxels() == 0) return false;
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (labels.BestInstance(i).id != kOwnInstance) return true;
  }
  return false;
}

}  // namespace dhpmap
