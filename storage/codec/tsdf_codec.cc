// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/tsdf_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "storage/codec/envelope.h"
#include "storage/codec/voxel_walk.h"

namespace dhpmap {
namespace {

// Payload, packable part: step (float; 0 = exact distances), planes (bit p: plane p is in the packable part), mask,
// planes. Plain part: the other planes, then, if exact, the distances as floats. Planes hold one byte a masked voxel.
enum TsdfPlane { kDistance0, kDistance1, kWeight0, kWeight1, kWeight2, kGreen, kRed, kBlue, kNumTsdfPlanes };

/// Where each plane of a block begins.
template <typename Byte>
using PlanesAt = std::array<Byte*, kNumTsdfPlanes>;
using Planes = PlanesAt<std::uint8_t>;
using ReadPlanes = PlanesAt<const std::uint8_t>;

constexpr double kStepsPerTruncation = 8192;
constexpr std::int32_t kMaxDistanceSteps = 32767;

// A weight is stored as its top 24 bits below the sign: exponent and 16 bits of mantissa.
constexpr int kWeightDroppedBits = 7;
constexpr std::uint32_t kWeightMask = 0xFFFFFF;
constexpr std::uint32_t kFiniteWeightMax =
    std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max()) >> kWeightDroppedBits;
/// The smallest code that counts as observed.
constexpr std::uint32_t kWeightMin =
    (std::bit_cast<std::uint32_t>(kMinObservedWeight) + (1u << kWeightDroppedBits) - 1) >> kWeightDroppedBits;

std::int32_t WeightCode(float weight) {
  if (std::isinf(weight)) return static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(weight) >> kWeightDroppedBits);
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(weight);
  const std::uint32_t rounded = (bits + (1u << (kWeightDroppedBits - 1))) >> kWeightDroppedBits;
  return static_cast<std::int32_t>(std::clamp(rounded, kWeightMin, kFiniteWeightMax));
}

float WeightOf(std::int32_t code) {
  return std::bit_cast<float>((static_cast<std::uint32_t>(code) & kWeightMask) << kWeightDroppedBits);
}

/// The quantisation step of distances, or 0 if one of them does not fit.
float DistanceStep(const TsdfBlock& block, const VoxelWalk& walk, double truncation_m) {
  const auto step_m = static_cast<float>(truncation_m / kStepsPerTruncation);
  if (!std::isnormal(step_m) || step_m < 0) return 0;
  const double reach_m = (kMaxDistanceSteps + 0.25) * static_cast<double>(step_m);
  for (const auto& site : walk.sites()) {
    if (!(std::abs(static_cast<double>(block.distance_m[site.linear])) < reach_m)) return 0;
  }
  return step_m;
}

VoxelBits ObservedVoxels(const TsdfBlock& block) {
  VoxelBits mask{};
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (block.IsObserved(i)) MaskVoxel(mask, i);
  }
  return mask;
}

void WriteDistances(const TsdfBlock& block, const VoxelWalk& walk, float step_m, const Planes& planes) {
  VoxelWalk::Grid& grid = VoxelWalk::GridOfThread();
  const double steps_per_m = 1.0 / static_cast<double>(step_m);
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const auto steps = static_cast<std::int32_t>(std::lrint(block.distance_m[site.linear] * steps_per_m));
    grid[site.cell] = steps;
    // Modulo 2^16: differences may exceed 15 bits, values do not.
    const auto difference = static_cast<std::int16_t>(steps - VoxelWalk::PredictNear(grid, site));
    const std::uint32_t code = ZigZag(difference);
    planes[kDistance0][n] = static_cast<std::uint8_t>(code);
    planes[kDistance1][n++] = static_cast<std::uint8_t>(code >> 8);
  }
}

void ReadDistances(const VoxelWalk& walk, float step_m, const ReadPlanes& planes, TsdfBlock& block) {
  VoxelWalk::Grid& grid = VoxelWalk::GridOfThread();
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const std::int32_t difference = UnZigZag(planes[kDistance0][n] | (planes[kDistance1][n] << 8));
    ++n;
    const auto steps = static_cast<std::int16_t>(VoxelWalk::PredictNear(grid, site) + difference);
    grid[site.cell] = steps;
    block.distance_m[site.linear] = static_cast<float>(steps * static_cast<double>(step_m));
  }
}

