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
    if (labels.BestInstance(i).id != kOwnInstance && !labels.IsConcluded(i)) return true;
  }
  return false;
}

}  // namespace dhpmap
