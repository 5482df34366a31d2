// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/voxels/tsdf_block.h"
#include "storage/codec/bytes.h"
#include "storage/codec/tile_blocks.h"

namespace dhpmap {

/// Encodes the TSDF of a tile's blocks (at least one). After decoding:
///   - the same voxels are observed, and unobserved ones are all zero;
///   - distances are within truncation_m / 16384, weights have a relative error of at most 2^-16, colours are exact.
///
/// A distance of four truncations or more, or not finite, makes all distances of its block exact. Encoding a decoded
/// tile gives the same bytes. The checksum covers `index`. Thread-safe.
Bytes EncodeTsdfTile(const LayerBlocks<TsdfBlock>& blocks, TileIndex index, double truncation_m);

/// Inverse; overwrites `blocks`. Errors as Unseal.
Status DecodeTsdfTile(ByteView blob, TileIndex index, LayerBlocks<TsdfBlock>& blocks);

// One block, as in schemas 1 to 6: the same guarantees.
Bytes EncodeTsdfBlock(const TsdfBlock& block, BlockIndex index, double truncation_m);
Status DecodeTsdfBlock(ByteView blob, BlockIndex index, TsdfBlock& block);

}  // namespace dhpmap