void WriteWeights(const TsdfBlock& block, const VoxelWalk& walk, const Planes& planes) {
  VoxelWalk::Grid& grid = VoxelWalk::GridOfThread();
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const std::int32_t code = WeightCode(block.weight[site.linear]);
    grid[site.cell] = code;
    // Modulo 2^24, with the sign in bit 23.
    const std::int32_t difference =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(code - VoxelWalk::PredictNear(grid, site)) << 8) >> 8;
    const std::uint32_t zigzag = ZigZag(difference);
    planes[kWeight0][n] = static_cast<std::uint8_t>(zigzag);
    planes[kWeight1][n] = static_cast<std::uint8_t>(zigzag >> 8);
    planes[kWeight2][n++] = static_cast<std::uint8_t>(zigzag >> 16);
  }
}

bool ReadWeights(const VoxelWalk& walk, const ReadPlanes& planes, TsdfBlock& block) {
  VoxelWalk::Grid& grid = VoxelWalk::GridOfThread();
  bool all_observed = true;
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const std::int32_t difference =
        UnZigZag(planes[kWeight0][n] | (planes[kWeight1][n] << 8) | (planes[kWeight2][n] << 16));
    ++n;
    grid[site.cell] = static_cast<std::int32_t>(static_cast<std::uint32_t>(grid[site.near] + difference) & kWeightMask);
    block.weight[site.linear] = WeightOf(grid[site.cell]);
    all_observed &= block.IsObserved(site.linear);
  }
  return all_observed;
}

/// Green, red and blue, predicted in parallel; the fourth is unused.
struct Channels {
  std::array<std::int32_t, 4> values{};
};

template <typename Operation>
Channels OneByOne(const Channels& a, const Channels& b, Operation&& operation) {
  Channels result;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = operation(a.values[i], b.values[i]);
  return result;
}
Channels operator+(const Channels& a, const Channels& b) {
  return OneByOne(a, b, [](std::int32_t x, std::int32_t y) { return x + y; });
}
Channels operator-(const Channels& a, const Channels& b) {
  return OneByOne(a, b, [](std::int32_t x, std::int32_t y) { return x - y; });
}
/// `count`: 2 or 3.
Channels Quotient(const Channels& sum, std::int32_t count) {
  if (count == 2) return OneByOne(sum, {}, [](std::int32_t x, std::int32_t) { return x / 2; });
  return OneByOne(sum, {}, [](std::int32_t x, std::int32_t) { return x / 3; });
}

using ColorGrid = VoxelWalk::GridOf<Channels>;

/// As VoxelWalk::GridOfThread.
ColorGrid& ColorGridOfThread() {
  thread_local ColorGrid grid{};
  return grid;
}

void WriteColors(const TsdfBlock& block, const VoxelWalk& walk, const Planes& planes) {
  ColorGrid& grid = ColorGridOfThread();
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const Color& color = block.color[site.linear];
    const Channels values{{color.g, color.r, color.b, 0}};
    const Channels difference = values - VoxelWalk::PredictSmooth(grid, site);
    grid[site.cell] = values;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const auto rounded = static_cast<std::int8_t>(difference.values[channel]);
      planes[kGreen + channel][n] = static_cast<std::uint8_t>(ZigZag(rounded));
    }
    ++n;
  }
}

void ReadColors(const VoxelWalk& walk, const ReadPlanes& planes, TsdfBlock& block) {
  ColorGrid& grid = ColorGridOfThread();
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    Channels values = VoxelWalk::PredictSmooth(grid, site);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const std::int32_t difference = UnZigZag(planes[kGreen + channel][n]);
      values.values[channel] = static_cast<std::uint8_t>(values.values[channel] + difference);
    }
    ++n;
    grid[site.cell] = values;
    block.color[site.linear] = {static_cast<std::uint8_t>(values.values[1]),
                                static_cast<std::uint8_t>(values.values[0]),
                                static_cast<std::uint8_t>(values.values[2])};
  }
}

/// Whether zstd would compress these bytes: true if two of them are equal four times as often as at random.
bool IsPackable(ByteView plane) {
  constexpr std::size_t kRandomValues = 256, kGain = 4;
  std::array<std::uint32_t, kRandomValues> histogram{};
  for (const std::uint8_t byte : plane) ++histogram[byte];
  std::size_t equal_pairs = 0;
  for (const std::uint32_t count : histogram) equal_pairs += static_cast<std::size_t>(count) * count;
  return !plane.empty() && (equal_pairs - plane.size()) * kRandomValues > kGain * plane.size() * plane.size();
}

