// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/free/free_tile.h"
#include "storage/codec/bytes.h"
#include "storage/codec/envelope.h"

namespace dhpmap {

// Blobs of kinds kFreeV1 and kVacatedV1, which differ only in kind.

/// A tile as a blob, see FORMAT.md. Equal tiles give equal bytes. `tile` is not empty.
Bytes EncodeFreeTile(BlobKind kind, const FreeTile& tile, TileIndex index);

/// Exact inverse. DATA_LOSS for anything that EncodeFreeTile did not write with this kind and index,
/// FAILED_PRECONDITION for a later version. Messages continue after "it".
Status DecodeFreeTile(BlobKind kind, ByteView blob, TileIndex index, FreeTile& tile);

}  // namespace dhpmap
