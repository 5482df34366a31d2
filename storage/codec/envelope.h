// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/grid.h"
#include "mapping/base/status.h"
#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// First byte of a blob: which layer (high half), and the version of its codec (low half). Kept in files: numbers are
/// never reused.
enum class BlobKind : std::uint8_t {
  // A layer of one block: until schema 6, and inside tiles of those days.
  kTsdfV1 = 0x11,
  kLabelsV1 = 0x21,
  kGoneV1 = 0x41,
  // A layer of a tile.
  kTsdfTile = 0x12,
  kLabelsTile = 0x22,
  kFreeV1 = 0x31,
  kGoneTile = 0x42,
  kVacatedV1 = 0x51,
  // A tile of blobs of blocks, as they were when they were a row each.
  kTsdfBlocks = 0x1F,
  kLabelsBlocks = 0x2F,
  kGoneBlocks = 0x4F,
  kChangeV1 = 0x61,       // what a commit changed
  kChangeV2 = 0x62,       // with which submaps are locked
  kChangeV3 = 0x63,       // with regions; written only where there are any
  kChangeV4 = 0x64,       // with boxes of what was moved; written only where there are any
  kEditSummaryV1 = 0x71,  // what an edit did
  kEditSummaryV2 = 0x72,  // with the revision that it went back to; written only where there is one
  kEditRowsV1 = 0x81,     // rows before and after an edit
  kEditRowsV2 = 0x82,     // with what sessions know of them
  kEditRowsV3 = 0x83,     // with which are locked, and regions that are kept clear
};

/// Which layer a kind is of.
constexpr std::uint8_t LayerNumber(BlobKind kind) { return static_cast<std::uint8_t>(kind) >> 4; }

/// What a codec puts into a blob. Noise goes into `plain`: compressing it would only cost time and Huffman tables.
struct Payload {
  Bytes packable;
  Bytes plain;
};

/// What blobs of tiles are sealed for: checksums cover three numbers, and what they count is the kind's own matter.
constexpr BlockIndex SealIndexOf(TileIndex tile) { return {tile.x, tile.y, tile.z}; }
/// What is of a revision is sealed for its halves.
constexpr BlockIndex SealIndexOf(std::int64_t revision) {
  return {static_cast<std::int32_t>(revision), static_cast<std::int32_t>(revision >> 32), 0};
}

/// Wraps a payload: kind, plain part, packable part (with zstd if that makes it smaller), and a CRC-32C over the
/// block's index and all of that, so that neither a flipped byte nor a blob under another block's key goes unseen. See
/// FORMAT.md.
Bytes Seal(BlobKind kind, BlockIndex index, const Payload& payload);

/// Undoes Seal. DATA_LOSS for anything Seal did not make for this index, FAILED_PRECONDITION for an intact blob of a
/// version of its layer's codec that this version does not know. Messages go on after "it". Takes no more memory than
/// Seal's caller had.
Status Unseal(BlobKind kind, BlockIndex index, ByteView blob, Payload& payload);

/// The kind that a blob says it is of, unchecked; 0 if it is empty.
inline std::uint8_t KindByte(ByteView blob) { return blob.empty() ? std::uint8_t{0} : blob[0]; }

}  // namespace dhpmap
