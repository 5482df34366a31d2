// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mapping/base/memory_count.h"
#include "mapping/mesh/tile_blocks.h"

namespace dhpmap {

/// Scratch memory for a tile and the voxels around it, reused by a thread. The voxels of a row along x are the bits of
/// a word, so that marching cubes tests many voxels at once.
struct TileRoom {
  static constexpr int kTileVoxels = kTileSide * kBlockSide;  ///< along an axis
  static constexpr int kMargin = 1;                           ///< cells begin one voxel before the tile, and end beyond
  static constexpr int kSide = kTileVoxels + 2 * kMargin;
  static constexpr std::size_t kRows = std::size_t{kSide} * kSide;
  static constexpr std::size_t kVoxels = kRows * kSide;

  /// Bit x + kMargin is of voxel x of the tile.
  using Row = std::uint64_t;
  static_assert(kSide <= 64);
  template <typename T>
  using Room = CountedVector<T, MemoryKind::kTileRooms>;
  using Rows = Room<Row>;

  Rows own = Rows(kRows), shared = Rows(kRows), inside = Rows(kRows);
  Room<float> distance_m = Room<float>(kVoxels);
  Room<std::uint16_t> sharer = Room<std::uint16_t>(kVoxels);  ///< the sharer that shows a shared voxel
};

/// A tile with the voxels around it that its submap, or other submaps on the grid, show. Uses `room` during its
/// lifetime. Thread-compatible.
class TileWindow {
 public:
  using Row = TileRoom::Row;

  /// A voxel that `own` shows is its own; else it belongs to the first of `sharers` that shows it.
  TileWindow(TileRoom& room, const TileBlocks& own, std::span<const TileOwner> sharers);
  TileWindow(const TileWindow&) = delete;
  TileWindow& operator=(const TileWindow&) = delete;

  /// The row of voxel (0, y, z) of the tile, from -kMargin to kTileVoxels + kMargin - 1 along each axis.
  static constexpr std::size_t RowAt(int y, int z) {
    return static_cast<std::size_t>(TileRoom::kSide * (z + TileRoom::kMargin) + y + TileRoom::kMargin);
  }
  /// Whether there may be a surface at all.
  [[nodiscard]] bool has_both_sides() const { return has_both_sides_; }
  [[nodiscard]] Row Own(std::size_t row) const { return room_.own[row]; }
  /// The submap or a sharer shows the voxel.
  [[nodiscard]] Row Known(std::size_t row) const { return room_.own[row] | room_.shared[row]; }
  /// Known, with a distance below 0.
  [[nodiscard]] Row Inside(std::size_t row) const { return room_.inside[row]; }
  /// The distance of a known voxel. `x`: position in the row.
  [[nodiscard]] float At(std::size_t row, int x) const { return room_.distance_m[PlaceOf(row, x)]; }
  /// For a known voxel that is not the submap's own: position in the sharers.
  [[nodiscard]] std::size_t SharerAt(std::size_t row, int x) const { return room_.sharer[PlaceOf(row, x)]; }

 private:
  static constexpr std::size_t PlaceOf(std::size_t row, int x) {
    return row * TileRoom::kSide + static_cast<std::size_t>(x);
  }
  void CopyOwn(const BlockEntry& block, BlockIndex offset);
  void CopyShared(const BlockEntry& block, BlockIndex offset, std::uint16_t sharer);
  void FindSides();

  TileRoom& room_;
  bool has_both_sides_ = false;
};

}  // namespace dhpmap
