// SPDX-License-Identifier: BSD-3-Clause
// Blobs of tiles, against those of single blocks as the slow, obvious reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "storage/codec/block_bundle.h"
#include "storage/codec/gone_codec.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "storage/tiles/object_layers.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::MapGenerator;

constexpr TileIndex kTile{-2, 0, 7};
constexpr TileIndex kOther{-2, 1, 7};
constexpr double kTileTruncation_m = 0.08;

/// Some blocks of a tile, each filled by fill(MapGenerator&, Block&).
template <typename Block, typename Fill>
LayerBlocks<Block> SomeBlocks(std::uint32_t seed, Fill&& fill) {
  MapGenerator generator(seed);
  LayerBlocks<Block> blocks;
  for (int cell = generator.Below(6); cell < kTileBlocks; cell += 1 + generator.Below(12)) {
    auto block = std::make_shared<Block>();
    fill(generator, *block);
    blocks.push_back({cell, std::move(block)});
  }
  return blocks;
}
LayerBlocks<TsdfBlock> SomeTsdfBlocks(std::uint32_t seed) {
  return SomeBlocks<TsdfBlock>(seed,
                               [](auto& generator, TsdfBlock& block) { generator.FillTsdf(block, kTileTruncation_m); });
}
LayerBlocks<LabelBlock> SomeLabelBlocks(std::uint32_t seed) {
  return SomeBlocks<LabelBlock>(seed, [](auto& generator, LabelBlock& block) { generator.FillLabels(block); });
}
LayerBlocks<GoneBlock> SomeGoneBlocks(std::uint32_t seed) {
  return SomeBlocks<GoneBlock>(seed, [](auto& generator, GoneBlock& block) { block = generator.SomeGone(); });
}

bool IsSameBlock(const TsdfBlock& a, const TsdfBlock& b) {
  return a.distance_m == b.distance_m && a.weight == b.weight && a.color == b.color;
}

template <typename Block>
std::vector<int> Cells(const LayerBlocks<Block>& blocks) {
  std::vector<int> cells;
  for (const auto& entry : blocks) cells.push_back(entry.cell);
  return cells;
}

TEST(TileCodec, TsdfOfATileIsToTheBitThatOfItsBlocksOneByOne) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    LayerBlocks<TsdfBlock> blocks = SomeTsdfBlocks(seed);
    if (seed % 3 == 0) {  // one whose distances are kept exactly, and one of nothing
      auto far = std::make_shared<TsdfBlock>(*blocks[0].block);
      far->weight[5] = 2;
      far->distance_m[5] = 0.5f;
      blocks[0].block = far;
      blocks.back().block = std::make_shared<TsdfBlock>();
    }
    LayerBlocks<TsdfBlock> back;
    const Bytes blob = EncodeTsdfTile(blocks, kTile, kTileTruncation_m);
    ASSERT_TRUE(DecodeTsdfTile(blob, kTile, back).ok());
    ASSERT_EQ(Cells(back), Cells(blocks));
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      TsdfBlock one;
      const BlockIndex index = BlockIn(kTile, blocks[i].cell);
      ASSERT_TRUE(DecodeTsdfBlock(EncodeTsdfBlock(*blocks[i].block, index, kTileTruncation_m), index, one).ok());
      EXPECT_TRUE(IsSameBlock(*back[i].block, one)) << "seed " << seed << ", block " << i;
    }
    EXPECT_EQ(EncodeTsdfTile(back, kTile, kTileTruncation_m), blob) << "encoding what was decoded gives the same bytes";
  }
}

TEST(TileCodec, TsdfWithoutATruncationIsExact) {
  const LayerBlocks<TsdfBlock> blocks = SomeTsdfBlocks(4);
  LayerBlocks<TsdfBlock> back;
  ASSERT_TRUE(DecodeTsdfTile(EncodeTsdfTile(blocks, kTile, 0), kTile, back).ok());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (int v = 0; v < kBlockVoxels; ++v) {
      const auto at = static_cast<std::size_t>(v);
      EXPECT_EQ(blocks[i].block->IsObserved(v) ? blocks[i].block->distance_m[at] : 0, back[i].block->distance_m[at]);
    }
  }
}

