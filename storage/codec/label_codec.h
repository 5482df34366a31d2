// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/voxels/label_block.h"
#include "storage/codec/bytes.h"
#include "storage/codec/tile_blocks.h"

namespace dhpmap {

/// Encodes the labels of a tile's blocks (at least one) without loss; equal counts give equal bytes. Id 0 of an
/// instance list means "the submap that holds this voxel". The checksum covers `index`. Thread-safe.
Bytes EncodeLabelTile(const LayerBlocks<LabelBlock>& blocks, TileIndex index);

/// Inverse; overwrites `blocks`. Errors as Unseal.
Status DecodeLabelTile(ByteView blob, TileIndex index, LayerBlocks<LabelBlock>& blocks);

// One block, as in schemas 1 to 6: the same guarantees.
Bytes EncodeLabelBlock(const LabelBlock& block, BlockIndex index);
Status DecodeLabelBlock(ByteView blob, BlockIndex index, LabelBlock& block);

}  // namespace dhpmap
