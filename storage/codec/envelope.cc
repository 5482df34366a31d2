// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/envelope.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "storage/codec/crc32c.h"

namespace dhpmap {
namespace {

enum class Packing : std::uint8_t { kStored = 0, kZstd = 1 };

constexpr std::size_t kChecksumBytes = 4;
constexpr std::size_t kLeastBytes = 3 + kChecksumBytes;  // kind, packing, length of the plain part
constexpr int kZstdLevel = 1;
// Limit of unpacked size: that of a tile with the simplest blocks. Seal stores larger parts unpacked, so only a forged
// length can request more memory.
constexpr std::size_t kFreeGrowthBytes = 512 * 1024;
constexpr std::size_t kMaxGrowth = 64;
constexpr std::size_t kMostUnpackedBytes = 256u << 20;  // about ten times the largest tile

struct ContextDeleter {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

ZSTD_CCtx* Compressor() {
  thread_local const std::unique_ptr<ZSTD_CCtx, ContextDeleter> context = [] {
    std::unique_ptr<ZSTD_CCtx, ContextDeleter> made(ZSTD_createCCtx());
    if (made) ZSTD_CCtx_setParameter(made.get(), ZSTD_c_compressionLevel, kZstdLevel);
    return made;
  }();
  return context.get();
}

ZSTD_DCtx* Decompressor() {
  thread_local const std::unique_ptr<ZSTD_DCtx, ContextDeleter> context(ZSTD_createDCtx());
  return context.get();
}

std::uint32_t Checksum(BlockIndex index, ByteView sealed) {
  std::array<std::uint8_t, 12> key;
  std::size_t next = 0;
  for (const std::int32_t coordinate : {index.x, index.y, index.z}) {
    for (int shift = 0; shift < 32; shift += 8) {
      key[next++] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(coordinate) >> shift);
    }
  }
  return Crc32c(sealed, Crc32c(key));
}

std::size_t MaxUnpacked(std::size_t packed_bytes) {
  return std::min(kFreeGrowthBytes + kMaxGrowth * packed_bytes, kMostUnpackedBytes);
}

/// Appends the compressed bytes; false, leaving `blob` unchanged, if that saves nothing.
bool AppendCompressed(ByteView bytes, Bytes& blob) {
  ZSTD_CCtx* context = Compressor();
  if (context == nullptr || bytes.empty()) return false;
  const std::size_t begin = blob.size();
  blob.resize(begin + ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context, blob.data() + begin, blob.size() - begin, bytes.data(), bytes.size());
  const bool gains = !ZSTD_isError(size) && size < bytes.size() && bytes.size() <= MaxUnpacked(size);
  blob.resize(begin + (gains ? size : 0));
  return gains;
}

Status Decompress(ByteView packed, Bytes& bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > MaxUnpacked(packed.size())) {
    return DataLoss("says an implausible length");
  }
  ZSTD_DCtx* context = Decompressor();
  if (context == nullptr) return ResourceExhausted("needs more memory than there is");
  bytes.resize(static_cast<std::size_t>(size));
  const std::size_t written = ZSTD_decompressDCtx(context, bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(written) || written != bytes.size()) return DataLoss("does not decompress");
  return Status::Ok();
}

}  // namespace

Bytes Seal(BlobKind kind, BlockIndex index, const Payload& payload) {
  Bytes blob;
  blob.reserve(payload.packable.size() + payload.plain.size() + 64);
  ByteWriter writer(blob);
  writer.PutU8(static_cast<std::uint8_t>(kind));
  writer.PutU8(static_cast<std::uint8_t>(Packing::kZstd));
  writer.PutVarint(payload.plain.size());
  writer.PutBytes(payload.plain);
  if (!AppendCompressed(payload.packable, blob)) {
    blob[1] = static_cast<std::uint8_t>(Packing::kStored);
    writer.PutBytes(payload.packable);
  }
  writer.PutU32(Checksum(index, blob));
  return blob;
}

Status Unseal(BlobKind kind, BlockIndex index, ByteView blob, Payload& payload) {
  payload.packable.clear();
  payload.plain.clear();
  if (blob.size() < kLeastBytes) return DataLoss("is too short");
  const ByteView sealed = blob.first(blob.size() - kChecksumBytes);
  if (ByteReader(blob.last(kChecksumBytes)).GetU32() != Checksum(index, sealed)) {
    return DataLoss("has a wrong checksum");
  }
  ByteReader reader(sealed);
  const std::uint8_t stored_kind = reader.GetU8();
  if (LayerNumber(static_cast<BlobKind>(stored_kind)) != LayerNumber(kind)) {
    return DataLoss("is a blob of another layer");
  }
  if (stored_kind != static_cast<std::uint8_t>(kind)) {
    return FailedPrecondition("is of codec " + std::to_string(stored_kind) + ", unknown to this version");
  }
  const auto packing = static_cast<Packing>(reader.GetU8());
  const ByteView plain = reader.GetBytes(reader.GetVarint());
  if (!reader.ok()) return DataLoss("says an implausible length");
  payload.plain.assign(plain.begin(), plain.end());
  const ByteView rest = reader.GetBytes(reader.remaining());
  switch (packing) {
    case Packing::kStored: payload.packable.assign(rest.begin(), rest.end()); return Status::Ok();
    case Packing::kZstd: return Decompress(rest, payload.packable);
  }
  return DataLoss("is packed in an unknown way");
}

}  // namespace dhpmap
