// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/memory_count.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// The old values of voxels that a frame overwrote in place (Submap::BlockInPlace), to restore them if the frame fails.
/// Keeps its buffers. Thread-compatible; threads that write different submaps have one each.
class alignas(kCacheLineBytes) VoxelJournal {
 public:
  /// The block number of a layer that is written without notes.
  static constexpr std::uint32_t kNoNotes = 0;
  /// Largest number of notes for one observation of a voxel.
  static constexpr std::size_t kMostNotes = 2;

  /// Whether it can record another block.
  [[nodiscard]] bool TakesBlocks() const { return std::max(blocks_.size(), label_blocks_.size()) < kMostBlocks; }
  /// The number under which a block's voxels are noted. The block must exist until Forget or TakeBack.
  std::uint32_t NumberOf(TsdfBlock& block) {
    blocks_.push_back(&block);
    return static_cast<std::uint32_t>(blocks_.size());
  }
  std::uint32_t NumberOf(LabelBlock& block) {
    label_blocks_.push_back(&block);
    return static_cast<std::uint32_t>(label_blocks_.size());
  }

  /// Reserves room for the notes of so many observations.
  void Reserve(std::size_t num_observations) {
    const std::size_t num = num_observations * kMostNotes;
    if (num_voxels_ + num > voxels_.size()) Grow(num_voxels_ + num, voxels_);
    if (num_labels_ + num > labels_.size()) Grow(num_labels_ + num, labels_);
  }
  /// Call it before a voxel is overwritten, after Reserve.
  void Note(std::uint32_t number, std::size_t linear, const TsdfBlock& block) {
    voxels_[num_voxels_++] = {block.distance_m[linear], block.weight[linear], PlaceOf(number, linear),
                              block.color[linear]};
  }
  /// Call it after LabelBlock::AddInPlace; Reserve comes before.
  void NoteLabel(std::uint32_t number, int linear) {
    labels_[num_labels_++] = PlaceOf(number, static_cast<std::size_t>(linear));
  }

  /// Restores the old values and forgets them.
  void TakeBack() noexcept;
  /// Keeps what was written.
  void Forget() noexcept;
  [[nodiscard]] std::size_t BufferBytes() const {
    return CapacityBytes(blocks_) + CapacityBytes(label_blocks_) + CapacityBytes(voxels_) + CapacityBytes(labels_);
  }

 private:
  static constexpr std::size_t kMostBlocks = (std::size_t{1} << 32) / kBlockVoxels;
  struct Voxel {
    float distance_m, weight;
    std::uint32_t place;
    Color color;
  };

  static std::uint32_t PlaceOf(std::uint32_t number, std::size_t linear) {
    return (number - 1) * kBlockVoxels + static_cast<std::uint32_t>(linear);
  }
  template <typename Item>
  static void Grow(std::size_t least, std::vector<Item>& items) {
    items.resize(std::max(least, 2 * items.size()));
  }

  std::vector<TsdfBlock*> blocks_;
  std::vector<LabelBlock*> label_blocks_;
  std::vector<Voxel> voxels_;          ///< the first num_voxels_ are notes
  std::vector<std::uint32_t> labels_;  ///< likewise
  std::size_t num_voxels_ = 0, num_labels_ = 0;
};

/// The journals of a frame, one for each submap that it is fused into. Their buffers count as MemoryKind::kFusion.
/// Thread-compatible.
class FrameJournal {
 public:
  /// Requires that all are forgotten. The order is that of the submaps by size, so that buffers fit the next frame.
  std::span<VoxelJournal> OfSubmaps(std::size_t count);
  void TakeBack() noexcept;
  void Forget() noexcept;
  /// Call it after Forget or TakeBack.
  void GiveBuffersBack() noexcept;

 private:
  std::vector<VoxelJournal> journals_;
  CountedBytes counted_{MemoryKind::kFusion};  ///< size of the buffers after the last frame
};

}  // namespace dhpmap
