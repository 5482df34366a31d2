// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/free_codec.h"

#include <bit>

namespace dhpmap {
Bytes EncodeFreeTile(BlobKind kind, const FreeTile& tile, TileIndex index) {
  Payload payload;
  ByteWriter(payload.plain).PutU64(static_cast<std::uint64_t>(tile.last_seen_ns()));
  ByteWriter writer(payload.packable);
  writer.PutU64(tile.full());
  writer.PutU64(tile.mixed());
  for (const FreeMask& mask : tile.masks()) {
    for (const std::uint64_t layer : mask) writer.PutU64(layer);
  }
  return Seal(kind, SealIndexOf(index), payload);
}

Status DecodeFreeTile(BlobKind kind, ByteView blob, TileIndex index, FreeTile& tile) {
  Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(kind, SealIndexOf(index), blob, payload));
  ByteReader stamp(payload.plain), reader(payload.packable);
  const auto last_seen_ns = static_cast<std::int64_t>(stamp.GetU64());
  FreeBlocks blocks;
  blocks.full = reader.GetU64();
  blocks.mixed = reader.GetU64();
  for (std::uint64_t cells = blocks.mixed; cells != 0; cells &= cells - 1) {
    for (std::uint64_t& layer : blocks.masks[static_cast<std::size_t>(std::countr_zero(cells))]) {
      layer = reader.GetU64();
    }
  }
  if (!stamp.ok() || stamp.remaining() != 0 || !reader.ok() || reader.remaining() != 0) {
    return DataLoss("has a wrong length");
  }
  tile = FreeTile();
  tile.Add(blocks);
  tile.set_last_seen_ns(last_seen_ns);
  // Empty, full or redundant masks have another encoding.
  if (tile.empty() || tile.full() != blocks.full || tile.mixed() != blocks.mixed) {
    return DataLoss("is no tile of voxels");
  }
  return Status::Ok();
}

}  // namespace dhpmap
