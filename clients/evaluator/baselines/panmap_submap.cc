// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/panmap_submap.h"

namespace dhpmap::evaluator {
namespace {

constexpr int kMaxCount = 255;

}  // namespace

void BelongingBlock::Set(std::size_t linear, int belongs, int foreign) {
  while (belongs > kMaxCount || foreign > kMaxCount) {
    belongs /= 2;
    foreign /= 2;
  }
  belongs_[linear] = static_cast<std::uint8_t>(belongs);
  foreign_[linear] = static_cast<std::uint8_t>(foreign);
}

void BelongingBlock::Add(std::size_t linear, bool belongs) {
  Set(linear, belongs_[linear] + (belongs ? 1 : 0), foreign_[linear] + (belongs ? 0 : 1));
}

void BelongingBlock::Add(std::size_t linear, const BelongingBlock& other) {
  Set(linear, belongs_[linear] + other.belongs_[linear], foreign_[linear] + other.foreign_[linear]);
}

bool PanmapSubmap::Belongs(VoxelIndex voxel) const {
  const auto it = belonging.find(BlockOf(voxel));
  return it == belonging.end() || it->second.Belongs(static_cast<std::size_t>(LinearIndex(voxel)));
}

Submap PanmapSubmap::OwnGeometry() const {
  Submap own = geometry;
  own.ShareBlocks();  // so that blocks are copied before a write
  std::vector<BlockIndex> blocks;
  for (const BlockEntry& entry : geometry.blocks().entries()) blocks.push_back(entry.index);
  for (const BlockIndex block : blocks) {
    const auto it = belonging.find(block);
    if (it == belonging.end()) continue;
    TsdfBlock& tsdf = own.MutableTsdf(block);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if (!it->second.Belongs(i)) tsdf.weight[i] = 0;
    }
  }
  return own;
}

float PanmapSubmap::Confidence() const {
  std::int64_t num_belonging = 0, num_all = 0;
  for (const auto& [index, block] : belonging) {
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      num_belonging += block.NumBelonging(i);
      num_all += block.NumBelonging(i) + block.NumForeign(i);
    }
  }
  return num_all == 0 ? 1.0f : static_cast<float>(static_cast<double>(num_belonging) / static_cast<double>(num_all));
}

}  // namespace dhpmap::evaluator
