// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "storage/codec/crc32c.h"
#include "storage/codec/envelope.h"
#include "storage/codec/free_codec.h"
#include "storage/codec/gone_codec.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::MapGenerator;

constexpr BlockIndex kIndex{-5, 0, 7};
constexpr double kTruncation_m = 0.08;
constexpr double kDistanceBound_m = kTruncation_m / 16384 * 1.001;  // and the rounding of the step to float
constexpr double kWeightShare = 1.0 / 131072 * 1.001;

TsdfBlock SomeTsdf(std::uint32_t seed) {
  TsdfBlock block;
  MapGenerator(seed).FillTsdf(block, kTruncation_m);
  return block;
}

LabelBlock SomeLabels(std::uint32_t seed) {
  LabelBlock block;
  MapGenerator(seed).FillLabels(block);
  return block;
}

TsdfBlock RoundTrip(const TsdfBlock& block, double truncation_m = kTruncation_m) {
  TsdfBlock decoded;
  const Status status = DecodeTsdfBlock(EncodeTsdfBlock(block, kIndex, truncation_m), kIndex, decoded);
  EXPECT_TRUE(status.ok()) << status.ToString();
  return decoded;
}

LabelBlock RoundTrip(const LabelBlock& block) {
  LabelBlock decoded;
  decoded.AddObservation(3, ClassId(5));  // must be gone
  const Status status = DecodeLabelBlock(EncodeLabelBlock(block, kIndex), kIndex, decoded);
  EXPECT_TRUE(status.ok()) << status.ToString();
  return decoded;
}

TEST(Crc32c, MatchesPublishedVectors) {
  const std::string digits = "123456789";
  const Bytes bytes(digits.begin(), digits.end());
  EXPECT_EQ(Crc32c(bytes), 0xE3069283u);
  EXPECT_EQ(Crc32c(Bytes(32, 0)), 0x8A9136AAu);     // RFC 3720, B.4
  EXPECT_EQ(Crc32c(Bytes(32, 0xFF)), 0x62A8AB43u);  // RFC 3720, B.4
}

TEST(Crc32c, IsTheSameWithTheMachinesInstructionAndWithout) {
  Bytes bytes;
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(Crc32c(bytes), Crc32cByTables(bytes)) << i;
    EXPECT_EQ(Crc32c(bytes, 7), Crc32cByTables(bytes, 7)) << i;
    bytes.push_back(static_cast<std::uint8_t>(random()));
  }
}

TEST(Crc32c, GoesOnFromWhatCameBefore) {
  const std::string digits = "123456789abcdefghijk";
  const Bytes bytes(digits.begin(), digits.end());
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    const ByteView view(bytes);
    EXPECT_EQ(Crc32c(view.subspan(cut), Crc32c(view.first(cut))), Crc32c(bytes));
  }
}

TEST(TsdfCodec, RoundTripStaysWithinBounds) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const TsdfBlock block = SomeTsdf(seed);
    testing::ExpectSameTsdf(block, RoundTrip(block), kDistanceBound_m, kWeightShare);
  }
}

TEST(TsdfCodec, EncodingWhatWasDecodedGivesTheSameBytes) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const Bytes once = EncodeTsdfBlock(SomeTsdf(seed), kIndex, kTruncation_m);
    TsdfBlock decoded;
    ASSERT_TRUE(DecodeTsdfBlock(once, kIndex, decoded).ok());
    EXPECT_EQ(EncodeTsdfBlock(decoded, kIndex, kTruncation_m), once);
  }
}

TEST(TsdfCodec, UnobservedVoxelsComeBackZeroAndCostNothing) {
  TsdfBlock block;
  block.weight.fill(0.9e-6f);
  block.distance_m.fill(0.05f);
  block.color.fill({1, 2, 3});
  const TsdfBlock decoded = RoundTrip(block);
  EXPECT_EQ(decoded.weight[7], 0);
  EXPECT_EQ(decoded.distance_m[7], 0);
  EXPECT_EQ(decoded.color[7], Color{});
  EXPECT_LT(EncodeTsdfBlock(block, kIndex, kTruncation_m).size(), 40u);
}