/// Planes of a block, or of the blocks of a tile one after the other, while they are built.
class PlaneBuffer {
 public:
  /// Extends each plane by `count` voxels.
  Planes Extend(std::size_t count) {
    Planes at;
    for (std::size_t p = 0; p < kNumTsdfPlanes; ++p) {
      const std::size_t size = bytes_[p].size();
      bytes_[p].resize(size + count);
      at[p] = bytes_[p].data() + size;
    }
    return at;
  }
  /// Removes distances that are stored exactly instead.
  void DropDistances(std::size_t count) {
    for (const TsdfPlane p : {kDistance0, kDistance1}) bytes_[p].resize(bytes_[p].size() - count);
  }
  void Clear() {
    for (Bytes& plane : bytes_) plane.clear();
  }
  const Bytes& operator[](int plane) const { return bytes_[static_cast<std::size_t>(plane)]; }

 private:
  std::array<Bytes, kNumTsdfPlanes> bytes_;
};

/// Appends the planes of a block, without distances if `step_m` is 0.
void WritePlanes(const TsdfBlock& block, const VoxelWalk& walk, float step_m, PlaneBuffer& buffer) {
  const std::size_t count = walk.sites().size();
  const Planes planes = buffer.Extend(count);
  if (step_m > 0) WriteDistances(block, walk, step_m, planes);
  else buffer.DropDistances(count);
  WriteWeights(block, walk, planes);
  WriteColors(block, walk, planes);
}

/// The planes to store in the packable part.
std::uint8_t PackablePlanes(const PlaneBuffer& planes) {
  std::uint8_t packable = 0;
  for (int p = 0; p < kNumTsdfPlanes; ++p) {
    if (IsPackable(planes[p])) packable |= static_cast<std::uint8_t>(1u << p);
  }
  return packable;
}

void PutExactDistances(const TsdfBlock& block, const VoxelWalk& walk, ByteWriter& writer) {
  for (const auto& site : walk.sites()) writer.PutF32(block.distance_m[site.linear]);
}

/// Decodes into a zeroed block; distances come from `exact` if `step_m` is 0.
Status ReadPlanesInto(const VoxelWalk& walk, float step_m, const ReadPlanes& planes, ByteReader& exact,
                      TsdfBlock& block) {
  if (!ReadWeights(walk, planes, block)) return DataLoss("holds a voxel without weight");
  ReadColors(walk, planes, block);
  if (step_m > 0) {
    ReadDistances(walk, step_m, planes, block);
  } else {
    for (const auto& site : walk.sites()) block.distance_m[site.linear] = exact.GetF32();
  }
  return Status::Ok();
}

}  // namespace

Bytes EncodeTsdfBlock(const TsdfBlock& block, BlockIndex index, double truncation_m) {
  const VoxelBits mask = ObservedVoxels(block);
  const VoxelWalk walk(mask);
  const float step_m = DistanceStep(block, walk, truncation_m);
  PlaneBuffer planes;
  WritePlanes(block, walk, step_m, planes);
  const std::uint8_t packable = PackablePlanes(planes);

  Payload payload;
  ByteWriter packed(payload.packable), plain(payload.plain);
  packed.PutF32(step_m);
  packed.PutU8(packable);
  packed.PutBytes(mask);
  for (int p = 0; p < kNumTsdfPlanes; ++p) ((packable >> p) & 1u ? packed : plain).PutBytes(planes[p]);
  if (step_m == 0) PutExactDistances(block, walk, plain);
  return Seal(BlobKind::kTsdfV1, index, payload);
}

Status DecodeTsdfBlock(ByteView blob, BlockIndex index, TsdfBlock& block) {
  thread_local Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kTsdfV1, index, blob, payload));
  ByteReader packed(payload.packable), plain(payload.plain);
  const float step_m = packed.GetF32();
  const std::uint8_t packable = packed.GetU8();
  VoxelBits mask{};
  packed.GetInto(mask);
  if (!packed.ok() || !(step_m >= 0) || std::isinf(step_m)) return DataLoss("has a malformed header");
  const VoxelWalk walk(mask);
  const std::size_t count = walk.sites().size();

  ReadPlanes planes{};
  for (int p = step_m > 0 ? kDistance0 : kWeight0; p < kNumTsdfPlanes; ++p) {
    planes[static_cast<std::size_t>(p)] = ((packable >> p) & 1u ? packed : plain).GetBytes(count).data();
  }
  const std::size_t exact_bytes = step_m > 0 ? 0 : count * sizeof(float);
  if (!packed.ok() || !plain.ok() || packed.remaining() != 0 || plain.remaining() != exact_bytes) {
    return DataLoss("is not as long as its voxels need");
  }
  block = TsdfBlock{};
  return ReadPlanesInto(walk, step_m, planes, plain, block);
}

