// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/submap_labels.h"

#include <algorithm>
#include <vector>

namespace dhpmap {
namespace {

std::int64_t NumObservedVoxels(const Submap& submap) {
  std::int64_t count = 0;
  for (const BlockEntry& entry : submap.blocks().entries()) count += entry.tsdf ? entry.tsdf->NumObservedVoxels() : 0;
  return count;
}

/// How often an average voxel was observed, at least once.
std::uint32_t AverageObservations(const Submap& submap) {
  std::uint64_t total = 0;
  for (const ClassTotal& entry : submap.info().class_counts) total += entry.count;
  const auto num_voxels = static_cast<std::uint64_t>(std::max<std::int64_t>(1, NumObservedVoxels(submap)));
  return static_cast<std::uint32_t>(std::max<std::uint64_t>(1, total / num_voxels));
}

}  // namespace

void RecomputeSubmapLabels(Submap& submap) {
  SubmapInfo& info = submap.mutable_info();
  if (info.panoptic == Panoptic::kUnknown) return;
  LabelTotals totals;
  for (const TileEntry& tile : submap.blocks().tiles()) tile.tile->AddLabelsTo(totals);
  if (totals.instances == 0) return;
  info.class_counts.clear();
  for (std::size_t id = 0; id < totals.classes.size(); ++id) {
    if (totals.classes[id] == 0) continue;
    submap.AddClassObservations(ClassId(static_cast<std::uint16_t>(id)), totals.classes[id]);
  }
  info.instance_confidence =
      static_cast<float>(static_cast<double>(totals.own) / static_cast<double>(totals.instances));
}

int RestoreDroppedLabels(Submap& submap) {
  if (submap.info().panoptic == Panoptic::kUnknown) return 0;
  std::vector<BlockIndex> without;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    if (entry.tsdf && !entry.labels) without.push_back(entry.index);
  }
  if (without.empty()) return 0;
  const std::uint32_t count = AverageObservations(submap);
  const LabelHistograms label{.classes = {{submap.info().class_id.value, count}}, .instances = {{kOwnInstance, count}}};
  for (const BlockIndex index : without) {
    LabelBlock& labels = submap.MutableLabels(index);
    const TsdfBlock& tsdf = *submap.blocks().Find(index)->tsdf;
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (tsdf.IsObserved(i)) labels.Set(i, label);
    }
  }
  return static_cast<int>(without.size());
}

}  // namespace dhpmap