TEST(TsdfCodec, WeightsAtTheLimitsStayObserved) {
  TsdfBlock block;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::array<float, 6> weights = {
      kMinObservedWeight, std::nextafter(kMinObservedWeight, 1.0f), 1e4f, 1e-5f, std::numeric_limits<float>::max(),
      kInfinity};
  for (std::size_t i = 0; i < weights.size(); ++i) block.weight[i] = weights[i];
  block.weight[10] = std::nextafter(kMinObservedWeight, 0.0f);
  const TsdfBlock decoded = RoundTrip(block);
  for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_TRUE(decoded.IsObserved(static_cast<int>(i))) << i;
  EXPECT_FALSE(decoded.IsObserved(10));
  EXPECT_EQ(decoded.weight[2], 1e4f);
  EXPECT_TRUE(std::isfinite(decoded.weight[4]));
  EXPECT_EQ(decoded.weight[5], kInfinity);
}

TEST(TsdfCodec, NotANumberAsWeightIsUnobserved) {
  TsdfBlock block;
  block.weight[0] = std::numeric_limits<float>::quiet_NaN();
  block.weight[1] = 1;
  const TsdfBlock decoded = RoundTrip(block);
  EXPECT_EQ(decoded.weight[0], 0);
  EXPECT_EQ(decoded.weight[1], 1);
}

TEST(TsdfCodec, DistancesUpToFourTruncationsAreRounded) {
  TsdfBlock block;
  block.weight.fill(1);
  for (int i = 0; i < kBlockVoxels; ++i) {
    block.distance_m[i] = static_cast<float>((i % 2 ? 1 : -1) * kTruncation_m * 3.999 * i / kBlockVoxels);
  }
  const TsdfBlock decoded = RoundTrip(block);
  testing::ExpectSameTsdf(block, decoded, kDistanceBound_m, 0);
  EXPECT_EQ(EncodeTsdfBlock(decoded, kIndex, kTruncation_m), EncodeTsdfBlock(block, kIndex, kTruncation_m));
}

TEST(TsdfCodec, DistancesThatDoNotFitAreKeptExactly) {
  for (const double truncation_m : {kTruncation_m, 0.0, -1.0, std::nan("")}) {
    TsdfBlock block = SomeTsdf(3);
    block.weight[0] = block.weight[1] = 1;
    block.distance_m[0] = 0.33f;  // beyond four truncations
    block.distance_m[1] = -std::numeric_limits<float>::infinity();
    const TsdfBlock decoded = RoundTrip(block, truncation_m);
    for (int i = 0; i < kBlockVoxels; ++i) {
      EXPECT_EQ(block.IsObserved(i) ? block.distance_m[i] : 0, decoded.distance_m[i]);
    }
    EXPECT_EQ(EncodeTsdfBlock(decoded, kIndex, truncation_m), EncodeTsdfBlock(block, kIndex, truncation_m));
  }
}

TEST(LabelCodec, RoundTripIsExact) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const LabelBlock block = SomeLabels(seed);
    EXPECT_TRUE(RoundTrip(block) == block) << "seed " << seed;
  }
}

