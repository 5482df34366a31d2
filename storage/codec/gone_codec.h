// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/voxels/gone_block.h"
#include "storage/codec/bytes.h"
#include "storage/codec/tile_blocks.h"

namespace dhpmap {

/// What was looked through of a tile's blocks, of which there are some, as a blob, see FORMAT.md. Equal blocks give
/// equal bytes. None is empty. Thread-safe.
Bytes EncodeGoneTile(const LayerBlocks<GoneBlock>& blocks, TileIndex index);

/// Fills `blocks`, whatever they were, exactly as they were encoded. Errors as Unseal.
Status DecodeGoneTile(ByteView blob, TileIndex index, LayerBlocks<GoneBlock>& blocks);

// One block, as schemas 5 and 6 stored it: with the same promises.
Bytes EncodeGoneBlock(const GoneBlock& block, BlockIndex index);
Status DecodeGoneBlock(ByteView blob, BlockIndex index, GoneBlock& block);

}  // namespace dhpmap
