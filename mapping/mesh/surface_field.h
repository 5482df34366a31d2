// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/index_map.h"
#include "mapping/base/memory_count.h"
#include "mapping/base/thread_pool.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Scratch memory for meshing, counted as MemoryKind::kMeshing.
template <typename T>
using MeshingVector = CountedVector<T, MemoryKind::kMeshing>;

/// A submap that has a block at some index.
struct BlockHolder {
  const Submap* submap = nullptr;
  const BlockEntry* block = nullptr;
};

/// The part of the submaps' grid that a field covers, and the frame of its surface.
struct FieldScope {
  const IndexMap<BlockIndex>* blocks = nullptr;  ///< these blocks alone; null: all
  bool is_in_own_frame = false;                  ///< T_map_field is the identity: coordinates of the submaps' frame
};

/// The voxels of submaps that share one grid (pose and voxel size), merged into one field: at each position the
/// weighted average of their voxels, and the owner (see SupportOfVoxel). Contradicted voxels are left out. A block that
/// only one submap has is shared, not copied. Refers to the submaps. Immutable, thread-safe.
class SurfaceField {
 public:
  /// At least one submap; by ascending id. The result does not depend on the number of threads.
  SurfaceField(std::span<const Submap* const> submaps, ThreadPool& pool, const FieldScope& scope = {});

  [[nodiscard]] const Transform& T_map_field() const { return T_map_field_; }
  [[nodiscard]] double voxel_size_m() const { return voxel_size_m_; }

  /// By ascending index, all with geometry; no labels.
  [[nodiscard]] std::span<const BlockEntry> blocks() const { return blocks_; }
  /// Null if there is no such block.
  [[nodiscard]] const BlockEntry* Find(BlockIndex index) const {
    const std::uint32_t number = numbers_.Find(index);
    return number == IndexMap<BlockIndex>::kNone ? nullptr : &blocks_[number];
  }
  /// Position of one of them in blocks().
  [[nodiscard]] std::size_t NumberOf(const BlockEntry& entry) const {
    return static_cast<std::size_t>(&entry - blocks_.data());
  }
  /// The submap that alone has a block at the index of entry `block`; null if there are several.
  [[nodiscard]] const Submap* SoleHolder(std::size_t block) const {
    return holders_[block].all.size() == 1 ? holders_[block].all[0].submap : nullptr;
  }
  /// The owner of an observed voxel of entry `block`.
  [[nodiscard]] const BlockHolder& HolderAt(std::size_t block, int linear) const {
    const Holders& holders = holders_[block];
    return holders.all[holders.of_voxel.empty() ? 0 : holders.of_voxel[static_cast<std::size_t>(linear)]];
  }

 private:
  struct Holders {
    MeshingVector<BlockHolder> all;
    MeshingVector<std::uint16_t> of_voxel;  ///< position in `all`; empty: there is only one
  };

  static void Merge(Holders& holders, BlockEntry& merged);

  Transform T_map_field_;
  double voxel_size_m_;
  MeshingVector<BlockEntry> blocks_;
  IndexMap<BlockIndex> numbers_;  ///< position in blocks_
  CountedBytes numbers_bytes_{MemoryKind::kMeshing};
  MeshingVector<Holders> holders_;  ///< one an entry of blocks_
};

}  // namespace dhpmap