TEST(TileCodec, LabelsAndWhatIsGoneComeBackAsTheyWere) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const LayerBlocks<LabelBlock> labels = SomeLabelBlocks(seed);
    LayerBlocks<LabelBlock> labels_back;
    ASSERT_TRUE(DecodeLabelTile(EncodeLabelTile(labels, kTile), kTile, labels_back).ok());
    ASSERT_EQ(Cells(labels_back), Cells(labels));
    for (std::size_t i = 0; i < labels.size(); ++i) EXPECT_TRUE(*labels_back[i].block == *labels[i].block);

    const LayerBlocks<GoneBlock> gone = SomeGoneBlocks(seed);
    LayerBlocks<GoneBlock> gone_back;
    ASSERT_TRUE(DecodeGoneTile(EncodeGoneTile(gone, kTile), kTile, gone_back).ok());
    ASSERT_EQ(Cells(gone_back), Cells(gone));
    for (std::size_t i = 0; i < gone.size(); ++i) EXPECT_TRUE(*gone_back[i].block == *gone[i].block);
  }
}

TEST(TileCodec, ATileIsSmallerThanItsBlocksOneByOne) {
  std::size_t tile_bytes = 0, block_bytes = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const LayerBlocks<LabelBlock> labels = SomeLabelBlocks(seed);
    tile_bytes += EncodeLabelTile(labels, kTile).size();
    for (const auto& [cell, block] : labels) block_bytes += EncodeLabelBlock(*block, BlockIn(kTile, cell)).size();
  }
  EXPECT_LT(tile_bytes, block_bytes);
}

TEST(TileCodec, AFullTileOfTheSimplestBlocksIsPacked) {
  LayerBlocks<TsdfBlock> blocks;
  auto block = std::make_shared<TsdfBlock>();
  block->weight.fill(1);
  for (int cell = 0; cell < kTileBlocks; ++cell) blocks.push_back({cell, block});
  const Bytes blob = EncodeTsdfTile(blocks, kTile, kTileTruncation_m);
  EXPECT_LT(blob.size(), 2000u);
  LayerBlocks<TsdfBlock> back;
  EXPECT_TRUE(DecodeTsdfTile(blob, kTile, back).ok());
}

TEST(TileCodec, BundledBlocksAreReadAsTheyWereStored) {
  MapGenerator generator(3);
  Submap submap({.truncation_m = kTileTruncation_m}, 1);
  for (const int cell : {1, 17, 63}) {
    const BlockIndex index = BlockIn(kTile, cell);
    generator.FillTsdf(submap.MutableTsdf(index), kTileTruncation_m);
    generator.FillLabels(submap.MutableLabels(index));
    submap.PutGone(index, std::make_shared<const GoneBlock>(generator.SomeGone()));
  }
  std::vector<BundledBlob> tsdf, labels, gone;
  const BlockTile& tile = *submap.blocks().tiles()[0].tile;
  for (const BlockEntry& entry : tile.entries()) {
    tsdf.push_back({CellOf(entry.index), EncodeTsdfBlock(*entry.tsdf, entry.index, kTileTruncation_m)});
    labels.push_back({CellOf(entry.index), EncodeLabelBlock(*entry.labels, entry.index)});
    gone.push_back({CellOf(entry.index), EncodeGoneBlock(*entry.gone, entry.index)});
  }
  BlockTile back;
  ASSERT_TRUE(ObjectLayers()[0].decode(EncodeBundle(BlobKind::kTsdfBlocks, tsdf, kTile), kTile, back).ok());
  ASSERT_TRUE(ObjectLayers()[1].decode(EncodeBundle(BlobKind::kLabelsBlocks, labels, kTile), kTile, back).ok());
  ASSERT_TRUE(ObjectLayers()[2].decode(EncodeBundle(BlobKind::kGoneBlocks, gone, kTile), kTile, back).ok());
  ASSERT_EQ(back.entries().size(), 3u);
  for (const BlockEntry& entry : back.entries()) {
    const BlockEntry& was = *tile.Find(CellOf(entry.index));
    testing::ExpectSameTsdf(*was.tsdf, *entry.tsdf, kTileTruncation_m / 4096, 1.0 / 65536);
    EXPECT_TRUE(*was.labels == *entry.labels);
    EXPECT_TRUE(*was.gone == *entry.gone);
  }
  // A blob that was damaged when it was a row of its own still is.
  tsdf[1].blob[20] ^= 1;
  EXPECT_EQ(ObjectLayers()[0].decode(EncodeBundle(BlobKind::kTsdfBlocks, tsdf, kTile), kTile, back).code(),
            StatusCode::kDataLoss);
}

