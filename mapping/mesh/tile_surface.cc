// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_surface.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>
#include <utility>

#include "mapping/mesh/cell_cases.h"
#include "mapping/mesh/tile_window.h"

namespace dhpmap {
namespace {

class TileMarcher {
 public:
  TileMarcher(const TileWindow& window, const TileOwner& own, std::span<const TileOwner> sharers, double voxel_size_m)
      : window_(window), own_(own), sharers_(sharers), voxel_size_m_(static_cast<float>(voxel_size_m)) {}

  TileSurface March() {
    for (int z = -1; z < TileRoom::kTileVoxels; ++z) {
      for (int y = -1; y < TileRoom::kTileVoxels; ++y) MarchRow(y, z);
    }
    if (!surface_.needs.empty()) surface_.needs.resize(surface_.triangles.size());
    return std::move(surface_);
  }

 private:
  using Row = TileRoom::Row;
  using Rows = std::array<std::size_t, 4>;  ///< of a cell's corners, by their bits y and z

  void MarchRow(int y, int z) {
    const Rows rows = {TileWindow::RowAt(y, z), TileWindow::RowAt(y + 1, z), TileWindow::RowAt(y, z + 1),
                       TileWindow::RowAt(y + 1, z + 1)};
    Row known = ~Row{0}, all_own = ~Row{0}, own = 0, all_inside = ~Row{0}, inside = 0;
    for (const std::size_t row : rows) {
      known &= window_.Known(row);
      all_own &= window_.Own(row);
      own |= window_.Own(row);
      all_inside &= window_.Inside(row);
      inside |= window_.Inside(row);
    }
    constexpr Row kCells = ((Row{1} << (TileRoom::kTileVoxels + 1)) - 1) << (TileRoom::kMargin - 1);
    const auto with_next = [](Row row) { return row | row >> 1; };
    Row crossed = known & known >> 1 & ~(all_inside & all_inside >> 1) & with_next(inside) & with_next(own) & kCells;
    const Row alone = all_own & all_own >> 1;
    for (; crossed != 0; crossed &= crossed - 1) {
      const int x = std::countr_zero(crossed);
      MarchCell(rows, x, y, z, (alone >> x & 1) != 0);
    }
  }

  /// Bits of the corners of the cell that begins at bit `x` of the first row.
  template <typename BitsOf>
  static unsigned Corners(const Rows& rows, int x, BitsOf&& bits_of) {
    unsigned corners = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) corners |= static_cast<unsigned>(bits_of(rows[i]) >> x & 3) << 2 * i;
    return corners;
  }

  void MarchCell(const Rows& rows, int x, int y, int z, bool is_alone) {
    const VoxelIndex low{x - TileRoom::kMargin, y, z};
    const unsigned own = Corners(rows, x, [this](std::size_t row) { return window_.Own(row); });
    const int first_own = std::countr_zero(own);
    const auto is_in_tile = [](int coordinate) { return coordinate >= 0 && coordinate < TileRoom::kTileVoxels; };
    if (!is_in_tile(low.x + (first_own & 1)) || !is_in_tile(low.y + (first_own >> 1 & 1)) ||
        !is_in_tile(low.z + (first_own >> 2 & 1))) {
      return;
    }
    if (!is_alone && !TakeShared(rows, x, own)) return;
    const unsigned inside = Corners(rows, x, [this](std::size_t row) { return window_.Inside(row); });
    const CellCase& cell_case = CellCases()[inside];
    if (!is_alone) surface_.needs.resize(surface_.triangles.size());  // earlier triangles need no other submap
    std::array<Eigen::Vector3f, kCellEdges> crossings;
    for (unsigned edges = cell_case.edges; edges != 0; edges &= edges - 1) {
      const int edge = std::countr_zero(edges);
      crossings[static_cast<std::size_t>(edge)] = Crossing(low, edge);
    }
    for (std::size_t k = 0; k < cell_case.num_triangles; ++k) {
      const auto& edges = cell_case.triangles[k];
      surface_.triangles.push_back({crossings[edges[0]], crossings[edges[1]], crossings[edges[2]]});
    }
    if (!is_alone) surface_.needs.resize(surface_.triangles.size(), NumberOfNeeded());
  }

  /// Collects the submaps of a shared cell's other corners in shares_. Returns whether the cell belongs to this submap:
  /// to the one with most corners.
  bool TakeShared(const Rows& rows, int x, unsigned own) {
    shares_.clear();
    for (unsigned left = ~own & 0xFFu; left != 0; left &= left - 1) {
      const auto corner = static_cast<unsigned>(std::countr_zero(left));
      const std::size_t sharer = window_.SharerAt(rows[corner >> 1], x + static_cast<int>(corner & 1));
      const auto known =
          std::find_if(shares_.begin(), shares_.end(), [&](const Share& share) { return share.sharer == sharer; });
      if (known == shares_.end()) shares_.push_back({sharer, 1});
      else ++known->num_corners;
    }
    const auto rank = [](const TileOwner& owner, int num_corners) {
      return std::tuple(owner.id == kUnknownSubmap, -num_corners, owner.id);
    };
    const auto of_own = rank(own_, std::popcount(own));
    return std::all_of(shares_.begin(), shares_.end(),
                       [&](const Share& share) { return of_own < rank(sharers_[share.sharer], share.num_corners); });
  }

  /// The number of the set of submaps in shares_ among the surface's needs.
  std::uint16_t NumberOfNeeded() {
    std::vector<SubmapId> ids;
    for (const Share& share : shares_) ids.push_back(sharers_[share.sharer].id);
    std::sort(ids.begin(), ids.end());
    if (surface_.needed.empty()) surface_.needed.emplace_back();
    auto found = std::find(surface_.needed.begin(), surface_.needed.end(), ids);
    if (found == surface_.needed.end()) found = surface_.needed.insert(found, std::move(ids));
    return static_cast<std::uint16_t>(found - surface_.needed.begin());
  }

  /// Where the surface crosses an edge of a cell.
  [[nodiscard]] Eigen::Vector3f Crossing(VoxelIndex low, int cell_edge) const {
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

  /// A sharer with corners of a cell.
  struct Share {
    std::size_t sharer;
    int num_corners;
  };

  const TileWindow& window_;
  const TileOwner& own_;
  const std::span<const TileOwner> sharers_;
  const float voxel_size_m_;
  TileSurface surface_;
  std::vector<Share> shares_;
};

}  // namespace

TileSurface ExtractTileSurface(const TileOwner& own, std::span<const TileOwner> sharers, double voxel_size_m) {
  thread_local TileRoom room;
  const TileWindow window(room, own.blocks, sharers);
  if (!window.has_both_sides()) return {};
  return TileMarcher(window, own, sharers, voxel_size_m).March();
}

std::vector<SurfaceTriangle> ExtractTileSurface(const TileBlocks& blocks, double voxel_size_m) {
  return ExtractTileSurface(TileOwner{.id = kUnknownSubmap, .blocks = blocks}, {}, voxel_size_m).triangles;
}

Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m) { return BlockCorner(BlockIn(tile, 0), voxel_size_m); }

}  // namespace dhpmap
