// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "mapping/map/slope.h"
#include "mapping/mesh/cell_cases.h"

namespace dhpmap {
namespace {

constexpr int kTileVoxels = kTileSide * kBlockSide;  // along an axis
// Cells begin one voxel before the tile; their corners are extrapolated from voxels one farther, by slopes that look at
// one more.
constexpr int kMargin = 3;
constexpr int kSide = kTileVoxels + 2 * kMargin;
constexpr int kStride[3] = {1, kSide, kSide* kSide};
constexpr std::size_t kVoxels = std::size_t{kSide} * kSide * kSide;

/// Position of a voxel of the tile, counted from its corner, -kMargin to kTileVoxels + kMargin - 1 along each axis.
constexpr int Position(int x, int y, int z) {
  return (x + kMargin) + kSide * (y + kMargin) + kSide * kSide * (z + kMargin);
}

enum Flag : std::uint8_t { kHasValue = 1, kInside = 2, kObserved = 4 };

/// A tile with the voxels around it, as far as they are observed or can be extrapolated.
class TileWindow {
 public:
  TileWindow(const TileNeighbourhood& around, TileIndex tile)
      : distance_m_(kVoxels, std::numeric_limits<float>::quiet_NaN()), flags_(kVoxels, 0) {
    for (int dz = -1; dz <= kTileSide; ++dz) {
      for (int dy = -1; dy <= kTileSide; ++dy) {
        for (int dx = -1; dx <= kTileSide; ++dx) CopyBlock(around, tile, {dx, dy, dz});
      }
    }
    Extrapolate();
  }

  [[nodiscard]] float At(int position) const { return distance_m_[static_cast<std::size_t>(position)]; }
  [[nodiscard]] const std::uint8_t* flags() const { return flags_.data(); }

 private:
  /// The block at an offset, in blocks, from the tile's first.
  void CopyBlock(const TileNeighbourhood& around, TileIndex tile, BlockIndex offset) {
    const TileIndex beside = TileOf(offset);
    const TileEntry* entry = around[static_cast<std::size_t>((beside.x + 1) + 3 * (beside.y + 1) + 9 * (beside.z + 1))];
    if (entry == nullptr) return;
    const BlockIndex first = BlockIn(tile, 0);
    const BlockEntry* block = entry->tile->Find(CellOf({first.x + offset.x, first.y + offset.y, first.z + offset.z}));
    if (block == nullptr || block->tsdf == nullptr) return;
    const auto begin = [](int d) { return d < 0 ? kBlockSide - kMargin : 0; };
    const auto end = [](int d) { return d == kTileSide ? kMargin : kBlockSide; };
    for (int z = begin(offset.z); z < end(offset.z); ++z) {
      for (int y = begin(offset.y); y < end(offset.y); ++y) {
        for (int x = begin(offset.x); x < end(offset.x); ++x) {
          const int linear = LinearIndex({x, y, z});
          if (!block->Shows(linear)) continue;
          Set(Position(offset.x * kBlockSide + x, offset.y * kBlockSide + y, offset.z * kBlockSide + z),
              block->tsdf->distance_m[static_cast<std::size_t>(linear)], kObserved);
        }
      }
    }
  }

  void Set(int position, float distance_m, Flag how) {
    distance_m_[static_cast<std::size_t>(position)] = distance_m;
    flags_[static_cast<std::size_t>(position)] =
        static_cast<std::uint8_t>(how | kHasValue | (distance_m < 0 ? kInside : 0));
  }

  /// Gives voxels that have an observed one among their 26 neighbours the average of what these expect there, the
  /// nearer the more.
  void Extrapolate() {
    std::vector<float> sum_m(kVoxels, 0), weight(kVoxels, 0);
    std::vector<int> reached;
    for (int z = -2; z < kTileVoxels + 2; ++z) {
      for (int y = -2; y < kTileVoxels + 2; ++y) {
        for (int x = -2; x < kTileVoxels + 2; ++x) {
          const int from = Position(x, y, z);
          if ((flags_[static_cast<std::size_t>(from)] & kObserved) == 0 || !IsAtBorder(from)) continue;
          const float here_m = At(from);
          Eigen::Vector3f slope;
          for (int i = 0; i < 3; ++i) slope[i] = Slope(At(from - kStride[i]), here_m, At(from + kStride[i]));
          for (int k = 0; k < 27; ++k) {
            const int dx = k % 3 - 1, dy = k / 3 % 3 - 1, dz = k / 9 - 1;
            const int to = from + dx * kStride[0] + dy * kStride[1] + dz * kStride[2];
            const auto t = static_cast<std::size_t>(to);
            if ((flags_[t] & kObserved) != 0) continue;
            if (weight[t] == 0) reached.push_back(to);
            const float nearness = 1.0f / static_cast<float>(dx * dx + dy * dy + dz * dz);
            sum_m[t] += nearness * (here_m + slope.dot(Eigen::Vector3f(static_cast<float>(dx), static_cast<float>(dy),
                                                                       static_cast<float>(dz))));
            weight[t] += nearness;
          }
        }
      }
    }
    for (const int to : reached) {
      const auto t = static_cast<std::size_t>(to);
      Set(to, sum_m[t] / weight[t], kHasValue);
    }
  }

