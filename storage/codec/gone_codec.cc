// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/gone_codec.h"

#include "storage/codec/envelope.h"

namespace dhpmap {

Bytes EncodeGoneBlock(const GoneBlock& block, BlockIndex index) {
  Payload payload;
  ByteWriter plain(payload.plain);
  plain.PutU64(static_cast<std::uint64_t>(block.last().stamp_ns));
  for (int axis = 0; axis < 3; ++axis) plain.PutF64(block.last().position_m[axis]);
  ByteWriter writer(payload.packable);
  for (const VoxelMask* bits : {&block.low(), &block.high()}) {
    for (const std::uint64_t layer : *bits) writer.PutU64(layer);
  }
  return Seal(BlobKind::kGoneV1, index, payload);
}

Status DecodeGoneBlock(ByteView blob, BlockIndex index, GoneBlock& block) {
  Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kGoneV1, index, blob, payload));
  ByteReader plain(payload.plain), reader(payload.packable);
  Viewpoint last;
  last.stamp_ns = static_cast<std::int64_t>(plain.GetU64());
  for (int axis = 0; axis < 3; ++axis) last.position_m[axis] = plain.GetF64();
  VoxelMask low{}, high{};
  for (VoxelMask* bits : {&low, &high}) {
    for (std::uint64_t& layer : *bits) layer = reader.GetU64();
  }
  if (!plain.ok() || plain.remaining() != 0 || !reader.ok() || reader.remaining() != 0) {
    return DataLoss("has a wrong length");
  }
  block = GoneBlock(low, high, last);
  if (block.empty() || !last.position_m.allFinite()) return DataLoss("counts nothing");
  return Status::Ok();
}

}  // namespace dhpmap
