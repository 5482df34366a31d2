// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/free/free_tile.h"
#include "storage/codec/bytes.h"
#include "storage/codec/envelope.h"

namespace dhpmap {

// Blobs of kinds kFreeV1 and kVacatedV1, which are alike but for that.

/// A tile of voxels as a blob, see FORMAT.md. Equal tiles give equal bytes. `tile` is not empty.
Bytes EncodeFreeTile(BlobKind kind, const FreeTile& tile, TileIndex index);

/// The tile exactly as it was encoded. DATA_LOSS for anything that EncodeFreeTile did not make of this kind for this
/// index, FAILED_PRECONDITION for a later version of it. Messages go on after "it".
Status DecodeFreeTile(BlobKind kind, ByteView blob, TileIndex index, FreeTile& tile);

}  // namespace dhpmap