TEST(LabelCodec, KeepsEveryFormOfVoxel) {
  constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
  LabelBlock block;
  int voxel = 0;
  block.Set(voxel++, {{{0, 1}}, {{kOwnInstance, 1}}});
  block.Set(voxel++, {{{65534, 65535}}, {{kOwnInstance, 65535}}});
  block.Set(voxel++, {{{65534, 65536}}, {{kOwnInstance, 65536}}});
  block.Set(voxel++, {{{1, kMax}, {2, kMax}}, {{kOwnInstance, kMax}}});
  block.Set(voxel++, {{{1, 2}, {3, 4}}, {{kOwnInstance, 6}}});
  block.Set(voxel++, {{{1, 2}, {3, 4}}, {{kOwnInstance, 5}}});
  block.Set(voxel++, {{{1, 2}}, {{SeenInstance::FromCode(5), 2}, {SeenInstance::FromCode(kMax), kMax}}});
  block.Set(voxel++, {{}, {{kOwnInstance, 3}}});
  block.Set(voxel++, {{{7, 1}}, {}});
  LabelHistograms many;
  for (std::uint32_t id = 0; id < 300; ++id) many.classes.push_back({3 * id, id + 1});
  block.Set(voxel++, many);
  const LabelBlock decoded = RoundTrip(block);
  for (int i = 0; i <= voxel; ++i) EXPECT_EQ(block.Get(i), decoded.Get(i)) << "voxel " << i;
}

TEST(LabelCodec, TheSameCountsAreTheSameBytesHoweverTheyCameAbout) {
  LabelBlock one, other;
  one.AddObservation(4, ClassId(2));
  one.AddObservation(4, ClassId(1));
  other.Set(4, {{{1, 1}, {2, 1}, {3, 1}}, {{kOwnInstance, 3}}});  // through the overflow list
  other.Set(4, {{{1, 1}, {2, 1}}, {{kOwnInstance, 2}}});
  EXPECT_EQ(EncodeLabelBlock(one, kIndex), EncodeLabelBlock(other, kIndex));
}

TEST(LabelCodec, ABlockOfOneClassIsTheSameBytesWhicheverWayItIsHeld) {
  for (const std::uint16_t c : {std::uint16_t{0}, std::uint16_t{7}, std::uint16_t{65'534}}) {
    LabelBlock counts, cells;
    cells.Set(500, {{{1, 1}, {2, 1}}, {{kOwnInstance, 2}}});
    cells.Clear(500);
    for (int i = 0; i < 200; ++i) {
      const std::uint32_t count = i % 10 == 0 ? 65'535 : 1 + static_cast<std::uint32_t>(i);
      counts.AddObservation(i, ClassId(c), count);
      cells.AddObservation(i, ClassId(c), count);
    }
    counts.SetConcluded(3, true);
    cells.SetConcluded(3, true);
    ASSERT_LT(counts.CountedBytes(), cells.CountedBytes());
    const Bytes bytes = EncodeLabelBlock(counts, kIndex);
    EXPECT_EQ(bytes, EncodeLabelBlock(cells, kIndex));
    LabelBlock decoded;
    ASSERT_TRUE(DecodeLabelBlock(bytes, kIndex, decoded).ok());
    EXPECT_EQ(decoded.CountedBytes(), counts.CountedBytes());
    EXPECT_EQ(EncodeLabelBlock(decoded, kIndex), bytes);
  }
}

TEST(LabelCodec, AnEmptyBlockIsTiny) {
  EXPECT_LT(EncodeLabelBlock(LabelBlock(), kIndex).size(), 40u);
  EXPECT_TRUE(RoundTrip(LabelBlock()) == LabelBlock());
}

// Damage: whatever happens to a blob, decoding says DATA_LOSS.

template <typename Block, typename Decode>
void ExpectDamageIsSeen(const Bytes& blob, Decode decode) {
  Block block;
  for (std::size_t i = 0; i < blob.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      Bytes damaged = blob;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ flip);
      ASSERT_EQ(decode(damaged, kIndex, block).code(), StatusCode::kDataLoss) << "byte " << i << " ^ " << flip;
    }
    ASSERT_EQ(decode(ByteView(blob).first(i), kIndex, block).code(), StatusCode::kDataLoss) << "cut at " << i;
  }
  Bytes longer = blob;
  longer.push_back(0);
  EXPECT_EQ(decode(longer, kIndex, block).code(), StatusCode::kDataLoss);
  EXPECT_EQ(decode(blob, BlockIndex{-5, 1, 7}, block).code(), StatusCode::kDataLoss) << "under another index";
  EXPECT_TRUE(decode(blob, kIndex, block).ok());
}

