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

/// How many blocks of each layer a submap has, and the size of their blobs.
struct SubmapCounts {
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t num_gone_blocks = 0;
  std::int64_t blob_bytes = 0;
};

/// A layer of objects as it is stored: a blob for each tile that has something of it.
struct ObjectLayer {
  BlockLayer layer;
  std::uint8_t number;  ///< column tiles.layer: the high half of the first byte of its blobs. Kept in files.
  std::string_view name;
  std::int64_t SubmapCounts::*count;  ///< null for a layer that no column counts

  /// The layer of a tile that has some of it, whose blocks are of `submap`.
  Bytes (*encode)(const BlockTile& tile, TileIndex index, const SubmapInfo& submap);
  /// Adds the layer to what a tile has. Errors as Unseal; then what was added is undefined.
  Status (*decode)(ByteView blob, TileIndex index, BlockTile& tile);
};

/// All of them, in the order of BlockLayer. A new layer is a line here, and one in ForEachLayer.
std::span<const ObjectLayer> ObjectLayers();
/// Null for a number unknown to this version.
const ObjectLayer* FindObjectLayer(std::int64_t number);

/// "submap 3: tsdf tile (1, -2, 0)", for messages.
std::string TileName(std::uint32_t submap_id, std::int64_t layer, TileIndex index);

/// Of all of a submap; reads no blocks, and leaves blob_bytes at 0.
SubmapCounts CountBlocks(const Submap& submap);
/// Whether as many blocks of each layer are there as are said to be. DATA_LOSS, to be put behind the submap's name.
Status CheckCounts(const SubmapCounts& found, const SubmapCounts& stored);

}  // namespace dhpmap