Bytes EncodeTsdfTile(const LayerBlocks<TsdfBlock>& blocks, TileIndex index, double truncation_m) {
  thread_local PlaneBuffer planes;
  planes.Clear();
  Bytes masks;
  Payload payload;
  ByteWriter mask_writer(masks), packed(payload.packable), plain(payload.plain);
  Bytes exact_distances;
  ByteWriter exact_writer(exact_distances);
  std::uint64_t exact = 0;
  float step_m = 0;
  for (const auto& [cell, block] : blocks) {
    const VoxelBits mask = ObservedVoxels(*block);
    mask_writer.PutBytes(mask);
    const VoxelWalk walk(mask);
    const float step_of_block_m = DistanceStep(*block, walk, truncation_m);
    WritePlanes(*block, walk, step_of_block_m, planes);
    if (step_of_block_m > 0) {
      step_m = step_of_block_m;  // equal for all blocks with a step, because it follows from the truncation
    } else {
      exact |= std::uint64_t{1} << cell;
      PutExactDistances(*block, walk, exact_writer);
    }
  }
  const std::uint8_t packable = PackablePlanes(planes);
  packed.PutU64(CellsOf(blocks));
  packed.PutU64(exact);
  packed.PutF32(step_m);
  packed.PutU8(packable);
  packed.PutBytes(masks);
  for (int p = 0; p < kNumTsdfPlanes; ++p) ((packable >> p) & 1u ? packed : plain).PutBytes(planes[p]);
  plain.PutBytes(exact_distances);
  return Seal(BlobKind::kTsdfTile, SealIndexOf(index), payload);
}

Status DecodeTsdfTile(ByteView blob, TileIndex index, LayerBlocks<TsdfBlock>& blocks) {
  blocks.clear();
  thread_local Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kTsdfTile, SealIndexOf(index), blob, payload));
  ByteReader packed(payload.packable), plain(payload.plain);
  const std::uint64_t cells = packed.GetU64(), exact = packed.GetU64();
  const float step_m = packed.GetF32();
  const std::uint8_t packable = packed.GetU8();
  const ByteView masks = packed.GetBytes(sizeof(VoxelBits) * static_cast<std::size_t>(std::popcount(cells)));
  if (!packed.ok() || cells == 0 || (exact & ~cells) != 0 || !(step_m >= 0) || std::isinf(step_m) ||
      (step_m == 0) != (exact == cells)) {
    return DataLoss("has a malformed header");
  }
  std::size_t num_voxels = 0, num_exact = 0;
  for (std::size_t n = 0; const int cell : CellsIn(cells)) {
    const std::size_t count = NumMasked(masks.subspan(sizeof(VoxelBits) * n++, sizeof(VoxelBits)));
    num_voxels += count;
    if ((exact >> cell) & 1u) num_exact += count;
  }
  ReadPlanes planes{};
  for (int p = 0; p < kNumTsdfPlanes; ++p) {
    const std::size_t count = p < kWeight0 ? num_voxels - num_exact : num_voxels;
    planes[static_cast<std::size_t>(p)] = ((packable >> p) & 1u ? packed : plain).GetBytes(count).data();
  }
  if (!packed.ok() || !plain.ok() || packed.remaining() != 0 || plain.remaining() != num_exact * sizeof(float)) {
    return DataLoss("is not as long as its voxels need");
  }
  for (std::size_t n = 0; const int cell : CellsIn(cells)) {
    VoxelBits mask{};
    ByteReader(masks.subspan(sizeof(VoxelBits) * n++, sizeof(VoxelBits))).GetInto(mask);
    const VoxelWalk walk(mask);
    const bool is_exact = (exact >> cell) & 1u;
    auto block = std::shared_ptr<TsdfBlock>(new TsdfBlock());  // not make_shared: StateMarks would keep its memory
    DHPMAP_RETURN_IF_ERROR(ReadPlanesInto(walk, is_exact ? 0 : step_m, planes, plain, *block));
    blocks.push_back({cell, std::move(block)});
    for (std::size_t p = is_exact ? kWeight0 : kDistance0; p < kNumTsdfPlanes; ++p) planes[p] += walk.sites().size();
  }
  return Status::Ok();
}

}  // namespace dhpmap