TEST(TsdfCodec, EveryFlippedOrMissingByteIsDataLoss) {
  ExpectDamageIsSeen<TsdfBlock>(EncodeTsdfBlock(SomeTsdf(1), kIndex, kTruncation_m), DecodeTsdfBlock);
}

/// A tile with whole blocks, parts of blocks, and blocks of which nothing is free.
FreeTile SomeFreeTile(std::uint32_t seed) {
  std::mt19937_64 random(seed);
  FreeBlocks blocks;
  blocks.full = random() & random();
  blocks.mixed = ~blocks.full & random() & random();
  for (FreeMask& mask : blocks.masks) {
    for (std::uint64_t& layer : mask) layer = random();
  }
  FreeTile tile;
  tile.Add(blocks);
  tile.set_last_seen_ns(-1'700'000'000'123'456'789);
  return tile;
}

Status DecodeFree(ByteView blob, BlockIndex index, FreeTile& tile) {
  return DecodeFreeTile(BlobKind::kFreeV1, blob, {index.x, index.y, index.z}, tile);
}
constexpr TileIndex kFreeTile{kIndex.x, kIndex.y, kIndex.z};

TEST(FreeCodec, RoundTripIsExactAndWholeBlocksCostABit) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    FreeTile back;
    ASSERT_TRUE(DecodeFreeTile(BlobKind::kFreeV1, EncodeFreeTile(BlobKind::kFreeV1, SomeFreeTile(seed), kFreeTile),
                               kFreeTile, back)
                    .ok());
    EXPECT_EQ(back, SomeFreeTile(seed));
  }
  FreeBlocks all;
  all.full = ~std::uint64_t{0};
  FreeTile tile;
  tile.Add(all);
  EXPECT_LT(EncodeFreeTile(BlobKind::kFreeV1, tile, kFreeTile).size(), 40u);
}

TEST(FreeCodec, ATileOfOneLayerIsNoneOfTheOther) {
  FreeTile tile;
  const Bytes free = EncodeFreeTile(BlobKind::kFreeV1, SomeFreeTile(3), kFreeTile);
  const Bytes vacated = EncodeFreeTile(BlobKind::kVacatedV1, SomeFreeTile(3), kFreeTile);
  EXPECT_TRUE(DecodeFreeTile(BlobKind::kVacatedV1, vacated, kFreeTile, tile).ok());
  EXPECT_EQ(tile, SomeFreeTile(3));
  EXPECT_EQ(DecodeFreeTile(BlobKind::kVacatedV1, free, kFreeTile, tile).code(), StatusCode::kDataLoss);
  EXPECT_EQ(DecodeFreeTile(BlobKind::kFreeV1, vacated, kFreeTile, tile).code(), StatusCode::kDataLoss);
}

TEST(FreeCodec, EveryFlippedOrMissingByteIsDataLoss) {
  ExpectDamageIsSeen<FreeTile>(EncodeFreeTile(BlobKind::kFreeV1, SomeFreeTile(1), kFreeTile), DecodeFree);
}

TEST(GoneCodec, RoundTripIsExact) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const GoneBlock block = MapGenerator(seed).SomeGone();
    GoneBlock back;
    ASSERT_TRUE(DecodeGoneBlock(EncodeGoneBlock(block, kIndex), kIndex, back).ok());
    EXPECT_EQ(back, block);
    EXPECT_EQ(EncodeGoneBlock(back, kIndex), EncodeGoneBlock(block, kIndex));
  }
}

TEST(GoneCodec, EveryFlippedOrMissingByteIsDataLoss) {
  ExpectDamageIsSeen<GoneBlock>(EncodeGoneBlock(MapGenerator(1).SomeGone(), kIndex), DecodeGoneBlock);
}

