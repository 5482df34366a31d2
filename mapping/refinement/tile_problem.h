// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mapping/base/index_map.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/crf/dense_crf.h"
#include "mapping/crf/label_channels.h"
#include "mapping/evidence/known_instances.h"
#include "mapping/refinement/crf_tiles.h"

namespace dhpmap {

/// One tile as a CRF problem: its labelled voxels, and the instances that are possible at each. Thread-compatible.
class TileProblem {
 public:
  /// A voxel that takes part: where it is stored.
  struct Member {
    std::uint32_t block;  ///< of CollectBlocks
    std::uint32_t place;  ///< block index, numbered within the tile
    std::uint16_t linear;
  };

  /// `rim`: blocks, as the tile was cut. All must outlive the problem.
  TileProblem(std::span<const HeldBlock> blocks, const KnownInstances& known, const CrfTile& tile, int rim,
              double voxel_size_m);

  [[nodiscard]] const ScratchVector<Member>& members() const { return members_; }
  /// The first members; the others are the rim.
  [[nodiscard]] std::size_t num_inner() const { return num_inner_; }
  [[nodiscard]] std::size_t num_places() const { return places_.size(); }
  /// kNone of IndexMap if it is not in the tile.
  [[nodiscard]] std::uint32_t PlaceAt(BlockIndex index) const { return place_numbers_.Find(index); }
  [[nodiscard]] BlockIndex IndexOf(std::uint32_t place) const { return places_[place]; }
  [[nodiscard]] const LabelChannels& channels() const { return channels_; }
  [[nodiscard]] double voxel_size_m() const { return voxel_size_m_; }
  [[nodiscard]] const HeldBlock& BlockOf(const Member& member) const { return blocks_[member.block]; }

  /// The members as the CRF sees them, against the corner of the tile's first block.
  [[nodiscard]] ScratchVector<CrfPoint> Points() const;

  /// Calls visit(channel, count) for the instances that a member has seen and may be.
  template <typename Visitor>
  void VisitSeen(const Member& member, Visitor&& visit) const {
    const HeldBlock& block = blocks_[member.block];
    known_.Visit(block.holder, *block.entry->labels, member.linear,
                 [&](SubmapCount seen) { visit(channels_.ChannelOf(seen.id.value), seen.count); });
  }
  /// See KnownInstances::MostSeen.
  [[nodiscard]] SubmapId MostSeen(const Member& member) const {
    const HeldBlock& block = blocks_[member.block];
    return known_.MostSeen(block.holder, *block.entry->labels, member.linear);
  }

 private:
  void NumberPlaces(const CrfTile& tile);
  void AddMembers(std::span<const std::uint32_t> chosen);
  void AssignChannels(int rim);

  std::span<const HeldBlock> blocks_;
  const KnownInstances& known_;
  const double voxel_size_m_;
  ScratchVector<Member> members_;
  std::size_t num_inner_ = 0;
  ScratchVector<BlockIndex> places_;
  IndexMap<BlockIndex> place_numbers_;
  CountedBytes place_numbers_bytes_{MemoryKind::kRefinement};
  LabelChannels channels_;
};

}  // namespace dhpmap
