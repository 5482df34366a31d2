// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "mapping/submap/bounding_sphere.h"
#include "mapping/submap/kept_outline.h"
#include "mapping/submap/submap_info.h"
#include "mapping/voxels/block_table.h"
#include "mapping/voxels/part_id.h"

namespace dhpmap {

/// A block to be written in place. See Submap::BlockInPlace.
struct BlockInPlace {
  TsdfBlock* tsdf = nullptr;
  LabelBlock* labels = nullptr;                   ///< null if they were not asked for
  const GoneBlock* gone = nullptr;                ///< null: no sensor has looked through it
  bool notes_tsdf = false, notes_labels = false;  ///< a fork has the layer, too: note each write, to take it back
};

/// One object or background class: a grid of TSDF and label blocks with its own pose, panoptic label and bounding
/// sphere (paper II-A). Copying shares the blocks; the copy's owner clones a block before it first writes to it.
/// Thread-compatible.
class Submap {
 public:
  /// `generation` is the writer's current one; see BlockTable.
  Submap(SubmapInfo info, std::uint64_t generation) : info_(std::move(info)), generation_(generation) {}
  /// For a loaded map, whose tiles are read on demand; not null.
  Submap(SubmapInfo info, std::uint64_t generation, std::shared_ptr<const TableLoader> unread)
      : info_(std::move(info)), blocks_(std::move(unread)), generation_(generation) {}

  [[nodiscard]] const SubmapInfo& info() const { return info_; }
  [[nodiscard]] SubmapInfo& mutable_info() { return info_; }
  [[nodiscard]] SubmapId id() const { return info_.id; }
  [[nodiscard]] const BlockTable& blocks() const { return blocks_; }
  /// See PartId.
  [[nodiscard]] std::uint64_t part_id() const { return part_id_.value(); }

  [[nodiscard]] bool IsAbsent() const { return info_.presence == Presence::kAbsent; }

  /// In the submap frame. Tight as of the last UpdateBoundingSphere.
  [[nodiscard]] const BoundingSphere& bounding_sphere() const { return sphere_; }
  /// The same in the map frame.
  [[nodiscard]] BoundingSphere BoundingSphereInMap() const;

  /// Cached outline (FindLevelOutline); computing it visits all blocks.
  [[nodiscard]] const KeptOutline& kept_outline() const { return outline_; }

  // For writing: the returned layer belongs to this copy alone, and is allocated if absent.
  TsdfBlock& MutableTsdf(BlockIndex index);
  LabelBlock& MutableLabels(BlockIndex index);
  GoneBlock& MutableGone(BlockIndex index);
  /// The layers of a block, allocated if absent, for a writer that can take back what it wrote: a layer that only the
  /// last Map::ForkInPlace shares is not copied. Without `in_place` as MutableTsdf and MutableLabels.
  dhpmap::BlockInPlace BlockInPlace(BlockIndex index, bool with_labels, bool in_place);
  /// Puts layers in place as they are (a loaded map). Either may be null. The gone layer stays.
  void PutBlock(BlockIndex index, std::shared_ptr<const TsdfBlock> tsdf, std::shared_ptr<const LabelBlock> labels);
  /// Null: no sensor has looked through the block. Only for an existing block.
  void PutGone(BlockIndex index, std::shared_ptr<const GoneBlock> gone);
  /// Puts a tile in place as it is (a loaded map), where there is none yet. Neither null nor empty.
  void PutTile(TileIndex index, std::shared_ptr<const BlockTile> tile) {
    WritableBlocks().PutTile(index, std::move(tile));
  }
  /// See BlockTable.
  void PutLayers(TileIndex index, const BlockTile* from, const BlockLayers& layers) {
    WritableBlocks().PutLayers(index, from, layers);
  }
  /// Puts the layers of `block` in place, next to existing ones.
  void AddLayers(const BlockEntry& block);
  /// Clears the gone layer.
  void DropGone();
  bool EraseBlock(BlockIndex index) { return WritableBlocks().Erase(index, generation_); }
  /// Removes blocks without an observed voxel and without labels. Returns how many.
  int PruneBlocks();
  void DropLabels();
  /// Marks every present layer as shared: the next write to one copies it first. For clones.
  void ShareBlocks() { blocks_.ShareTiles(); }
  /// See BlockTable.
  void ForkBlocks() { blocks_.ForkTiles(); }

  /// The same submap (see part_id) with replaced tiles: see BlockTable::Replace. Null if none was replaced.
  [[nodiscard]] std::shared_ptr<const Submap> WithTiles(const OtherTile& other) const;

  /// Recomputes the sphere from the blocks: centre of their box, radius to the farthest corner of a block.
  void UpdateBoundingSphere();
  /// For a loaded map, which stores the sphere.
  void set_bounding_sphere(const BoundingSphere& sphere) { sphere_ = sphere; }

  /// Adds observations of a class and re-elects the class_id of a thing (ties: the smaller id), unless it is fixed. A
  /// background keeps the class that it was created for: there is one submap a class.
  void AddClassObservations(ClassId c, std::uint64_t count);

  /// Called by Map before this copy is written in a new generation.
  void set_generation(std::uint64_t generation) { generation_ = generation; }
  [[nodiscard]] std::uint64_t generation() const { return generation_; }

  [[nodiscard]] std::size_t MemoryBytes() const { return sizeof(*this) + blocks_.MemoryBytes(); }

 private:
  /// For writing geometry.
  BlockTable& WritableBlocks() {
    outline_.Forget();
    return blocks_;
  }

  PartId part_id_;
  SubmapInfo info_;
  BlockTable blocks_;
  KeptOutline outline_;
  BoundingSphere sphere_;
  std::uint64_t generation_;
};

}  // namespace dhpmap
