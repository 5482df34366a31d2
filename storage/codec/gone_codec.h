// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/voxels/gone_block.h"
#include "storage/codec/bytes.h"
#include "storage/codec/tile_blocks.h"

namespace dhpmap {

/// The gone layer of a tile's blocks as a blob, see FORMAT.md. At least one block, none empty. Equal blocks give equal
/// bytes. Thread-safe.
Bytes EncodeGoneTile(const LayerBlocks<GoneBlock>& blocks, TileIndex index);

/// Exact inverse; overwrites `blocks`. Errors as Unseal.
Status DecodeGoneTile(ByteView blob, TileIndex index, LayerBlocks<GoneBlock>& blocks);

// One block, as in schemas 5 and 6: the same guarantees.
Bytes EncodeGoneBlock(const GoneBlock& block, BlockIndex index);
Status DecodeGoneBlock(ByteView blob, BlockIndex index, GoneBlock& block);

}  // namespace dhpmap
