// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mapping/geometry/body.h"
#include "mapping/query/query_world.h"
#include "mapping/query/work_budget.h"

namespace dhpmap {

inline constexpr double kHalfDiagonal_vox = 0.8660254037844387;  ///< of a voxel

/// Whether an unseen voxel is no obstacle, because it is inside an object that the query may touch.
bool IsAllowed(const QueryWorld& world, VoxelIndex voxel, double max_depth_m, WorkBudget* work);

/// Whether every block that intersects a box of the map frame is entirely free. False without a test for more than 512
/// blocks.
bool IsFreeThroughout(const QueryWorld& world, const Eigen::AlignedBox3d& box);

/// Calls visit(voxel) for unseen voxels of the map's grid whose centre is in a body (in the map frame), until it
/// returns false or `work`, if given, is spent. A body thinner than a voxel's diagonal is treated as this thick, so
/// that the voxels it lies in count. Entirely free blocks cost almost nothing. For a body beyond the range of the grid,
/// one voxel at its border is visited.
template <typename Shape, typename Visitor>
void VisitUnseen(const QueryWorld& world, const Shape& thin, Visitor&& visit, WorkBudget* work = nullptr) {
  const double size_m = world.voxel_size_m();
  constexpr double kIndexReach_vox = 1 << 30;
  const Shape body = AtLeast(kHalfDiagonal_vox * size_m, thin);
  const Eigen::AlignedBox3d box = BoundsOf(body);
  const double reach_m = kIndexReach_vox * size_m;
  if (!(box.min().minCoeff() > -reach_m && box.max().maxCoeff() < reach_m)) {
    visit(VoxelAt(CentreOf(body).cwiseMax(-reach_m).cwiseMin(reach_m), size_m));
    return;
  }
  // Of voxels whose centres lie between two places on an axis.
  const auto first_at = [size_m](double from_m) { return static_cast<std::int32_t>(std::ceil(from_m / size_m - 0.5)); };
  const auto last_at = [size_m](double to_m) { return static_cast<std::int32_t>(std::floor(to_m / size_m - 0.5)); };
  const VoxelIndex low = {first_at(box.min().x()), first_at(box.min().y()), first_at(box.min().z())};
  const VoxelIndex high = {last_at(box.max().x()), last_at(box.max().y()), last_at(box.max().z())};
  const BlockIndex from = BlockOf(low), to = BlockOf(high);
  constexpr std::int32_t kLast = kBlockSide - 1;
  for (std::int32_t bz = from.z; bz <= to.z; ++bz) {
    for (std::int32_t by = from.y; by <= to.y; ++by) {
      for (std::int32_t bx = from.x; bx <= to.x; ++bx) {
        const BlockIndex block{bx, by, bz};
        if (!SpendOf(work, 1)) return;
        const FreeTile* tile = world.FindFreeTile(TileOf(block));
        if (tile != nullptr && (tile->full() >> CellOf(block) & 1u) != 0) continue;
        const FreeMask free = tile == nullptr ? FreeMask{} : tile->MaskOf(CellOf(block));
        const std::int32_t x0 = bx * kBlockSide, y0 = by * kBlockSide, z0 = bz * kBlockSide;
        for (std::int32_t z = std::max(z0, low.z); z <= std::min(z0 + kLast, high.z); ++z) {
          for (std::int32_t y = std::max(y0, low.y); y <= std::min(y0 + kLast, high.y); ++y) {
            const Row row = RowIn(body, (y + 0.5) * size_m, (z + 0.5) * size_m);
            if (!(row.first_m <= row.last_m)) continue;
            const std::int32_t first = first_at(std::max(row.first_m, (x0 + 0.25) * size_m));
            const std::int32_t last = last_at(std::min(row.last_m, (x0 + kLast + 0.75) * size_m));
            if (!SpendOf(work, 1)) return;
            for (std::int32_t x = first; x <= last; ++x) {
              const int linear = LinearIndex({x, y, z});
              if ((free[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0) continue;
              if (!SpendOf(work, 2)) return;
              if (!world.IsObserved({x, y, z}) && !visit(VoxelIndex{x, y, z})) return;
            }
          }
        }
      }
    }
  }
}

}  // namespace dhpmap
