// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/voxel_merge.h"

#include <vector>

namespace dhpmap {
namespace {

/// From the view of a voxel that `holder` holds to that of everybody.
std::vector<SubmapCount> OfSubmaps(const std::vector<InstanceCount>& seen, SubmapId holder) {
  std::vector<SubmapCount> own, others;
  for (const InstanceCount& entry : seen) {
    (entry.id.IsOwn() ? own : others).push_back({entry.id.In(holder), entry.count});
  }
  return SumCounts(own, others);
}

/// And back.
std::vector<InstanceCount> AsSeenIn(SubmapId holder, const std::vector<SubmapCount>& counts) {
  std::vector<InstanceCount> own, others;
  for (const SubmapCount& entry : counts) {
    const auto instance = SeenInstance::Of(entry.id, holder);
    (instance.IsOwn() ? own : others).push_back({instance, entry.count});
  }
  return SumCounts(own, others);
}

}  // namespace

void Accumulate(const BlockEntry& block, SubmapId holder, int linear, MergedVoxel& merged) {
  if (merged.num_holders++ == 0 || merged.first_holder == kUnknownSubmap) merged.first_holder = holder;
  merged.tsdf.Add(*block.tsdf, static_cast<std::size_t>(linear));
  if (block.labels == nullptr || block.labels->IsEmpty(linear)) return;
  const LabelHistograms seen = block.labels->Get(linear);
  merged.classes = SumCounts(merged.classes, seen.classes);
  merged.instances = SumCounts(merged.instances, OfSubmaps(seen.instances, holder));
}

void Store(const MergedVoxel& merged, SubmapId owner, int linear, TsdfBlock& tsdf, LabelBlock& labels) {
  merged.tsdf.Store(tsdf, static_cast<std::size_t>(linear));
  labels.Set(linear, {.classes = merged.classes, .instances = AsSeenIn(owner, merged.instances)});
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
    if (!labels.BestInstance(i).id.IsOwn() && !labels.IsConcluded(i)) return true;
  }
  return false;
}

}  // namespace dhpmap
