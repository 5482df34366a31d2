// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/voxel_journal.h"

namespace dhpmap {

void VoxelJournal::TakeBack() noexcept {
  while (num_voxels_ > 0) {  // backwards: the first note of a voxel holds its old value
    const Voxel& voxel = voxels_[--num_voxels_];
    TsdfBlock& block = *blocks_[voxel.place / kBlockVoxels];
    const std::size_t linear = voxel.place % kBlockVoxels;
    block.distance_m[linear] = voxel.distance_m;
    block.weight[linear] = voxel.weight;
    block.color[linear] = voxel.color;
  }
  while (num_labels_ > 0) {
    const std::uint32_t place = labels_[--num_labels_];
    label_blocks_[place / kBlockVoxels]->TakeBack(static_cast<int>(place % kBlockVoxels));
  }
  Forget();
}

void VoxelJournal::Forget() noexcept {
  num_voxels_ = num_labels_ = 0;
  blocks_.clear();
  label_blocks_.clear();
}

std::span<VoxelJournal> FrameJournal::OfSubmaps(std::size_t count) {
  if (journals_.size() < count) journals_.resize(count);
  return std::span(journals_).first(count);
}

void FrameJournal::TakeBack() noexcept {
  for (VoxelJournal& journal : journals_) journal.TakeBack();
}

void FrameJournal::Forget() noexcept {
  std::size_t bytes = CapacityBytes(journals_);
  for (VoxelJournal& journal : journals_) {
    journal.Forget();
    bytes += journal.BufferBytes();
  }
  counted_.Set(bytes);
}

void FrameJournal::GiveBuffersBack() noexcept {
  journals_ = std::vector<VoxelJournal>();
  counted_.Set(0);
}

}  // namespace dhpmap
