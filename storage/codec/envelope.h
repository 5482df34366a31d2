// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/grid.h"
#include "mapping/base/status.h"
#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// First byte of a blob: its layer (high half) and the version of its codec (low half). Stored: numbers are never
/// reused.
enum class BlobKind : std::uint8_t {
  // A layer of one block: until schema 6, and inside bundles.
  kTsdfV1 = 0x11,
  kLabelsV1 = 0x21,
  kGoneV1 = 0x41,
  // A layer of a tile.
  kTsdfTile = 0x12,
  kLabelsTile = 0x22,
  kFreeV1 = 0x31,
  kGoneTile = 0x42,
  kVacatedV1 = 0x51,
  // A bundle: a tile of blobs of single blocks.
  kTsdfBlocks = 0x1F,
  kLabelsBlocks = 0x2F,
  kGoneBlocks = 0x4F,
  kChangeV1 = 0x61,       // changes of a commit
  kChangeV2 = 0x62,       // with locks of submaps
  kChangeV3 = 0x63,       // with regions; written only if there are any
  kChangeV4 = 0x64,       // with boxes of moved objects; written only if there are any
  kEditSummaryV1 = 0x71,  // summary of an edit
  kEditSummaryV2 = 0x72,  // with the restored revision; written only if there is one
  kEditRowsV1 = 0x81,     // rows before and after an edit
  kEditRowsV2 = 0x82,     // with their sightings
  kEditRowsV3 = 0x83,     // with locks and ignored regions
};

/// The layer of a kind.
constexpr std::uint8_t LayerNumber(BlobKind kind) { return static_cast<std::uint8_t>(kind) >> 4; }

/// Content of a blob. Noise goes into `plain`: compressing it only costs time and Huffman tables.
struct Payload {
  Bytes packable;
  Bytes plain;
};

/// Seal context of tiles: checksums cover three numbers, with a meaning by kind.
constexpr BlockIndex SealIndexOf(TileIndex tile) { return {tile.x, tile.y, tile.z}; }
/// Seal context of a revision: its halves.
constexpr BlockIndex SealIndexOf(std::int64_t revision) {
  return {static_cast<std::int32_t>(revision), static_cast<std::int32_t>(revision >> 32), 0};
}

/// Wraps a payload: kind, plain part, packable part (zstd if smaller), and a CRC-32C over the context and all of these,
/// which detects flipped bytes and blobs under a wrong key. See FORMAT.md.
Bytes Seal(BlobKind kind, BlockIndex index, const Payload& payload);

/// Inverse of Seal. DATA_LOSS for anything that Seal did not write for this context, FAILED_PRECONDITION for an intact
/// blob of a later version of the layer's codec. Messages continue after "it". Needs no more memory than Seal's caller.
Status Unseal(BlobKind kind, BlockIndex index, ByteView blob, Payload& payload);

/// The unverified kind of a blob; 0 if it is empty.
inline std::uint8_t KindByte(ByteView blob) { return blob.empty() ? std::uint8_t{0} : blob[0]; }

}  // namespace dhpmap