  /// Whether one of the 26 neighbours is not observed.
  [[nodiscard]] bool IsAtBorder(int position) const {
    unsigned all = kObserved;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const std::uint8_t* row = &flags_[static_cast<std::size_t>(position + dy * kStride[1] + dz * kStride[2])];
        all &= row[-1] & row[0] & row[1];
      }
    }
    return all == 0;
  }

  std::vector<float> distance_m_;
  std::vector<std::uint8_t> flags_;
};

class TileMarcher {
 public:
  TileMarcher(const TileWindow& window, double voxel_size_m)
      : window_(window), voxel_size_m_(static_cast<float>(voxel_size_m)) {}

  std::vector<SurfaceTriangle> March() {
    for (int z = -1; z < kTileVoxels; ++z) {
      for (int y = -1; y < kTileVoxels; ++y) MarchRow(y, z);
    }
    return std::move(triangles_);
  }

 private:
  void MarchRow(int y, int z) {
    constexpr int kCorners = kTileVoxels + 2;
    std::array<std::uint8_t, kCorners> all, any;
    const std::uint8_t* row = window_.flags() + Position(-1, y, z);
    for (int x = 0; x < kCorners; ++x) {
      const std::uint8_t a = row[x], b = row[x + kStride[1]], c = row[x + kStride[2]],
                         d = row[x + kStride[1] + kStride[2]];
      all[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(a & b & c & d);
      any[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(a | b | c | d);
    }
    for (std::size_t x = 0; x + 1 < kCorners; ++x) {
      const unsigned every = all[x] & all[x + 1], some = any[x] | any[x + 1];
      if ((every & (kHasValue | kInside)) != kHasValue || (some & (kObserved | kInside)) != (kObserved | kInside)) {
        continue;
      }
      MarchCell({static_cast<int>(x) - 1, y, z});
    }
  }

  void MarchCell(VoxelIndex low) {
    const int position = Position(low.x, low.y, low.z);
    unsigned inside = 0;
    int first_observed = -1;
    for (int c = 0; c < kCellCorners; ++c) {
      const std::uint8_t flags = window_.flags()[CornerPosition(position, c)];
      if ((flags & kInside) != 0) inside |= 1u << c;
      if (first_observed < 0 && (flags & kObserved) != 0) first_observed = c;
    }
    const auto is_in_tile = [](int coordinate) { return coordinate >= 0 && coordinate < kTileVoxels; };
    if (!is_in_tile(low.x + (first_observed & 1)) || !is_in_tile(low.y + (first_observed >> 1 & 1)) ||
        !is_in_tile(low.z + (first_observed >> 2 & 1))) {
      return;
    }
    const CellCase& cell_case = CellCases()[inside];
    for (int k = 0; k < cell_case.num_triangles; ++k) {
      SurfaceTriangle& triangle = triangles_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = Crossing(low, position, cell_case.triangles[static_cast<std::size_t>(k)][i]);
      }
    }
  }

  [[nodiscard]] static int CornerPosition(int position, int corner) {
    return position + (corner & 1) * kStride[0] + (corner >> 1 & 1) * kStride[1] + (corner >> 2 & 1) * kStride[2];
  }

  /// Where the surface crosses an edge of a cell.
  [[nodiscard]] Eigen::Vector3f Crossing(VoxelIndex low, int position, int cell_edge) const {
    constexpr float kLeast = 1e-3f;  // in voxels, as in meshes
    const CellEdge edge = CellEdgeTable()[static_cast<std::size_t>(cell_edge)];
    const int start = CornerPosition(position, edge.corner);
    const float a = window_.At(start), b = window_.At(start + kStride[edge.axis]);
    Eigen::Vector3f p(static_cast<float>(low.x + (edge.corner & 1)), static_cast<float>(low.y + (edge.corner >> 1 & 1)),
                      static_cast<float>(low.z + (edge.corner >> 2 & 1)));
    p[edge.axis] += std::clamp(a / (a - b), kLeast, 1 - kLeast);
    return (p + Eigen::Vector3f::Constant(0.5f)) * voxel_size_m_;
  }

  const TileWindow& window_;
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

std::vector<SurfaceTriangle> ExtractTileSurface(const TileNeighbourhood& around, TileIndex tile, double voxel_size_m) {
  const TileWindow window(around, tile);
  return TileMarcher(window, voxel_size_m).March();
}

Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m) { return BlockCorner(BlockIn(tile, 0), voxel_size_m); }

}  // namespace dhpmap