TEST(GoneCodec, ForgedPayloadsAreHarmless) {
  const auto refused = [](std::size_t num_words, std::uint64_t word, double x_m) {
    Payload forged;
    ByteWriter plain(forged.plain), packable(forged.packable);
    plain.PutU64(7);
    for (const double value : {x_m, 0.0, 0.0}) plain.PutF64(value);
    for (std::size_t n = 0; n < num_words; ++n) packable.PutU64(word);
    GoneBlock block;
    const Status status = DecodeGoneBlock(Seal(BlobKind::kGoneV1, kIndex, forged), kIndex, block);
    EXPECT_TRUE(status.ok() || status.code() == StatusCode::kDataLoss) << status.ToString();
    return !status.ok();
  };
  EXPECT_FALSE(refused(16, 1, 0));
  EXPECT_TRUE(refused(15, 1, 0)) << "too short";
  EXPECT_TRUE(refused(17, 1, 0)) << "too long";
  EXPECT_TRUE(refused(16, 0, 0)) << "counts nothing";
  EXPECT_TRUE(refused(16, 1, std::numeric_limits<double>::quiet_NaN()));
}

TEST(LabelCodec, EveryFlippedOrMissingByteIsDataLoss) {
  ExpectDamageIsSeen<LabelBlock>(EncodeLabelBlock(SomeLabels(1), kIndex), DecodeLabelBlock);
}

/// What zstd begins a frame with that says how much it unpacks to.
Bytes FrameOf(std::uint64_t unpacked_bytes, std::size_t packed_bytes) {
  Bytes frame{0x28, 0xB5, 0x2F, 0xFD, 0xE0};
  for (int shift = 0; shift < 64; shift += 8) frame.push_back(static_cast<std::uint8_t>(unpacked_bytes >> shift));
  frame.resize(packed_bytes);
  return frame;
}

TEST(Envelope, WhatSaysItUnpacksToMoreThanAnyTileTakesIsNotUnpacked) {
  for (const std::uint64_t unpacked_bytes : {std::uint64_t{257} << 20, std::uint64_t{300} << 20, ~std::uint64_t{0}}) {
    // Sealed as it is, since it does not pack any further; then said to be packed.
    Bytes blob = Seal(BlobKind::kTsdfTile, kIndex, {.packable = {}, .plain = {}});
    blob.resize(blob.size() - 4);
    blob[1] = 1;
    const Bytes frame = FrameOf(unpacked_bytes, 5u << 20);
    blob.insert(blob.end(), frame.begin(), frame.end());
    Bytes key;
    ByteWriter numbers(key);
    for (const std::int32_t number : {kIndex.x, kIndex.y, kIndex.z}) numbers.PutU32(static_cast<std::uint32_t>(number));
    ByteWriter(blob).PutU32(Crc32c(blob, Crc32c(key)));
    Payload payload;
    const Status status = Unseal(BlobKind::kTsdfTile, kIndex, blob, payload);
    EXPECT_EQ(status.message(), "says an implausible length");
    EXPECT_EQ(payload.packable.capacity(), 0u);
  }
}

/// Forged payloads with a right checksum: the codecs behind the envelope must stand on their own.
template <typename Block, typename Decode>
void ExpectForgeriesAreHarmless(BlobKind kind, const Payload& payload, Decode decode) {
  Block block;
  std::mt19937 random(7);
  int num_refused = 0;
  for (int round = 0; round < 4000; ++round) {
    Payload forged = payload;
    Bytes& part = forged.plain.empty() || round % 4 ? forged.packable : forged.plain;
    switch (round % 3) {
      case 0: part[random() % std::min<std::size_t>(part.size(), 80)] = static_cast<std::uint8_t>(random()); break;
      case 1: part.resize(random() % part.size()); break;
      default:
        for (int n = 0; n < 8; ++n) part[random() % part.size()] = static_cast<std::uint8_t>(random());
    }
    const Status status = decode(Seal(kind, kIndex, forged), kIndex, block);
    if (status.ok()) continue;  // another block, but a block
    EXPECT_EQ(status.code(), StatusCode::kDataLoss) << status.ToString();
    ++num_refused;
  }
  EXPECT_GT(num_refused, 1000);
}

