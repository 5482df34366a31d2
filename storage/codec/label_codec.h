// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/voxels/label_block.h"
#include "storage/codec/bytes.h"
#include "storage/codec/tile_blocks.h"

namespace dhpmap {

/// Encodes the labels of a tile's blocks, of which there are some, without loss, and the same counts always as the same
/// bytes. Id 0 of an instance list stays "the submap that holds this voxel". `index` goes into the checksum.
/// Thread-safe.
Bytes EncodeLabelTile(const LayerBlocks<LabelBlock>& blocks, TileIndex index);

/// Fills `blocks`, whatever they were. Errors as Unseal.
Status DecodeLabelTile(ByteView blob, TileIndex index, LayerBlocks<LabelBlock>& blocks);

// One block, as schemas 1 to 6 stored it: with the same promises.
Bytes EncodeLabelBlock(const LabelBlock& block, BlockIndex index);
Status DecodeLabelBlock(ByteView blob, BlockIndex index, LabelBlock& block);

}  // namespace dhpmap
