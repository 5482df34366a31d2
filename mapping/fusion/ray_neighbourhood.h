// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/cache_line.h"
#include "mapping/fusion/kept_clear_voxels.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/fusion/voxel_journal.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// The data of one submap for one block of a ray's neighbourhood.
struct Neighbour {
  TsdfBlock* tsdf = nullptr;
  LabelBlock* labels = nullptr;
  const GoneBlock* gone = nullptr;   ///< the gone counts; null: none
  const BundleCell* ends = nullptr;  ///< bundles of the same segment that end here
  const VoxelMask* clear = nullptr;  ///< voxels that are kept clear; null: none
  std::uint32_t tsdf_number = VoxelJournal::kNoNotes, labels_number = VoxelJournal::kNoNotes;
};

/// The 3 x 3 x 3 blocks around the one in which a cell's bundles end, looked up when a ray first enters them.
class RayNeighbourhood {
 public:
  /// `kept_clear` and `journal` may be null: nothing is kept clear, blocks are not written in place.
  RayNeighbourhood(const SegmentBundles& segment, bool with_labels, Submap& submap, KeptClearVoxels* kept_clear,
                   VoxelJournal* journal)
      : segment_(segment), with_labels_(with_labels), submap_(submap), kept_clear_(kept_clear), journal_(journal) {}

  void MoveTo(BlockIndex center) {
    center_ = center;
    blocks_.fill({});
    is_near_clear_ = kept_clear_ != nullptr && kept_clear_->MayBeAround(center);
  }

  /// `number`: x + 3 y + 9 z.
  Neighbour& At(int number) {
    Neighbour& neighbour = blocks_[static_cast<std::size_t>(number)];
    return neighbour.tsdf != nullptr ? neighbour : Load(IndexOf(number), neighbour);
  }
  [[nodiscard]] BlockIndex IndexOf(int number) const {
    return {center_.x + number % 3 - 1, center_.y + number / 3 % 3 - 1, center_.z + number / 9 - 1};
  }
  static constexpr int kCenter = 13;

 private:
  // Not inlined, as the loops that need it would lose registers to it: 12 % of their time.
  [[gnu::noinline]] Neighbour& Load(BlockIndex index, Neighbour& neighbour) {
    const BlockInPlace block =
        submap_.BlockInPlace(index, with_labels_, journal_ != nullptr && journal_->TakesBlocks());
    if (block.notes_tsdf) {
      Fetch(*block.tsdf);
      neighbour.tsdf_number = journal_->NumberOf(*block.tsdf);
    }
    if (block.notes_labels) {
      block.labels->Fetch();
      neighbour.labels_number = journal_->NumberOf(*block.labels);
    }
    neighbour.labels = block.labels;
    neighbour.gone = block.gone;
    neighbour.ends = segment_.Find(index);
    neighbour.clear = is_near_clear_ ? kept_clear_->In(index) : nullptr;
    neighbour.tsdf = block.tsdf;
    return neighbour;
  }

  /// Prefetches the whole block. It is not in any cache unless it was just copied, and rays access it in no order.
  static void Fetch(const TsdfBlock& block) {
    constexpr int kToWrite = 1;
    const auto* const bytes = reinterpret_cast<const char*>(&block);
    for (std::size_t at = 0; at < sizeof(TsdfBlock); at += kCacheLineBytes) __builtin_prefetch(bytes + at, kToWrite);
  }

  const SegmentBundles& segment_;
  const bool with_labels_;
  Submap& submap_;
  KeptClearVoxels* kept_clear_;
  VoxelJournal* journal_;
  bool is_near_clear_ = false;
  BlockIndex center_;
  std::array<Neighbour, 27> blocks_;
};

}  // namespace dhpmap
