// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/free/free_tile.h"

namespace dhpmap {

/// One tile of the layer, shared with every copy that holds the same state.
struct FreeTileEntry {
  TileIndex index;
  std::shared_ptr<const FreeTile> tile;  ///< never null, never empty
  std::uint64_t generation = 0;          ///< of the writer that made it; see FreeSpace
};

/// The free-space layer of a map: the voxels of the map's own grid (map frame, MapConfig::voxel_size_m) that sensors
/// have looked through. Voxels outside all tiles are unknown unless a submap has a surface there: a TSDF holds
/// +-truncation and cannot tell free from unseen. If a voxel is both free and at a surface, the surface wins.
///
/// Copying shares the tiles. A writer names its generation, which must be new after each copy (see BlockTable): it
/// copies a tile of another generation before it writes to it. Thread-compatible.
class FreeSpace {
 public:
  /// A tile's stamp is renewed only when it is this old, so that a standing robot writes little.
  static constexpr std::int64_t kStampStep_ns = 1'000'000'000;

  explicit FreeSpace(std::uint64_t generation = 0) : generation_(generation) {}

  [[nodiscard]] bool empty() const { return tiles_.empty(); }
  [[nodiscard]] bool IsFree(VoxelIndex voxel) const {
    const FreeTile* tile = Find(TileOf(BlockOf(voxel)));
    return tile != nullptr && tile->IsFree(CellOf(BlockOf(voxel)), LinearIndex(voxel));
  }
  /// Null if nothing in that tile is free. Valid until the layer is next written to.
  [[nodiscard]] const FreeTile* Find(TileIndex index) const {
    const std::uint32_t number = numbers_.Find(index);
    return number == kNone ? nullptr : tiles_[number].tile.get();
  }
  [[nodiscard]] const FreeTileEntry* FindEntry(TileIndex index) const {
    const std::uint32_t number = numbers_.Find(index);
    return number == kNone ? nullptr : &tiles_[number];
  }
  /// In order of allocation; erasing a tile moves the last one into the gap.
  [[nodiscard]] std::span<const FreeTileEntry> tiles() const { return tiles_; }
  [[nodiscard]] std::int64_t NumFreeVoxels() const;

  /// Whether a view at `stamp_ns` must renew the stamp of `tile`.
  [[nodiscard]] static bool IsStale(const FreeTile& tile, std::int64_t stamp_ns);
  /// Adds the free voxels of a view. Writes nothing if all were free already and the tile's stamp is recent. Returns
  /// whether anything was written.
  bool Add(TileIndex index, const FreeBlocks& seen, std::int64_t stamp_ns);
  /// Puts a tile in place as it is (a loaded map). Not null, not empty.
  void Put(TileIndex index, std::shared_ptr<const FreeTile> tile);
  /// Returns whether the tile was there.
  bool Erase(TileIndex index);
  /// Marks every tile as shared, whatever its generation: for two copies that continue with the same generation.
  void ShareTiles();

  /// Called by Map before this copy is written in a new generation.
  void set_generation(std::uint64_t generation) { generation_ = generation; }
  [[nodiscard]] std::uint64_t generation() const { return generation_; }

  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  static constexpr std::uint32_t kNone = IndexMap<TileIndex>::kNone;

  std::vector<FreeTileEntry> tiles_;
  IndexMap<TileIndex> numbers_;  ///< position in tiles_
  std::uint64_t generation_;
};

/// The difference that takes a reader from `before` to `after`.
struct FreeSpaceChange {
  std::vector<const FreeTileEntry*> written;  ///< tiles of `after` that are other objects than before
  std::vector<TileIndex> erased;
  [[nodiscard]] bool empty() const { return written.empty() && erased.empty(); }
};

/// Compares tiles by identity. `before` may be null.
FreeSpaceChange DiffFreeSpace(const FreeSpace* before, const FreeSpace& after);

}  // namespace dhpmap
