// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dhpmap {

// Cells are cubes of voxels, tested eight at a time: a tile of 32^3 voxels, its eighths of 16^3, their blocks of 8^3,
// and the octants of blocks, of 4^3. All lengths are in voxels, relative to the sensor, along the axes of the map's
// grid.

inline constexpr int kLanes = 8;

/// Sizes of cells, the largest first.
enum class CellSize : std::uint8_t { kTile = 0, kEighth = 1, kBlock = 2, kOctant = 3 };
inline constexpr int kNumCellSizes = 4;
inline constexpr int kOctantSide = 4;
inline constexpr int kOctantVoxels = kOctantSide * kOctantSide * kOctantSide;

inline constexpr int SideOf(CellSize size) { return 32 >> static_cast<int>(size); }
/// From a cell's centre to the centres of its outermost voxels: a test of a cell concerns the centres of its voxels.
inline constexpr float HalfSpanOf(CellSize size) { return 0.5f * static_cast<float>(SideOf(size) - 1); }

/// Centres of up to eight cells of one size.
struct CellBatch {
  CellSize size = CellSize::kTile;
  std::array<float, kLanes> x{}, y{}, z{};
};

/// Centres and radii of up to eight balls.
struct BallBatch {
  std::array<float, kLanes> x{}, y{}, z{}, radius{};
};

/// The factor that moves a point nearer to the sensor by `by_vox`, in the same direction.
inline float ScaleToNearer(float x, float y, float z, float by_vox) {
  const float range = std::sqrt(x * x + y * y + z * z);
  return range > by_vox ? 1 - by_vox / range : 0.0f;
}
inline CellBatch Nearer(const CellBatch& cells, float by_vox) {
  CellBatch nearer = cells;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float scale = ScaleToNearer(cells.x[i], cells.y[i], cells.z[i], by_vox);
    nearer.x[i] *= scale, nearer.y[i] *= scale, nearer.z[i] *= scale;
  }
  return nearer;
}

/// The eight octants of a cell whose centre is given, x fastest, then y, then z.
inline CellBatch ChildrenOf(CellSize size, float x, float y, float z) {
  CellBatch children;
  children.size = static_cast<CellSize>(static_cast<int>(size) + 1);
  const float step = 0.5f * static_cast<float>(SideOf(children.size));
  for (std::size_t i = 0; i < kLanes; ++i) {
    children.x[i] = x + ((i & 1) != 0 ? step : -step);
    children.y[i] = y + ((i & 2) != 0 ? step : -step);
    children.z[i] = z + ((i & 4) != 0 ? step : -step);
  }
  return children;
}

/// The result of a view for all voxel centres of a cell.
enum class CellSight : std::uint8_t {
  kHidden,  ///< none is free
  kFree,    ///< all are free
  kMixed,   ///< undecided: test its parts
};
using CellSights = std::array<CellSight, kLanes>;

}  // namespace dhpmap
