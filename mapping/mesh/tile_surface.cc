// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mapping/mesh/cell_cases.h"
#include "mapping/mesh/tile_window.h"

namespace dhpmap {
namespace {

class TileMarcher {
 public:
  TileMarcher(TileWindow& window, double voxel_size_m)
      : window_(window), voxel_size_m_(static_cast<float>(voxel_size_m)) {}

  std::vector<SurfaceTriangle> March() {
    for (int z = -1; z < TileRoom::kTileVoxels; ++z) {
      for (int y = -1; y < TileRoom::kTileVoxels; ++y) MarchRow(y, z);
    }
    return std::move(triangles_);
  }

 private:
  using Row = TileRoom::Row;

  void MarchRow(int y, int z) {
    const std::array<std::size_t, 4> rows = {TileWindow::RowAt(y, z), TileWindow::RowAt(y + 1, z),
                                             TileWindow::RowAt(y, z + 1), TileWindow::RowAt(y + 1, z + 1)};
    Row known = ~Row{0}, observed = 0, all_inside = ~Row{0}, inside = 0;
    for (const std::size_t row : rows) {
      known &= window_.Known(row);
      observed |= window_.Observed(row);
      all_inside &= window_.Inside(row);
      inside |= window_.Inside(row);
    }
    constexpr Row kCells = ((Row{1} << (TileRoom::kTileVoxels + 1)) - 1) << (TileRoom::kMargin - 1);
    const auto with_next = [](Row row) { return row | row >> 1; };
    Row crossed =
        known & known >> 1 & ~(all_inside & all_inside >> 1) & with_next(inside) & with_next(observed) & kCells;
    for (; crossed != 0; crossed &= crossed - 1) MarchCell(rows, std::countr_zero(crossed), y, z);
  }

  /// Of the corners of the cell that begins at bit `x` of the first row.
  template <typename BitsOf>
  static unsigned Corners(const std::array<std::size_t, 4>& rows, int x, BitsOf&& bits_of) {
    unsigned corners = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) corners |= static_cast<unsigned>(bits_of(rows[i]) >> x & 3) << 2 * i;
    return corners;
  }

  void MarchCell(const std::array<std::size_t, 4>& rows, int x, int y, int z) {
    const VoxelIndex low{x - TileRoom::kMargin, y, z};
    const unsigned inside = Corners(rows, x, [this](std::size_t row) { return window_.Inside(row); });
    const int first_observed =
        std::countr_zero(Corners(rows, x, [this](std::size_t row) { return window_.Observed(row); }));
    const auto is_in_tile = [](int coordinate) { return coordinate >= 0 && coordinate < TileRoom::kTileVoxels; };
    if (!is_in_tile(low.x + (first_observed & 1)) || !is_in_tile(low.y + (first_observed >> 1 & 1)) ||
        !is_in_tile(low.z + (first_observed >> 2 & 1))) {
      return;
    }
    const CellCase& cell_case = CellCases()[inside];
    std::array<Eigen::Vector3f, kCellEdges> crossings;
    for (unsigned edges = cell_case.edges; edges != 0; edges &= edges - 1) {
      const int edge = std::countr_zero(edges);
      crossings[static_cast<std::size_t>(edge)] = Crossing(low, edge);
    }
    for (std::size_t k = 0; k < cell_case.num_triangles; ++k) {
      const auto& edges = cell_case.triangles[k];
      triangles_.push_back({crossings[edges[0]], crossings[edges[1]], crossings[edges[2]]});
    }
  }

  /// Where the surface crosses an edge of a cell.
  [[nodiscard]] Eigen::Vector3f Crossing(VoxelIndex low, int cell_edge) {
    constexpr float kLeast = 1e-3f;  // in voxels, as in meshes
    const CellEdge edge = CellEdgeTable()[static_cast<std::size_t>(cell_edge)];
    const VoxelIndex corner{low.x + (edge.corner & 1), low.y + (edge.corner >> 1 & 1), low.z + (edge.corner >> 2 & 1)};
    const std::size_t row = TileWindow::RowAt(corner.y, corner.z);
    const int x = corner.x + TileRoom::kMargin;
    constexpr std::size_t kNextRow[3] = {0, 1, TileRoom::kSide};
    const float a = window_.At(row, x), b = window_.At(row + kNextRow[edge.axis], x + (edge.axis == 0 ? 1 : 0));
    Eigen::Vector3f p(static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(corner.z));
    p[edge.axis] += std::clamp(a / (a - b), kLeast, 1 - kLeast);
    return (p + Eigen::Vector3f::Constant(0.5f)) * voxel_size_m_;
  }

  TileWindow& window_;
  const float voxel_size_m_;
  std::vector<SurfaceTriangle> triangles_;
};

}  // namespace

TileNeighbourhood FindNeighbourhood(const BlockTable& blocks, TileIndex tile) {
  TileNeighbourhood around;
  for (int i = 0; i < 27; ++i) {
    around[static_cast<std::size_t>(i)] =
        blocks.FindTile({tile.x + i % 3 - 1, tile.y + i / 3 % 3 - 1, tile.z + i / 9 - 1});
  }
  return around;
}

namespace {

/// Calls visit(number, tile, cell) for the places of FindBlocks where there is a tile.
template <typename Visitor>
void ForEachPlace(const TileNeighbourhood& around, TileIndex tile, Visitor&& visit) {
  const BlockIndex first = BlockIn(tile, 0);
  for (int i = 0; i < static_cast<int>(std::tuple_size_v<TileBlocks>); ++i) {
    const BlockIndex offset = OffsetInTile(i);
    const TileIndex beside = TileOf(offset);
    const TileEntry* entry = around[static_cast<std::size_t>((beside.x + 1) + 3 * (beside.y + 1) + 9 * (beside.z + 1))];
    if (entry == nullptr) continue;
    visit(static_cast<std::size_t>(i), *entry->tile,
          CellOf({first.x + offset.x, first.y + offset.y, first.z + offset.z}));
  }
}

SurfaceNames NamesOf(const BlockTile& tile, int cell) {
  if (const TilePage* page = tile.page().get()) {
    const std::uint64_t tsdf = page->PartIdOf(BlockLayer::kTsdf, cell);
    return tsdf == 0 ? SurfaceNames() : SurfaceNames{tsdf, page->PartIdOf(BlockLayer::kGone, cell)};
  }
  const BlockEntry* block = tile.Find(cell);
  if (block == nullptr || block->tsdf == nullptr) return {};
  return {block->tsdf->part_id.value(), block->gone != nullptr ? block->gone->part_id.value() : 0};
}

}  // namespace

TileBlocks FindBlocks(const TileNeighbourhood& around, TileIndex tile) {
  TileBlocks blocks{};
  ForEachPlace(around, tile, [&](std::size_t i, const BlockTile& there, int cell) {
    const BlockEntry* block = there.Find(cell);
    if (block != nullptr && block->tsdf != nullptr) blocks[i] = block;
  });
  return blocks;
}

TileNames FindNames(const TileNeighbourhood& around, TileIndex tile) {
  TileNames names{};
  ForEachPlace(around, tile, [&](std::size_t i, const BlockTile& there, int cell) { names[i] = NamesOf(there, cell); });
  return names;
}

std::vector<SurfaceTriangle> ExtractTileSurface(const TileBlocks& blocks, double voxel_size_m) {
  thread_local TileRoom room;
  TileWindow window(room, blocks);
  if (!window.has_both_sides()) return {};
  return TileMarcher(window, voxel_size_m).March();
}

Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m) { return BlockCorner(BlockIn(tile, 0), voxel_size_m); }

}  // namespace dhpmap