TEST(TileCodec, EveryFlippedOrMissingByteIsDataLoss) {
  MapGenerator generator(5);
  Submap submap({.truncation_m = kTileTruncation_m}, 1);
  for (const int cell : {0, 40}) {
    const BlockIndex index = BlockIn(kTile, cell);
    TsdfBlock& tsdf = submap.MutableTsdf(index);
    for (std::size_t i = 0; i < 40; ++i) tsdf.weight[9 * i] = static_cast<float>(1 + i % 3);
    for (int i = 0; i < 40; ++i) submap.MutableLabels(index).AddObservation(7 * i, ClassId(9));
    submap.PutGone(index, std::make_shared<const GoneBlock>(generator.SomeGone()));
  }
  const BlockTile& tile = *submap.blocks().tiles()[0].tile;
  for (const ObjectLayer& layer : ObjectLayers()) {
    SCOPED_TRACE(layer.name);
    const Bytes blob = layer.encode(tile, kTile, submap.info());
    const auto decode = [&layer](ByteView bytes, TileIndex index) {
      BlockTile into;
      return layer.decode(bytes, index, into).code();
    };
    EXPECT_EQ(decode(blob, kTile), StatusCode::kOk);
    EXPECT_EQ(decode(blob, kOther), StatusCode::kDataLoss) << "under another index";
    for (std::size_t i = 0; i < blob.size(); ++i) {
      for (const int flip : {0x01, 0x80, 0xFF}) {
        Bytes damaged = blob;
        damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ flip);
        ASSERT_EQ(decode(damaged, kTile), StatusCode::kDataLoss) << "byte " << i << " ^ " << flip;
      }
      ASSERT_EQ(decode(ByteView(blob).first(i), kTile), StatusCode::kDataLoss) << "cut at " << i;
    }
  }
}

/// Forged payloads with a right checksum: the codecs behind the envelope must stand on their own.
TEST(TileCodec, ForgedPayloadsAreHarmless) {
  struct BadTile {
    BlobKind kind;
    Bytes blob;
  };
  const std::vector<BadTile> cases = {
      {BlobKind::kTsdfTile, EncodeTsdfTile(SomeTsdfBlocks(2), kTile, kTileTruncation_m)},
      {BlobKind::kLabelsTile, EncodeLabelTile(SomeLabelBlocks(2), kTile)},
      {BlobKind::kGoneTile, EncodeGoneTile(SomeGoneBlocks(2), kTile)},
      {BlobKind::kTsdfBlocks, EncodeBundle(BlobKind::kTsdfBlocks, {{3, {1, 2, 3}}}, kTile)}};
  std::mt19937 random(7);
  for (const BadTile& c : cases) {
    Payload payload;
    ASSERT_TRUE(Unseal(c.kind, SealIndexOf(kTile), c.blob, payload).ok());
    int num_refused = 0;
    for (int round = 0; round < 1500; ++round) {
      Payload forged = payload;
      Bytes& part =
          forged.packable.empty() || (round % 4 == 0 && !forged.plain.empty()) ? forged.plain : forged.packable;
      switch (round % 3) {
        case 0: part[random() % std::min<std::size_t>(part.size(), 80)] = static_cast<std::uint8_t>(random()); break;
        case 1: part.resize(random() % part.size()); break;
        default:
          for (int n = 0; n < 8; ++n) part[random() % part.size()] = static_cast<std::uint8_t>(random());
      }
      BlockTile tile;
      const Status status =
          FindObjectLayer(LayerNumber(c.kind))->decode(Seal(c.kind, SealIndexOf(kTile), forged), kTile, tile);
      if (status.ok()) continue;  // another tile, but a tile
      EXPECT_EQ(status.code(), StatusCode::kDataLoss) << status.ToString();
      ++num_refused;
    }
    EXPECT_GT(num_refused, 300);
  }
}

TEST(TileCodec, ACodecOfALaterVersionIsNoDamage) {
  BlockTile tile;
  for (const ObjectLayer& layer : ObjectLayers()) {
    const auto later = static_cast<BlobKind>(layer.number << 4 | 0xE);
    EXPECT_EQ(layer.decode(Seal(later, SealIndexOf(kTile), {.packable = {1}, .plain = {}}), kTile, tile).code(),
              StatusCode::kFailedPrecondition);
  }
}

}  // namespace
}  // namespace dhpmap
