// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "mapping/submap/submap.h"
#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// Number of blocks of each layer of a submap, and the size of their blobs.
struct SubmapCounts {
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t num_gone_blocks = 0;
  std::int64_t blob_bytes = 0;
};

/// The stored form of a layer of objects: a blob for each tile that has it.
struct ObjectLayer {
  BlockLayer layer;
  std::uint8_t number;  ///< column tiles.layer: the high half of the first byte of its blobs; never reused
  std::string_view name;
  std::int64_t SubmapCounts::*count;  ///< null if no column counts it

  /// Encodes the layer of a tile, which has some of it, of `submap`.
  Bytes (*encode)(const BlockTile& tile, TileIndex index, const SubmapInfo& submap);
  /// Adds the layer to a tile. Errors as Unseal; the tile is then undefined.
  Status (*decode)(ByteView blob, TileIndex index, BlockTile& tile);
};

/// All of them, in the order of BlockLayer. A new layer is a line here, and one in ForEachLayer.
std::span<const ObjectLayer> ObjectLayers();
/// Null for a number unknown to this version.
const ObjectLayer* FindObjectLayer(std::int64_t number);

/// "submap 3: tsdf tile (1, -2, 0)", for messages.
std::string TileName(std::uint32_t submap_id, std::int64_t layer, TileIndex index);

/// For a whole submap; reads no blocks, and leaves blob_bytes at 0.
SubmapCounts CountBlocks(const Submap& submap);
/// Compares the block counts of all layers. DATA_LOSS, to be prefixed by the submap's name.
Status CheckCounts(const SubmapCounts& found, const SubmapCounts& stored);

}  // namespace dhpmap
