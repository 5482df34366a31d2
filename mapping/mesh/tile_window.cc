// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_window.h"

#include <algorithm>
#include <bit>

#include "mapping/voxels/shown_mask.h"

namespace dhpmap {
namespace {

using Row = TileRoom::Row;
constexpr int kMargin = TileRoom::kMargin;

/// Calls visit(row, shown, inside, to_x, distances) for each row along x of a block that lies in the window; `offset`
/// is in blocks from the tile's first. Bits from `to_x` on: voxels that are shown, and those with a negative distance;
/// then all distances.
template <typename Visitor>
void ForEachRow(const BlockEntry& block, BlockIndex offset, Visitor&& visit) {
  const auto begin = [](int d) { return d < 0 ? kBlockSide - kMargin : 0; };
  const auto end = [](int d) { return d == kTileSide ? kMargin : kBlockSide; };
  const VoxelMask contradicted = block.gone != nullptr ? block.gone->Contradicted() : VoxelMask{};
  const int first_x = begin(offset.x), count = end(offset.x) - first_x;
  const int to_x = offset.x * kBlockSide + first_x + kMargin;
  const Row wanted = (Row{1} << count) - 1;
  for (int z = begin(offset.z); z < end(offset.z); ++z) {
    const auto first = static_cast<std::size_t>(LinearIndex({0, 0, z}));
    const std::uint64_t shown =
        LayerWhere(&block.tsdf->weight[first], [](float weight) { return weight >= kMinObservedWeight; }) &
        ~contradicted[static_cast<std::size_t>(z)];
    if (shown == 0) continue;
    const std::uint64_t inside =
        LayerWhere(&block.tsdf->distance_m[first], [](float distance_m) { return distance_m < 0; }) & shown;
    for (int y = begin(offset.y); y < end(offset.y); ++y) {
      const int shift = kBlockSide * y + first_x;
      const Row here = shown >> shift & wanted;
      if (here == 0) continue;
      visit(TileWindow::RowAt(offset.y * kBlockSide + y, offset.z * kBlockSide + z), here, inside >> shift & wanted,
            to_x, &block.tsdf->distance_m[first + static_cast<std::size_t>(shift)], count);
    }
  }
}

}  // namespace

TileWindow::TileWindow(TileRoom& room, const TileBlocks& own, std::span<const TileOwner> sharers) : room_(room) {
  for (TileRoom::Rows* rows : {&room.own, &room.shared, &room.inside}) std::fill(rows->begin(), rows->end(), Row{0});
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i] != nullptr) CopyOwn(*own[i], OffsetInTile(static_cast<int>(i)));
  }
  for (std::size_t k = 0; k < sharers.size(); ++k) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      const BlockEntry* block = sharers[k].blocks[i];
      if (block != nullptr) CopyShared(*block, OffsetInTile(static_cast<int>(i)), static_cast<std::uint16_t>(k));
    }
  }
  FindSides();
}

void TileWindow::CopyOwn(const BlockEntry& block, BlockIndex offset) {
  ForEachRow(block, offset, [&](std::size_t row, Row shown, Row inside, int to_x, const float* distance_m, int count) {
    room_.own[row] |= shown << to_x;
    room_.inside[row] |= inside << to_x;
    std::copy_n(distance_m, count, &room_.distance_m[PlaceOf(row, to_x)]);
  });
}

/// Copies only voxels that no earlier submap shows.
void TileWindow::CopyShared(const BlockEntry& block, BlockIndex offset, std::uint16_t sharer) {
  ForEachRow(block, offset, [&](std::size_t row, Row shown, Row inside, int to_x, const float* distance_m, int) {
    const Row fresh = (shown << to_x) & ~Known(row);
    room_.shared[row] |= fresh;
    room_.inside[row] |= (inside << to_x) & fresh;
    for (Row left = fresh; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      room_.distance_m[PlaceOf(row, x)] = distance_m[x - to_x];
      room_.sharer[PlaceOf(row, x)] = sharer;
    }
  });
}

void TileWindow::FindSides() {
  Row any_in_front = 0, any_behind = 0;
  for (std::size_t row = 0; row < TileRoom::kRows; ++row) {
    any_in_front |= Known(row) & ~room_.inside[row];
    any_behind |= room_.inside[row];
  }
  has_both_sides_ = any_in_front != 0 && any_behind != 0;
}

}  // namespace dhpmap
