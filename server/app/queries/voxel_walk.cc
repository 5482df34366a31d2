// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/voxel_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/app/states/no_such_submap.h"

namespace dhpmap {

Result<VoxelWalk> VoxelWalk::Begin(std::shared_ptr<const MapSnapshot> snapshot, SubmapId submap,
                                   double max_abs_distance_m, Spread spread) {
  if (!std::isfinite(max_abs_distance_m) || max_abs_distance_m < 0) {
    return InvalidArgument("max_abs_distance_m is not usable")
        .WithReason("BAD_DISTANCE")
        .WithViolation("max_abs_tsdf_m", "must be finite and 0 or more");
  }
  const Submap* found = snapshot->Find(submap);
  if (found == nullptr) return NoSuchSubmap(snapshot->info(), submap);
  return VoxelWalk(std::move(snapshot), *found, max_abs_distance_m, std::move(spread));
}

VoxelWalk::VoxelWalk(std::shared_ptr<const MapSnapshot> snapshot, const Submap& submap, double max_abs_distance_m,
                     Spread spread)
    : snapshot_(std::move(snapshot)),
      submap_(&submap),
      max_abs_distance_m_(max_abs_distance_m),
      spread_(std::move(spread)) {}

void VoxelWalk::ReadAhead() {
  constexpr std::size_t kTilesAhead = 2;  // not covered by a budget: 1.3 MB if full
  const auto tiles = submap_->blocks().tiles().subspan(tile_);
  std::vector<std::shared_ptr<const ScannedTile>> scanned(std::min(tiles.size(), kTilesAhead));
  spread_(scanned.size(), [&](std::size_t i) { scanned[i] = std::make_shared<const ScannedTile>(*tiles[i].tile); });
  scanned_.assign(scanned.begin(), scanned.end());
}

BlockEntry VoxelWalk::Next() {
  if (scanned_.empty()) ReadAhead();
  const ScannedTile& scanned = *scanned_.front();
  BlockEntry block = scanned.entries()[block_++];
  if (block_ == scanned.entries().size()) {
    scanned_.pop_front();
    block_ = 0;
    ++tile_;
  }
  return block;
}

std::span<const ObservedVoxel> VoxelWalk::NextBlock() {
  voxels_.clear();
  const BlockEntry block = Next();
  if (block.tsdf == nullptr) return voxels_;
  const TsdfBlock& tsdf = *block.tsdf;
  const SubmapInfo& info = submap_->info();
  const std::int32_t own_class = info.panoptic == Panoptic::kUnknown ? -1 : info.class_id.value;
  for (int i = 0; i < kBlockVoxels; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!block.Shows(i)) continue;
    if (max_abs_distance_m_ > 0 && std::abs(tsdf.distance_m[at]) > max_abs_distance_m_) continue;
    const BestLabel label = block.labels ? block.labels->BestClass(i) : BestLabel{};
    voxels_.push_back({.centre_m = info.T_map_submap * VoxelCentre(VoxelIn(block.index, i), info.voxel_size_m),
                       .distance_m = tsdf.distance_m[at],
                       .weight = tsdf.weight[at],
                       .color = tsdf.color[at],
                       .class_id = label.count > 0 ? static_cast<std::int32_t>(label.id) : own_class,
                       .class_confidence = label.share});
  }
  return voxels_;
}

}  // namespace dhpmap
