// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_window.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mapping/map/shown_mask.h"

namespace dhpmap {
namespace {

using Row = TileRoom::Row;
constexpr int kSide = TileRoom::kSide;
constexpr int kMargin = TileRoom::kMargin;

/// A voxel beside one.
struct Neighbour {
  int step;  ///< to it
  Eigen::Vector3f to_here_vox;
  float nearness;
};
using NeighbourTable = std::array<Neighbour, 27>;
/// By place, x fastest; that in the middle is none.
const NeighbourTable& Neighbours() {
  static const NeighbourTable neighbours = [] {
    NeighbourTable all;
    for (int k = 0; k < static_cast<int>(all.size()); ++k) {
      const Eigen::Vector3i offset(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      all[static_cast<std::size_t>(k)] = {offset.x() + kSide * offset.y() + kSide * kSide * offset.z(),
                                          -offset.cast<float>(), 1.0f / static_cast<float>(offset.squaredNorm())};
    }
    return all;
  }();
  return neighbours;
}

constexpr Row Bit(int x) { return Row{1} << x; }
constexpr Row From(int first) { return ~Row{0} << first; }
constexpr Row kCornerRow = From(kMargin - 1) & ~From(kMargin + TileRoom::kTileVoxels + 1);  ///< that cells may have

/// The same and all that are next to one of them, along x and y, then along z. Beside the last row of a plane is the
/// first of the next: what lies there is no corner of any cell.
void Widen(const TileRoom::Rows& rows, TileRoom::Rows& wider) {
  const auto along_x = [&](std::size_t i) { return rows[i] | rows[i] << 1 | rows[i] >> 1; };
  for (std::size_t i = 1; i + 1 < TileRoom::kRows; ++i) wider[i] = along_x(i - 1) | along_x(i) | along_x(i + 1);
}
Row WidenedInZ(const TileRoom::Rows& rows, std::size_t i) { return rows[i - kSide] | rows[i] | rows[i + kSide]; }

}  // namespace

TileWindow::TileWindow(TileRoom& room, const TileBlocks& blocks) : room_(room) {
  for (TileRoom::Rows* rows : {&room.observed, &room.inside, &room.contradicted, &room.extrapolated}) {
    std::fill(rows->begin(), rows->end(), Row{0});
  }
  for (int i = 0; i < static_cast<int>(blocks.size()); ++i) {
    if (const BlockEntry* block = blocks[static_cast<std::size_t>(i)]) CopyBlock(*block, OffsetInTile(i));
  }
  FindSides();
  if (has_both_sides_) ConcludeSides();
}

/// `offset`: in blocks, from the tile's first.
void TileWindow::CopyBlock(const BlockEntry& block, BlockIndex offset) {
  const auto begin = [](int d) { return d < 0 ? kBlockSide - kMargin : 0; };
  const auto end = [](int d) { return d == kTileSide ? kMargin : kBlockSide; };
  const VoxelMask contradicted = block.gone != nullptr ? block.gone->Contradicted() : VoxelMask{};
  const int first_x = begin(offset.x), count = end(offset.x) - first_x;
  const int to_x = offset.x * kBlockSide + first_x + kMargin;
  const std::uint64_t wanted = (std::uint64_t{1} << count) - 1;
  for (int z = begin(offset.z); z < end(offset.z); ++z) {
    const std::size_t first = static_cast<std::size_t>(LinearIndex({0, 0, z}));
    const std::uint64_t gone = contradicted[static_cast<std::size_t>(z)];
    const std::uint64_t shown =
        LayerWhere(&block.tsdf->weight[first], [](float weight) { return weight >= kMinObservedWeight; }) & ~gone;
    if ((shown | gone) == 0) continue;
    const std::uint64_t inside =
        LayerWhere(&block.tsdf->distance_m[first], [](float distance_m) { return distance_m < 0; }) & shown;
    for (int y = begin(offset.y); y < end(offset.y); ++y) {
      const std::size_t row = RowAt(offset.y * kBlockSide + y, offset.z * kBlockSide + z);
      const int shift = kBlockSide * y + first_x;
      room_.observed[row] |= (shown >> shift & wanted) << to_x;
      room_.inside[row] |= (inside >> shift & wanted) << to_x;
      room_.contradicted[row] |= (gone >> shift & wanted) << to_x;
      std::copy_n(&block.tsdf->distance_m[first + static_cast<std::size_t>(shift)], count,
                  &room_.distance_m[row * kSide + static_cast<std::size_t>(to_x)]);
    }
  }
}

/// The observed voxels of a row that have others among their neighbours.
Row TileWindow::Rim(int y, int z) const {
  const Row here = room_.observed[RowAt(y, z)];
  if (here == 0) return 0;
  Row all = ~Row{0};
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) all &= room_.observed[RowAt(y + dy, z + dz)];
  }
  const Row within = all & all << 1 & all >> 1;
  return here & ~within & From(1) & ~From(kSide - 1);  // beyond is nothing that was observed there
}

