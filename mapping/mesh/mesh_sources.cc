// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/mesh_sources.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

/// Calls visit(BlockIndex) for each block of a tile. Reads no page.
template <typename Visitor>
void VisitBlocks(const TileEntry& entry, Visitor&& visit) {
  for (std::uint64_t cells = entry.tile->cells(); cells != 0; cells &= cells - 1) {
    visit(BlockIn(entry.index, std::countr_zero(cells)));
  }
}

/// A vertex has the label of a voxel at most two voxels away, which is in a neighbouring block.
void AddBlocksAround(const Submap& submap, IndexMap<BlockIndex>& around) {
  for (const TileEntry& entry : submap.blocks().tiles()) {
    VisitBlocks(entry, [&around](BlockIndex block) {
      for (int i = 0; i < 27; ++i) {
        around.Set({block.x + i % 3 - 1, block.y + i / 3 % 3 - 1, block.z + i / 9 - 1}, 0);
      }
    });
  }
}

bool IsNear(const Submap& a, const Submap& b) {
  const BoundingSphere &sphere = a.bounding_sphere(), &other = b.bounding_sphere();
  // One block around each.
  const double margin_m = 4 * kBlockSide * a.info().voxel_size_m;
  return (sphere.center_m - other.center_m).norm() <= sphere.radius_m + other.radius_m + margin_m;
}

std::vector<const Submap*> OnGridAround(const MapSnapshot& map, const std::vector<const Submap*>& on_grid) {
  std::vector<const Submap*> around;
  for (const auto& each : map.submaps()) {
    if (!IsCutFromMap(map, *each)) continue;
    const auto decides = [&each](const Submap* submap) { return submap == each.get() || IsNear(*submap, *each); };
    if (std::any_of(on_grid.begin(), on_grid.end(), decides)) around.push_back(each.get());
  }
  return around;
}

}  // namespace

bool IsCutFromMap(const MapSnapshot& map, const Submap& submap) {
  return !submap.IsAbsent() && IsExclusive(submap.info(), map.info().config);
}

std::size_t NumBlocksIn(const TileEntry& tile, const IndexMap<BlockIndex>& blocks) {
  std::size_t num = 0;
  VisitBlocks(tile, [&](BlockIndex block) { num += blocks.Find(block) != IndexMap<BlockIndex>::kNone ? 1 : 0; });
  return num;
}

MeshSources MeshSourcesOf(const MapSnapshot& map, std::span<const Submap* const> wanted) {
  MeshSources sources;
  for (const Submap* submap : wanted) {
    if (IsCutFromMap(map, *submap)) {
      sources.on_grid.push_back(submap);
      AddBlocksAround(*submap, sources.blocks);
    } else {
      for (const TileEntry& entry : submap->blocks().tiles()) {
        sources.tiles.push_back({submap, entry.tile.get(), entry.tile->size()});
      }
    }
  }
  sources.around = OnGridAround(map, sources.on_grid);
  for (const Submap* submap : sources.around) {
    for (const TileEntry& entry : submap->blocks().tiles()) {
      const std::size_t num = NumBlocksIn(entry, sources.blocks);
      if (num > 0) sources.tiles.push_back({submap, entry.tile.get(), num});
    }
  }
  return sources;
}

}  // namespace dhpmap
