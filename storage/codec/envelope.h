// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/grid.h"
#include "mapping/base/status.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// First byte of a blob: which layer (high half), and the version of its codec (low half). Kept in files: numbers are
/// never reused.
enum class BlobKind : std::uint8_t {
  kTsdfV1 = 0x11,
  kLabelsV1 = 0x21,
  kLabelsV2 = 0x22,  ///< with what is concluded
  kFreeV1 = 0x31,
  kGoneV1 = 0x41,
  kVacatedV1 = 0x51
};

/// What a codec puts into a blob. Noise goes into `plain`: compressing it would only cost time and Huffman tables.
struct Payload {
  Bytes packable;
  Bytes plain;
};

/// Wraps a payload: kind, plain part, packable part (with zstd if that makes it smaller), and a CRC-32C over the
/// block's index and all of that, so that neither a flipped byte nor a blob under another block's key goes unseen. See
/// FORMAT.md.
Bytes Seal(BlobKind kind, BlockIndex index, const Payload& payload);

/// Undoes Seal. DATA_LOSS for anything Seal did not make for this index, FAILED_PRECONDITION for an intact blob of a
/// version of its layer's codec that this version does not know. Messages go on after "it". Takes no more memory than
/// Seal's caller had.
Status Unseal(BlobKind kind, BlockIndex index, ByteView blob, Payload& payload);

}  // namespace dhpmap
