// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/look_into_cell.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace dhpmap {

CellSight LookIntoCell(const MapSurfaces& surfaces, BlockIndex block) {
  const MapSnapshot& map = surfaces.state();
  CellSight sight;
  const FreeTile* tile = map.free_space()->Find(TileOf(block));
  if (tile != nullptr) sight.free = tile->MaskOf(CellOf(block));
  const SubmapIndex& index = surfaces.index();
  const double voxel_size_m = map.info().config.voxel_size_m, half_m = 0.5 * kBlockSide * voxel_size_m;
  const Eigen::Vector3f centre = index.InTree(BlockCorner(block, voxel_size_m) + Eigen::Vector3d::Constant(half_m));
  const Eigen::Vector3f half = Eigen::Vector3f::Constant(static_cast<float>(1.02 * half_m));
  index.tree().VisitOverlapping({centre - half, centre + half}, [&](std::size_t item) {
    const std::uint32_t number = index.tree().items()[item];
    const SubmapIndex::Entry& entry = index.entries()[number];
    if (!entry.IsInMapFrame() || entry.submap().info().voxel_size_m != voxel_size_m) {
      sight.others.push_back(number);
      return;
    }
    const BlockEntry* there = entry.submap().blocks().Find(block);
    if (there == nullptr || there->tsdf == nullptr) return;
    for (int i = 0; i < kBlockVoxels; ++i) {
      const auto word = static_cast<std::size_t>(i >> 6);
      const std::uint64_t is_shown = there->Shows(i),
                          is_front = there->tsdf->distance_m[static_cast<std::size_t>(i)] > 0;
      sight.observed[word] |= is_shown << (i & 63);
      sight.front[word] |= (is_shown & is_front) << (i & 63);
    }
  });
  return sight;
}

std::vector<UnseenInside::Thing> ThingsAround(const MapSurfaces& surfaces, BlockIndex block) {
  const double voxel_size_m = surfaces.state().info().config.voxel_size_m;
  const Eigen::Vector3d corner = BlockCorner(block, voxel_size_m);
  const Eigen::AlignedBox3d box(corner, corner + Eigen::Vector3d::Constant(kBlockSide * voxel_size_m));
  std::vector<UnseenInside::Thing> around;
  surfaces.VisitThings(box, [&](const MapSurfaces::Thing& thing) {
    const SubmapIndex::Entry& entry = surfaces.index().entries()[thing.number];
    const SubmapId id = entry.submap().id();
    around.push_back({.id = id, .T_submap_map = entry.T_submap_map(), .surface = surfaces.SurfaceOf(id)});
    return true;
  });
  std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return around;
}

StateLook LookOf(const MapSurfaces& surfaces) {
  return {.sight = [&surfaces](BlockIndex block) { return LookIntoCell(surfaces, block); },
          .things = [&surfaces](BlockIndex block) { return ThingsAround(surfaces, block); }};
}

}  // namespace dhpmap
