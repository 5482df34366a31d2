// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mapping/space/cell.h"
#include "mapping/space/grid_origin.h"
#include "mapping/space/look_options.h"
#include "mapping/voxels/block_table.h"

namespace dhpmap {

/// A tile of the map's grid that a view looks through at least partly; its centre is relative to the sensor.
struct TileToLook {
  TileIndex index;
  CellSight sight;
  float x, y, z;
};

/// The tiles along one axis that a range of voxels from the sensor touches.
struct TileRange {
  std::int32_t first = 0, last = -1;
  TileRange(double least_vox, double most_vox, std::int32_t origin, double offset_vox) {
    constexpr double kReach = kMaxSight_vox;
    // In this form NaN, from an absurd focal length, gives the largest range.
    const double least = least_vox > -kReach ? least_vox : -kReach, most = most_vox < kReach ? most_vox : kReach;
    if (!(least <= most)) return;
    first = TileOf(origin + static_cast<std::int32_t>(std::floor(least + offset_vox)));
    last = TileOf(origin + static_cast<std::int32_t>(std::floor(most + offset_vox)));
  }
  static std::int32_t TileOf(std::int32_t voxel) { return voxel >> (kBlockSideLog2 + kTileSideLog2); }
};

/// Tests all tiles within the view's reach, eight at a time. Lists those that are not hidden, or would not be if the
/// view's limits were farther by `farther_by_vox`.
template <typename View>
void ListTiles(const View& view, const GridOrigin& origin, std::vector<TileToLook>& tiles, float farther_by_vox = 0) {
  constexpr int kSide = SideOf(CellSize::kTile);
  tiles.clear();
  const Box box = view.Reach().GrownBy(farther_by_vox);
  if (!(box.least_vox.array() <= box.most_vox.array()).any()) return;
  const auto range = [&](int axis, std::int32_t voxel) {
    return TileRange(box.least_vox[axis], box.most_vox[axis], voxel, origin.offset_vox[axis]);
  };
  const TileRange xs = range(0, origin.voxel.x), ys = range(1, origin.voxel.y), zs = range(2, origin.voxel.z);
  CellBatch batch;
  batch.size = CellSize::kTile;
  std::array<TileIndex, kLanes> indices;
  std::size_t num_in_batch = 0;
  const auto flush = [&] {
    CellSights sights;
    view.Classify(Nearer(batch, farther_by_vox), sights);
    for (std::size_t i = 0; i < num_in_batch; ++i) {
      if (sights[i] == CellSight::kHidden) continue;
      tiles.push_back({indices[i], sights[i], batch.x[i], batch.y[i], batch.z[i]});
    }
    num_in_batch = 0;
  };
  for (std::int32_t z = zs.first; z <= zs.last; ++z) {
    for (std::int32_t y = ys.first; y <= ys.last; ++y) {
      for (std::int32_t x = xs.first; x <= xs.last; ++x) {
        indices[num_in_batch] = {x, y, z};
        batch.x[num_in_batch] = GridOrigin::ToCentre(x, kSide, origin.voxel.x, origin.offset_vox.x());
        batch.y[num_in_batch] = GridOrigin::ToCentre(y, kSide, origin.voxel.y, origin.offset_vox.y());
        batch.z[num_in_batch] = GridOrigin::ToCentre(z, kSide, origin.voxel.z, origin.offset_vox.z());
        if (++num_in_batch == kLanes) flush();
      }
    }
  }
  flush();
}

}  // namespace dhpmap
