// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/gone_codec.h"

#include <utility>

#include "storage/codec/envelope.h"

namespace dhpmap {
namespace {

void Write(const GoneBlock& block, ByteWriter& plain, ByteWriter& packable) {
  plain.PutU64(static_cast<std::uint64_t>(block.last().stamp_ns));
  for (int axis = 0; axis < 3; ++axis) plain.PutF64(block.last().position_m[axis]);
  for (const VoxelMask* bits : {&block.low(), &block.high()}) {
    for (const std::uint64_t layer : *bits) packable.PutU64(layer);
  }
}

/// Reads zeros past the end of either reader.
Status Read(ByteReader& plain, ByteReader& packable, GoneBlock& block) {
  Viewpoint last;
  last.stamp_ns = static_cast<std::int64_t>(plain.GetU64());
  for (int axis = 0; axis < 3; ++axis) last.position_m[axis] = plain.GetF64();
  VoxelMask low{}, high{};
  for (VoxelMask* bits : {&low, &high}) {
    for (std::uint64_t& layer : *bits) layer = packable.GetU64();
  }
  block = GoneBlock(low, high, last);
  if (block.empty() || !last.position_m.allFinite()) return DataLoss("counts nothing");
  return Status::Ok();
}

Status CheckIsAtEnd(const ByteReader& plain, const ByteReader& packable) {
  const bool is_at_end = plain.ok() && plain.remaining() == 0 && packable.ok() && packable.remaining() == 0;
  return is_at_end ? Status::Ok() : DataLoss("has a wrong length");
}

}  // namespace

Bytes EncodeGoneBlock(const GoneBlock& block, BlockIndex index) {
  Payload payload;
  ByteWriter plain(payload.plain), packable(payload.packable);
  Write(block, plain, packable);
  return Seal(BlobKind::kGoneV1, index, payload);
}

Status DecodeGoneBlock(ByteView blob, BlockIndex index, GoneBlock& block) {
  Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kGoneV1, index, blob, payload));
  ByteReader plain(payload.plain), packable(payload.packable);
  const Status read = Read(plain, packable, block);
  DHPMAP_RETURN_IF_ERROR(CheckIsAtEnd(plain, packable));
  return read;
}

Bytes EncodeGoneTile(const LayerBlocks<GoneBlock>& blocks, TileIndex index) {
  Payload payload;
  ByteWriter plain(payload.plain), packable(payload.packable);
  packable.PutU64(CellsOf(blocks));
  for (const auto& entry : blocks) Write(*entry.block, plain, packable);
  return Seal(BlobKind::kGoneTile, SealIndexOf(index), payload);
}

Status DecodeGoneTile(ByteView blob, TileIndex index, LayerBlocks<GoneBlock>& blocks) {
  blocks.clear();
  Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kGoneTile, SealIndexOf(index), blob, payload));
  ByteReader plain(payload.plain), packable(payload.packable);
  const std::uint64_t cells = packable.GetU64();
  if (cells == 0) return DataLoss("has a malformed header");
  for (const int cell : CellsIn(cells)) {
    auto block = std::make_shared<GoneBlock>();
    DHPMAP_RETURN_IF_ERROR(Read(plain, packable, *block));
    blocks.push_back({cell, std::move(block)});
  }
  return CheckIsAtEnd(plain, packable);
}

}  // namespace dhpmap
