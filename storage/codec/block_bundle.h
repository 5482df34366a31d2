// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "mapping/base/status.h"
#include "storage/codec/bytes.h"
#include "storage/codec/envelope.h"

namespace dhpmap {

// A tile made of the blobs of its blocks, as they were when each was a row of its own (schemas 1 to 6): what a database
// of those days is brought up to date with, good and damaged ones alike, without decoding any.

/// A blob, and the cell of its block in the tile.
struct BundledBlob {
  int cell = 0;
  Bytes blob;
};

/// `blobs` by ascending cell, of which there are some. `kind`: one of the kinds of tiles of blobs of blocks.
Bytes EncodeBundle(BlobKind kind, const std::vector<BundledBlob>& blobs, TileIndex index);

/// The blobs as they were. Errors as Unseal; those inside are not looked at.
Status DecodeBundle(BlobKind kind, ByteView blob, TileIndex index, std::vector<BundledBlob>& blobs);

}  // namespace dhpmap