/// As Slope is of distances, and NaN for those that were not observed. `x`: in the row.
Eigen::Vector3f TileWindow::SlopeAt(std::size_t row, int x) const {
  const float* here = &room_.distance_m[row * kSide + static_cast<std::size_t>(x)];
  const auto slope = [&](Row below, Row above, std::ptrdiff_t step) {
    const float from = (below & 1) != 0 ? here[-step] : *here, to = (above & 1) != 0 ? here[step] : *here;
    return (below & above & 1) != 0 ? 0.5f * (to - from) : to - from;
  };
  const Row* observed = &room_.observed[row];
  return {slope(*observed >> (x - 1), *observed >> (x + 1), 1), slope(observed[-1] >> x, observed[1] >> x, kSide),
          slope(observed[-kSide] >> x, observed[kSide] >> x, std::ptrdiff_t{kSide} * kSide)};
}

/// What is in front of the surface or expects others in front of it, and what is behind: one that is so close that it
/// may expect either, both.
void TileWindow::FindSides() {
  Row any_in_front = 0, any_behind = 0;
  for (std::size_t row = 0; row < TileRoom::kRows; ++row) {
    any_in_front |= room_.in_front[row] = room_.observed[row] & ~room_.inside[row];
    any_behind |= room_.behind[row] = room_.inside[row];
  }
  for (int z = -2; z < TileRoom::kTileVoxels + 2; ++z) {
    for (int y = -2; y < TileRoom::kTileVoxels + 2; ++y) {
      const std::size_t row = RowAt(y, z);
      for (Row rim = Rim(y, z); rim != 0; rim &= rim - 1) {
        const int x = std::countr_zero(rim);
        constexpr float kRounding = 1.001f;
        const std::size_t at = row * kSide + static_cast<std::size_t>(x);
        const Eigen::Vector3f slope = room_.slope[at] = SlopeAt(row, x);
        if (std::abs(room_.distance_m[at]) > kRounding * slope.lpNorm<1>()) continue;
        any_in_front |= room_.in_front[row] |= Bit(x);
        any_behind |= room_.behind[row] |= Bit(x);
      }
    }
  }
  has_both_sides_ = any_in_front != 0 && any_behind != 0;
}

/// On which side those are that are extrapolated: where all expect the same, that, else as they turn out.
void TileWindow::ConcludeSides() {
  Widen(room_.in_front, room_.wider);
  for (std::size_t row = kSide; row + kSide < TileRoom::kRows; ++row)
    room_.in_front[row] = WidenedInZ(room_.wider, row);
  Widen(room_.behind, room_.wider);
  for (int z = -1; z <= TileRoom::kTileVoxels; ++z) {
    for (int y = -1; y <= TileRoom::kTileVoxels; ++y) {
      const std::size_t row = RowAt(y, z);
      const Row open = ~(room_.observed[row] | room_.contradicted[row]) & kCornerRow;
      const Row in_front = room_.in_front[row] & open, behind = WidenedInZ(room_.wider, row) & open;
      room_.in_front[row] = (in_front & ~behind) | (room_.observed[row] & ~room_.inside[row]);
      room_.inside[row] |= behind & ~in_front;
      for (Row unsure = in_front & behind; unsure != 0; unsure &= unsure - 1) {
        const int x = std::countr_zero(unsure);
        Extrapolate(row, x);
        const bool is_inside = room_.distance_m[row * kSide + static_cast<std::size_t>(x)] < 0;
        (is_inside ? room_.inside : room_.in_front)[row] |= Bit(x);
      }
    }
  }
}

/// The average of what those around expect, that were observed.
void TileWindow::Extrapolate(std::size_t row, int x) {
  unsigned observed = 0;  // bit k is of neighbour k
  for (int i = 0; i < 9; ++i) {
    const std::size_t beside = row + static_cast<std::size_t>(i % 3 - 1 + kSide * (i / 3 - 1));
    observed |= static_cast<unsigned>(room_.observed[beside] >> (x - 1) & 7) << 3 * i;
  }
  float sum_m = 0, weight = 0;
  for (; observed != 0; observed &= observed - 1) {
    const Neighbour& neighbour = Neighbours()[static_cast<std::size_t>(std::countr_zero(observed))];
    const std::size_t from = row * kSide + static_cast<std::size_t>(x + neighbour.step);
    sum_m += neighbour.nearness * (room_.distance_m[from] + room_.slope[from].dot(neighbour.to_here_vox));
    weight += neighbour.nearness;
  }
  room_.distance_m[row * kSide + static_cast<std::size_t>(x)] = sum_m / weight;
  room_.extrapolated[row] |= Bit(x);
}

}  // namespace dhpmap
