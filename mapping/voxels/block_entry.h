// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "mapping/base/grid.h"
#include "mapping/voxels/gone_block.h"
#include "mapping/voxels/label_block.h"
#include "mapping/voxels/tsdf_block.h"

namespace dhpmap {

/// One block of a submap: its layers, shared with every snapshot of the same state. `labels` is null if the block was
/// never labelled (the unknown submap, dropped labels), `gone` if no sensor has looked through it.
struct BlockEntry {
  BlockIndex index;
  // Set by the writer on layers that it allocated since it took over the tile: no snapshot shares them.
  bool owns_tsdf = false;
  bool owns_labels = false;
  bool owns_gone = false;
  // Set in place of the above when the map is forked to be written in place: only that fork shares the layer
  // (Map::ForkInPlace).
  bool owned_tsdf = false;
  bool owned_labels = false;
  std::shared_ptr<const TsdfBlock> tsdf;
  std::shared_ptr<const LabelBlock> labels;
  std::shared_ptr<const GoneBlock> gone;

  /// Whether sensors have looked through a voxel so often that its TSDF no longer holds.
  [[nodiscard]] bool IsContradicted(int linear) const { return gone != nullptr && gone->IsContradicted(linear); }
  /// Whether a voxel has valid surface data: observed, and not contradicted since. Needs a TSDF.
  [[nodiscard]] bool Shows(int linear) const { return tsdf->IsObserved(linear) && !IsContradicted(linear); }
};

/// Sum of LabelBlock::CountedBytes over blocks.
template <typename Blocks>
std::size_t LabelPlaneBytesOf(const Blocks& blocks) {
  std::size_t bytes = 0;
  for (const BlockEntry& block : blocks) bytes += block.labels != nullptr ? block.labels->CountedBytes() : 0;
  return bytes;
}

/// The layers of a block.
enum class BlockLayer : std::uint8_t { kTsdf, kLabels, kGone };
inline constexpr std::size_t kNumBlockLayers = 3;
/// A set of layers, indexed by number.
using BlockLayers = std::array<bool, kNumBlockLayers>;

/// The one list of layers: calls visit(layer, part...) for each, with that layer of each of `blocks`: a BlockEntry, or
/// any type with members of these names.
template <typename Visitor, typename... Blocks>
void ForEachLayer(Visitor&& visit, Blocks&... blocks) {
  visit(BlockLayer::kTsdf, blocks.tsdf...);
  visit(BlockLayer::kLabels, blocks.labels...);
  visit(BlockLayer::kGone, blocks.gone...);
}

// A tile is a cube of 4 x 4 x 4 blocks, the unit of copy-on-write between a writer and published states. Surfaces fill
// 10 to 20 blocks of a tile.
inline constexpr int kTileSideLog2 = 2;
inline constexpr int kTileSide = 1 << kTileSideLog2;
inline constexpr int kTileBlocks = kTileSide * kTileSide * kTileSide;

struct TileIndex {
  std::int32_t x = 0, y = 0, z = 0;
  constexpr auto operator<=>(const TileIndex&) const = default;
};

constexpr TileIndex TileOf(BlockIndex b) { return {b.x >> kTileSideLog2, b.y >> kTileSideLog2, b.z >> kTileSideLog2}; }

/// Position of a block in its tile: x fastest, then y, then z.
constexpr int CellOf(BlockIndex b) {
  constexpr int mask = kTileSide - 1;
  return (b.x & mask) | ((b.y & mask) << kTileSideLog2) | ((b.z & mask) << (2 * kTileSideLog2));
}

/// Inverse of TileOf and CellOf taken together.
constexpr BlockIndex BlockIn(TileIndex t, int cell) {
  constexpr int mask = kTileSide - 1;
  return {(t.x << kTileSideLog2) + (cell & mask), (t.y << kTileSideLog2) + ((cell >> kTileSideLog2) & mask),
          (t.z << kTileSideLog2) + (cell >> (2 * kTileSideLog2))};
}

}  // namespace dhpmap
