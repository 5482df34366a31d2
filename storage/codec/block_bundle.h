// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "mapping/base/status.h"
#include "storage/codec/bytes.h"
#include "storage/codec/envelope.h"

namespace dhpmap {

// A tile made of the unchanged blobs of its blocks, each of which was a row in schemas 1 to 6. Migrates such a database
// without decoding blobs, intact or damaged.

/// A blob, and its block's cell in the tile.
struct BundledBlob {
  int cell = 0;
  Bytes blob;
};

/// `blobs`: not empty, by ascending cell. `kind`: a kind for bundles.
Bytes EncodeBundle(BlobKind kind, const std::vector<BundledBlob>& blobs, TileIndex index);

/// The blobs, unchanged and not verified. Errors as Unseal.
Status DecodeBundle(BlobKind kind, ByteView blob, TileIndex index, std::vector<BundledBlob>& blobs);

}  // namespace dhpmap
