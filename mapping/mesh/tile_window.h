// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/memory_count.h"
#include "mapping/mesh/tile_surface.h"

namespace dhpmap {

/// Room for a tile and what is around it, which a thread keeps. Voxels along x are the bits of a word: all that
/// marching cubes asks of many of them, it asks at once.
struct TileRoom {
  static constexpr int kTileVoxels = kTileSide * kBlockSide;  ///< along an axis
  // Cells begin one voxel before the tile; their corners are extrapolated from voxels one farther, by slopes that look
  // at one more.
  static constexpr int kMargin = 3;
  static constexpr int kSide = kTileVoxels + 2 * kMargin;
  static constexpr std::size_t kRows = std::size_t{kSide} * kSide;
  static constexpr std::size_t kVoxels = kRows * kSide;

  /// Bit x + kMargin is of voxel x of the tile.
  using Row = std::uint64_t;
  static_assert(kSide <= 64);
  template <typename T>
  using Room = CountedVector<T, MemoryKind::kTileRooms>;
  using Rows = Room<Row>;

  Rows observed = Rows(kRows), inside = Rows(kRows), contradicted = Rows(kRows);
  Rows in_front = Rows(kRows), behind = Rows(kRows), wider = Rows(kRows);
  Rows extrapolated = Rows(kRows);
  Room<float> distance_m = Room<float>(kVoxels);
  Room<Eigen::Vector3f> slope = Room<Eigen::Vector3f>(kVoxels);  ///< of those observed beside others, in metres a voxel
};

/// A tile with the voxels around it, as far as they are observed or can be extrapolated: those that are not, but have
/// one among their 26 neighbours that is, have the average of what these expect there, the nearer the more. Mostly it
/// is plain on which side of the surface they are; how far is worked out for those that are asked about. Uses the room
/// as long as it lives. Thread-compatible.
class TileWindow {
 public:
  using Row = TileRoom::Row;

  TileWindow(TileRoom& room, const TileBlocks& blocks);
  TileWindow(const TileWindow&) = delete;
  TileWindow& operator=(const TileWindow&) = delete;

  /// Of voxel (0, y, z) of the tile, from -kMargin to kTileVoxels + kMargin - 1 along each axis.
  static constexpr std::size_t RowAt(int y, int z) {
    return static_cast<std::size_t>(TileRoom::kSide * (z + TileRoom::kMargin) + y + TileRoom::kMargin);
  }
  /// Whether there may be a surface at all.
  [[nodiscard]] bool has_both_sides() const { return has_both_sides_; }
  [[nodiscard]] Row Observed(std::size_t row) const { return room_.observed[row]; }
  /// Observed or extrapolated: has a distance.
  [[nodiscard]] Row Known(std::size_t row) const { return room_.in_front[row] | room_.inside[row]; }
  /// Known, with a distance below 0.
  [[nodiscard]] Row Inside(std::size_t row) const { return room_.inside[row]; }
  /// Of one that is known.
  [[nodiscard]] float At(std::size_t row, int x) {
    const std::size_t at = row * TileRoom::kSide + static_cast<std::size_t>(x);
    if (((room_.observed[row] | room_.extrapolated[row]) >> x & 1) == 0) Extrapolate(row, x);
    return room_.distance_m[at];
  }

 private:
  void CopyBlock(const BlockEntry& block, BlockIndex offset);
  [[nodiscard]] Row Rim(int y, int z) const;
  [[nodiscard]] Eigen::Vector3f SlopeAt(std::size_t row, int x) const;
  void FindSides();
  void ConcludeSides();
  void Extrapolate(std::size_t row, int x);

  TileRoom& room_;
  bool has_both_sides_ = false;
};

}  // namespace dhpmap
