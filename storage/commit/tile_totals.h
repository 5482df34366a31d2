// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

// Rows of tiles, as every store of tiles has them.

/// The blob of a tile's row.
struct StoredBlob {
  std::int64_t key = 0;         ///< 0: there is no row
  std::int64_t num_blocks = 0;  ///< in the blob; 0 for layers of maps
  std::int64_t bytes = 0;
  std::uint64_t cells = 0;   ///< bit c: the blob has a block at cell c; 0: unknown, or a layer of maps
  std::uint64_t extent = 0;  ///< of a TSDF: TileExtent::Code; 0: unknown, or another layer
};

inline constexpr std::size_t kNumLayerNumbers = 16;  ///< a layer's number is half a byte
/// The rows of a tile, by the number of the layer.
using StoredLayers = std::array<StoredBlob, kNumLayerNumbers>;

/// Totals of all rows of an owner, updated incrementally. `sum` covers the set of rows and their references,
/// independent of their order, so a commit updates it in time linear in its writes.
struct TileTotals {
  std::int64_t num_rows = 0;
  std::int64_t bytes = 0;
  std::int64_t sum = 0;  ///< as columns tiles_sum, see FORMAT.md

  void Add(TileIndex index, std::int64_t layer, const StoredBlob& blob);
  void Remove(TileIndex index, std::int64_t layer, const StoredBlob& blob);
};

/// A row of an owner, with its blob.
struct TileRow {
  TileIndex index;
  std::int64_t layer = 0;
  std::int64_t blob_key = 0;
  std::int64_t num_blocks = 0;
  bool is_missing = false;              ///< there is no such blob
  bool is_shared = false;               ///< other rows refer to it, too
  std::uint64_t cells = 0, extent = 0;  ///< see StoredBlob
  ByteView blob;                        ///< valid during the visit
};

}  // namespace dhpmap
