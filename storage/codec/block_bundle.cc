// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/block_bundle.h"

#include "storage/codec/tile_blocks.h"

namespace dhpmap {

Bytes EncodeBundle(BlobKind kind, const std::vector<BundledBlob>& blobs, TileIndex index) {
  Payload payload;
  std::uint64_t cells = 0;
  for (const BundledBlob& entry : blobs) cells |= std::uint64_t{1} << entry.cell;
  ByteWriter writer(payload.plain);
  writer.PutU64(cells);
  for (const BundledBlob& entry : blobs) {
    writer.PutVarint(entry.blob.size());
    writer.PutBytes(entry.blob);
  }
  return Seal(kind, SealIndexOf(index), payload);
}

Status DecodeBundle(BlobKind kind, ByteView blob, TileIndex index, std::vector<BundledBlob>& blobs) {
  blobs.clear();
  Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(kind, SealIndexOf(index), blob, payload));
  ByteReader reader(payload.plain);
  const std::uint64_t cells = reader.GetU64();
  for (const int cell : CellsIn(cells)) {
    const ByteView bytes = reader.GetBytes(reader.GetVarint());
    if (!reader.ok()) break;
    blobs.push_back({cell, Bytes(bytes.begin(), bytes.end())});
  }
  const bool is_whole = reader.ok() && reader.remaining() == 0 && payload.packable.empty() && cells != 0;
  return is_whole ? Status::Ok() : DataLoss("is no tile of blobs");
}

}  // namespace dhpmap
