// SPDX-License-Identifier: BSD-3-Clause
// The store's decoders: whatever a damaged or forged file holds is refused, and what is accepted can be stored again.
// The first byte chooses the layer, and whether the blob's checksum is made right first: without that hardly any input
// would come as far as the decoders.
#include <algorithm>
#include <memory>
#include <type_traits>

#include "storage/codec/block_bundle.h"
#include "storage/codec/crc32c.h"
#include "storage/codec/gone_codec.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "storage/tiles/object_layers.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

constexpr BlockIndex kIndex{1, -2, 3};
constexpr double kTruncation_m = 0.08;
constexpr TileIndex kTile{kIndex.x, kIndex.y, kIndex.z};
// Of the first byte of an input; without this bit 1 is labels, 0 a TSDF.
constexpr int kGoneLayer = 4;
// Of the first byte, too: a layer of a tile, not of a block.
constexpr int kOfTile = 8;

/// The blob with the checksum that Seal would give it.
Bytes WithRightChecksum(ByteView blob) {
  Bytes index, sealed(blob.begin(), blob.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(blob.size(), 4)));
  ByteWriter writer(index);
  for (const std::int32_t coordinate : {kIndex.x, kIndex.y, kIndex.z}) {
    writer.PutU32(static_cast<std::uint32_t>(coordinate));
  }
  const std::uint32_t crc = Crc32c(sealed, Crc32c(index));
  ByteWriter(sealed).PutU32(crc);
  return sealed;
}

int LayerOf(std::uint8_t mode) { return (mode & kGoneLayer) != 0 ? kGoneLayer : mode & 1; }

void DecodeAndEncodeTile(const ObjectLayer& layer, ByteView blob) {
  BlockTile tile;
  if (!layer.decode(blob, kTile, tile).ok()) return;
  const SubmapInfo submap{.truncation_m = kTruncation_m};
  BlockTile again;
  fuzz::Require(layer.decode(layer.encode(tile, kTile, submap), kTile, again).ok());
  fuzz::Require(again.entries().size() == tile.entries().size());
}

const ObjectLayer& TileLayerOf(std::uint8_t mode) {
  return ObjectLayers()[LayerOf(mode) == kGoneLayer ? 2 : static_cast<std::size_t>(LayerOf(mode))];
}

void DecodeAndEncode(int layer, ByteView blob) {
  if (layer == 0) {
    TsdfBlock block;
    if (DecodeTsdfBlock(blob, kIndex, block).ok()) (void)EncodeTsdfBlock(block, kIndex, kTruncation_m);
  } else if (layer == kGoneLayer) {
    GoneBlock block;
    if (DecodeGoneBlock(blob, kIndex, block).ok())
      fuzz::Require(EncodeGoneBlock(block, kIndex).size() <= blob.size() + 256);
  } else {
    LabelBlock block;
    if (DecodeLabelBlock(blob, kIndex, block).ok()) (void)EncodeLabelBlock(block, kIndex);
  }
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  TsdfBlock tsdf;
  for (std::size_t i = 0; i < kBlockVoxels; i += 3) {
    tsdf.distance_m[i] = 0.0002f * static_cast<float>(i % 300);
    tsdf.weight[i] = static_cast<float>(1 + i % 7);
    tsdf.color[i] = {static_cast<std::uint8_t>(i), 100, 50};
  }
  LabelBlock labels;
  for (int i = 0; i < kBlockVoxels; i += 2) {
    for (int times = 0; times <= i % 9; ++times)
      labels.AddObservation(i, ClassId(static_cast<std::uint16_t>(times % 4)));
  }
  std::vector<std::string> seeds;
  const auto add = [&seeds](char layer, const Bytes& blob) {
    // A right checksum must not change what was right already: else the seeds, and the fuzzer, would test nothing.
    Require(WithRightChecksum(blob) == blob);
    for (const char mode : {layer, static_cast<char>(layer | 2)}) {
      seeds.push_back(mode + std::string(blob.begin(), blob.end()));
    }
  };
  add(0, EncodeTsdfBlock(tsdf, kIndex, kTruncation_m));
  add(0, EncodeTsdfBlock(TsdfBlock{}, kIndex, kTruncation_m));
  add(1, EncodeLabelBlock(labels, kIndex));
  add(1, EncodeLabelBlock(LabelBlock{}, kIndex));
  GoneBlock gone;
  gone.Raise({1, 2, 3, 4, 5, 6, 7, 8}, {{1, 2, 3}, 7});
  add(kGoneLayer, EncodeGoneBlock(gone, kIndex));

  const auto share = [](const auto& block) {
    return std::make_shared<const std::remove_cvref_t<decltype(block)>>(block);
  };
  TsdfBlock far = tsdf;
  far.distance_m[0] = 1;  // too far to be rounded
  add(kOfTile, EncodeTsdfTile({{0, share(tsdf)}, {63, share(far)}}, kTile, kTruncation_m));
  add(kOfTile | 1, EncodeLabelTile({{5, share(labels)}, {6, share(LabelBlock{})}}, kTile));
  add(kOfTile | kGoneLayer, EncodeGoneTile({{7, share(gone)}}, kTile));
  const BlockIndex in_tile = BlockIn(kTile, 9);
  add(kOfTile, EncodeBundle(BlobKind::kTsdfBlocks, {{9, EncodeTsdfBlock(tsdf, in_tile, kTruncation_m)}}, kTile));
  add(kOfTile | 1, EncodeBundle(BlobKind::kLabelsBlocks, {{9, EncodeLabelBlock(labels, in_tile)}}, kTile));
  add(kOfTile | kGoneLayer, EncodeBundle(BlobKind::kGoneBlocks, {{9, EncodeGoneBlock(gone, in_tile)}}, kTile));
  return seeds;
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  if (size == 0) return 0;
  const ByteView given(data + 1, size - 1);
  const Bytes blob = (data[0] & 2) != 0 ? WithRightChecksum(given) : Bytes(given.begin(), given.end());
  if ((data[0] & kOfTile) != 0) {
    DecodeAndEncodeTile(TileLayerOf(data[0]), blob);
  } else {
    DecodeAndEncode(LayerOf(data[0]), blob);
  }
  return 0;
}