TEST(TsdfCodec, ForgedPayloadsAreHarmless) {
  Payload payload;
  ASSERT_TRUE(Unseal(BlobKind::kTsdfV1, kIndex, EncodeTsdfBlock(SomeTsdf(2), kIndex, kTruncation_m), payload).ok());
  ExpectForgeriesAreHarmless<TsdfBlock>(BlobKind::kTsdfV1, payload, DecodeTsdfBlock);
}

TEST(FreeCodec, ForgedPayloadsAreHarmless) {
  Payload payload;
  ASSERT_TRUE(
      Unseal(BlobKind::kFreeV1, kIndex, EncodeFreeTile(BlobKind::kFreeV1, SomeFreeTile(2), kFreeTile), payload).ok());
  ExpectForgeriesAreHarmless<FreeTile>(BlobKind::kFreeV1, payload, DecodeFree);
  const auto refused = [&](std::initializer_list<std::uint64_t> words) {
    Payload forged{.packable = {}, .plain = Bytes(8)};
    for (const std::uint64_t word : words) ByteWriter(forged.packable).PutU64(word);
    FreeTile tile;
    return DecodeFree(Seal(BlobKind::kFreeV1, kIndex, forged), kIndex, tile).code() == StatusCode::kDataLoss;
  };
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  EXPECT_FALSE(refused({1, 2, 1, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(refused({0, 0})) << "nothing";
  EXPECT_TRUE(refused({0, 2, 0, 0, 0, 0, 0, 0, 0, 0})) << "a mask of nothing";
  EXPECT_TRUE(refused({1, 2, kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll})) << "a mask of all";
  EXPECT_TRUE(refused({3, 2, 1, 0, 0, 0, 0, 0, 0, 0})) << "a mask of a block that is free";
}

TEST(LabelCodec, ForgedPayloadsAreHarmless) {
  Payload payload;
  ASSERT_TRUE(Unseal(BlobKind::kLabelsV1, kIndex, EncodeLabelBlock(SomeLabels(2), kIndex), payload).ok());
  ExpectForgeriesAreHarmless<LabelBlock>(BlobKind::kLabelsV1, payload, DecodeLabelBlock);
}

TEST(LabelTileCodec, KeepsWhatIsConcluded) {
  LayerBlocks<LabelBlock> blocks, read;
  for (int cell = 0; cell < 5; ++cell) {
    auto block = std::make_shared<LabelBlock>(SomeLabels(static_cast<std::uint32_t>(cell)));
    for (int i = cell; i < kBlockVoxels && cell % 2 == 0; i += 7) block->SetConcluded(i, true);
    blocks.push_back({9 * cell, block});
  }
  ASSERT_TRUE(DecodeLabelTile(EncodeLabelTile(blocks, kFreeTile), kFreeTile, read).ok());
  ASSERT_EQ(read.size(), blocks.size());
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    EXPECT_EQ(read[n].cell, blocks[n].cell);
    EXPECT_TRUE(*read[n].block == *blocks[n].block);
  }
}

TEST(LabelTileCodec, ForgedConclusionsAreDataLoss) {
  auto block = std::make_shared<LabelBlock>(SomeLabels(2));
  block->SetConcluded(9, true);
  Payload payload;
  const Bytes blob = EncodeLabelTile({{4, block}}, kFreeTile);
  ASSERT_TRUE(Unseal(BlobKind::kLabelsTile, kIndex, blob, payload).ok());
  LayerBlocks<LabelBlock> read;
  const auto code_of = [&](std::size_t byte, std::uint8_t value) {
    Payload forged = payload;
    forged.packable[byte] = value;
    return DecodeLabelTile(Seal(BlobKind::kLabelsTile, kIndex, forged), kFreeTile, read).code();
  };
  ASSERT_EQ(code_of(0, payload.packable[0]), StatusCode::kOk);
  EXPECT_EQ(code_of(8, 0x11), StatusCode::kDataLoss) << "of a block that is not there";
  EXPECT_EQ(code_of(16 + 64 + 1, 0), StatusCode::kDataLoss) << "a mask of nothing: each tile is stored in one way";
}

TEST(LabelCodec, AClassThatNoneCanHaveIsDataLoss) {
  // 65,535 marks voxels in overflow lists: taken for a class it would point beyond them.
  LabelBlock block;
  block.AddObservation(0, ClassId(5));
  Payload payload;
  ASSERT_TRUE(Unseal(BlobKind::kLabelsV1, kIndex, EncodeLabelBlock(block, kIndex), payload).ok());
  std::uint8_t& class_code = payload.packable[kBlockVoxels / 8 + 1];  // zigzag, low byte
  ASSERT_EQ(class_code, 10);
  class_code = 8;
  ASSERT_TRUE(DecodeLabelBlock(Seal(BlobKind::kLabelsV1, kIndex, payload), kIndex, block).ok());
  EXPECT_EQ(block.BestClass(0).id, 4u);
  class_code = 1;
  EXPECT_EQ(DecodeLabelBlock(Seal(BlobKind::kLabelsV1, kIndex, payload), kIndex, block).code(), StatusCode::kDataLoss);
}

TEST(Envelope, AnUnknownKindIsAPreconditionNotALoss) {
  TsdfBlock block;
  const Bytes blob = Seal(static_cast<BlobKind>(0x13), kIndex, {.packable = {1, 2, 3}, .plain = {4}});
  EXPECT_EQ(DecodeTsdfBlock(blob, kIndex, block).code(), StatusCode::kFailedPrecondition);
  LabelBlock labels;
  EXPECT_EQ(DecodeLabelBlock(blob, kIndex, labels).code(), StatusCode::kDataLoss) << "of another layer";
}

TEST(Envelope, ForgedLengthsTakeNoMemory) {
  // A zstd frame header that promises 2^62 bytes, and a plain part that promises 2^63, each with a right checksum.
  const auto resealed = [](Bytes bytes) {
    Bytes key;
    ByteWriter key_writer(key), writer(bytes);
    for (const int c : {kIndex.x, kIndex.y, kIndex.z}) key_writer.PutU32(static_cast<std::uint32_t>(c));
    writer.PutU32(Crc32c(bytes, Crc32c(key)));
    return bytes;
  };
  Payload payload;
  const Bytes frame = {0x28, 0xB5, 0x2F, 0xFD, 0xE0, 0, 0, 0, 0, 0, 0, 0, 0x40, 1, 0, 0};
  Bytes huge = {0x21, 1, 0};
  huge.insert(huge.end(), frame.begin(), frame.end());
  EXPECT_EQ(Unseal(BlobKind::kLabelsV1, kIndex, resealed(huge), payload).code(), StatusCode::kDataLoss);
  const Bytes plain = {0x21, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 1, 2, 3};
  EXPECT_EQ(Unseal(BlobKind::kLabelsV1, kIndex, resealed(plain), payload).code(), StatusCode::kDataLoss);
  EXPECT_EQ(payload.packable.capacity() + payload.plain.capacity(), 0u);
}

TEST(Envelope, KeepsPayloadsThatCompressBeyondItsLimitOrNotAtAll) {
  for (const std::size_t size : {0u, 1u, 100u, 100'000u, 3'000'000u}) {
    const Payload payload{.packable = Bytes(size, 7), .plain = Bytes(size % 977, 9)};
    Payload read;
    ASSERT_TRUE(Unseal(BlobKind::kTsdfV1, kIndex, Seal(BlobKind::kTsdfV1, kIndex, payload), read).ok()) << size;
    EXPECT_EQ(read.packable, payload.packable);
    EXPECT_EQ(read.plain, payload.plain);
  }
}

}  // namespace
}  // namespace dhpmap
