// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/voxels/tsdf_block.h"
#include "storage/codec/bytes.h"
#include "storage/codec/tile_blocks.h"

namespace dhpmap {

/// Encodes the TSDF of a tile's blocks, of which there are some. What decoding gives back:
///   the same voxels are observed, and those that are not are all zero;
///   distances are within truncation_m / 16384, weights within a share of 2^-16, colours exact.
/// A distance of four truncations or more, or not finite, keeps all of the block's distances exact. Encoding what was
/// decoded gives the same bytes. `index` goes into the checksum. Thread-safe.
Bytes EncodeTsdfTile(const LayerBlocks<TsdfBlock>& blocks, TileIndex index, double truncation_m);

/// Fills `blocks`, whatever they were. Errors as Unseal.
Status DecodeTsdfTile(ByteView blob, TileIndex index, LayerBlocks<TsdfBlock>& blocks);

// One block, as schemas 1 to 6 stored it: with the same promises.
Bytes EncodeTsdfBlock(const TsdfBlock& block, BlockIndex index, double truncation_m);
Status DecodeTsdfBlock(ByteView blob, BlockIndex index, TsdfBlock& block);

}  // namespace dhpmap
