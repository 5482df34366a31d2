// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/voxel_transfer.h"

#include <memory>
#include <utility>

namespace dhpmap {
namespace {

/// Whether the block has data at other voxels.
bool IsMoreThan(const std::bitset<kBlockVoxels>& voxels, const BlockEntry& entry) {
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (!voxels[static_cast<std::size_t>(i)] && HasVoxel(entry, i)) return true;
  }
  return false;
}

template <typename Visitor>
void VisitVoxels(const std::bitset<kBlockVoxels>& voxels, Visitor&& visit) {
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (voxels[static_cast<std::size_t>(i)]) visit(i);
  }
}

void CopyVoxels(const BlockEntry& from, const std::bitset<kBlockVoxels>& voxels, Submap& to) {
  if (from.tsdf != nullptr) {
    TsdfBlock& tsdf = to.MutableTsdf(from.index);
    VisitVoxels(voxels, [&](int linear) {
      const auto i = static_cast<std::size_t>(linear);
      tsdf.distance_m[i] = from.tsdf->distance_m[i];
      tsdf.weight[i] = from.tsdf->weight[i];
      tsdf.color[i] = from.tsdf->color[i];
    });
  }
  if (from.labels != nullptr) {
    LabelBlock& labels = to.MutableLabels(from.index);
    VisitVoxels(voxels, [&](int linear) {
      labels.Set(linear, from.labels->Get(linear));
      labels.SetConcluded(linear, from.labels->IsConcluded(linear));
    });
  }
  if (from.gone == nullptr) return;
  const BlockEntry* known = to.blocks().Find(from.index);
  GoneBlock gone = known != nullptr && known->gone != nullptr ? *known->gone : GoneBlock({}, {}, from.gone->last());
  VisitVoxels(voxels, [&](int linear) { gone.Set(linear, from.gone->Count(linear)); });
  if (!gone.empty()) to.PutGone(from.index, std::make_shared<const GoneBlock>(gone));
}

void EraseFromBlock(const std::bitset<kBlockVoxels>& voxels, const BlockEntry& entry, Submap& from) {
  if (entry.tsdf != nullptr) {
    TsdfBlock& tsdf = from.MutableTsdf(entry.index);
    VisitVoxels(voxels, [&](int linear) {
      const auto i = static_cast<std::size_t>(linear);
      tsdf.distance_m[i] = 0;
      tsdf.weight[i] = 0;
      tsdf.color[i] = {};
    });
  }
  if (entry.labels != nullptr) {
    LabelBlock& labels = from.MutableLabels(entry.index);
    VisitVoxels(voxels, [&](int linear) { labels.Clear(linear); });
  }
  if (entry.gone == nullptr) return;
  GoneBlock gone = *entry.gone;
  VisitVoxels(voxels, [&](int linear) { gone.Forget(linear); });
  from.PutGone(entry.index, gone.empty() ? nullptr : std::make_shared<const GoneBlock>(gone));
}

}  // namespace

bool HasVoxel(const BlockEntry& entry, int linear) {
  return (entry.tsdf != nullptr && entry.tsdf->IsObserved(linear)) ||
         (entry.labels != nullptr && !entry.labels->IsEmpty(linear));
}

void EraseVoxels(const VoxelSet& voxels, Submap& from) {
  for (const auto& [index, of_block] : voxels) {
    const BlockEntry* found = from.blocks().Find(index);
    if (found == nullptr) continue;
    const BlockEntry entry = *found;  // a copy, because the table may move its entries
    if (IsMoreThan(of_block, entry)) EraseFromBlock(of_block, entry, from);
    else from.EraseBlock(index);
  }
}

void MoveVoxels(const VoxelSet& voxels, Submap& from, Submap& to) {
  for (const auto& [index, of_block] : voxels) {
    const BlockEntry* found = from.blocks().Find(index);
    if (found == nullptr) continue;
    const BlockEntry entry = *found;
    if (IsMoreThan(of_block, entry) || to.blocks().Find(index) != nullptr) {
      CopyVoxels(entry, of_block, to);
      if (IsMoreThan(of_block, entry)) EraseFromBlock(of_block, entry, from);
      else from.EraseBlock(index);
    } else {
      to.PutBlock(index, entry.tsdf, entry.labels);
      to.PutGone(index, entry.gone);
      from.EraseBlock(index);
    }
  }
}

}  // namespace dhpmap
