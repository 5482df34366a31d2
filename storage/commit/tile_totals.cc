// SPDX-License-Identifier: BSD-3-Clause
#include "storage/commit/tile_totals.h"

namespace dhpmap {
namespace {

/// The finalizer of SplitMix64: each bit of the result depends on the whole word.
std::uint64_t Mix(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9u;
  word = (word ^ (word >> 27)) * 0x94D049BB133111EBu;
  return word ^ (word >> 31);
}

/// Sums of these hashes identify sets of rows. The checksum of blobs is linear, so errors could cancel out.
std::uint64_t HashOf(TileIndex index, std::int64_t layer, std::int64_t blob_key) {
  std::uint64_t hash = 0;
  for (const std::int64_t value :
       {std::int64_t{index.x}, std::int64_t{index.y}, std::int64_t{index.z}, layer, blob_key}) {
    hash = Mix(hash + 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(value));
  }
  return hash;
}

void Advance(std::int64_t& sum, std::uint64_t by) {
  sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) + by);
}

}  // namespace

void TileTotals::Add(TileIndex index, std::int64_t layer, const StoredBlob& blob) {
  ++num_rows;
  bytes += blob.bytes;
  Advance(sum, HashOf(index, layer, blob.key));
}

void TileTotals::Remove(TileIndex index, std::int64_t layer, const StoredBlob& blob) {
  --num_rows;
  bytes -= blob.bytes;
  Advance(sum, ~HashOf(index, layer, blob.key) + 1);
}

}  // namespace dhpmap
