// SPDX-License-Identifier: BSD-3-Clause
#include "storage/tiles/object_layers.h"

#include <bit>
#include <memory>
#include <utility>
#include <vector>

#include "storage/codec/block_bundle.h"
#include "storage/codec/gone_codec.h"
#include "storage/codec/label_codec.h"
#include "storage/codec/tsdf_codec.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

/// The member of a block that has a layer.
template <typename Block>
using Member = std::shared_ptr<const Block> BlockEntry::*;

template <typename Block>
LayerBlocks<Block> BlocksOf(const BlockTile& tile, Member<Block> member) {
  LayerBlocks<Block> blocks;
  blocks.reserve(tile.entries().size());
  for (const BlockEntry& entry : tile.entries()) {
    if (entry.*member != nullptr) blocks.push_back({CellOf(entry.index), entry.*member});
  }
  return blocks;
}

template <typename Block>
Status DecodeBundled(BlobKind kind, ByteView blob, TileIndex index, LayerBlocks<Block>& blocks,
                     Status (*decode)(ByteView, BlockIndex, Block&)) {
  std::vector<BundledBlob> blobs;
  DHPMAP_RETURN_IF_ERROR(DecodeBundle(kind, blob, index, blobs));
  for (const BundledBlob& entry : blobs) {
    auto block = std::shared_ptr<Block>(new Block());  // not make_shared: StateMarks would keep its memory
    DHPMAP_RETURN_IF_ERROR(decode(entry.blob, BlockIn(index, entry.cell), *block));
    blocks.push_back({entry.cell, std::move(block)});
  }
  return Status::Ok();
}

/// `of_tile` decodes the current form, `of_block` the blocks inside a bundle.
template <typename Block>
Status DecodeInto(BlobKind bundle, ByteView blob, TileIndex index, BlockTile& tile, Member<Block> member,
                  Status (*of_tile)(ByteView, TileIndex, LayerBlocks<Block>&),
                  Status (*of_block)(ByteView, BlockIndex, Block&)) {
  LayerBlocks<Block> blocks;
  const bool is_bundle = KindByte(blob) == static_cast<std::uint8_t>(bundle);
  DHPMAP_RETURN_IF_ERROR(is_bundle ? DecodeBundled(bundle, blob, index, blocks, of_block)
                                   : of_tile(blob, index, blocks));
  for (auto& [cell, block] : blocks) tile.FindOrInsert(BlockIn(index, cell)).*member = std::move(block);
  return Status::Ok();
}

Bytes EncodeTsdf(const BlockTile& tile, TileIndex index, const SubmapInfo& submap) {
  return EncodeTsdfTile(BlocksOf(tile, &BlockEntry::tsdf), index, submap.truncation_m);
}
Status DecodeTsdf(ByteView blob, TileIndex index, BlockTile& tile) {
  return DecodeInto(BlobKind::kTsdfBlocks, blob, index, tile, &BlockEntry::tsdf, DecodeTsdfTile, DecodeTsdfBlock);
}

Bytes EncodeLabels(const BlockTile& tile, TileIndex index, const SubmapInfo&) {
  return EncodeLabelTile(BlocksOf(tile, &BlockEntry::labels), index);
}
Status DecodeLabels(ByteView blob, TileIndex index, BlockTile& tile) {
  return DecodeInto(BlobKind::kLabelsBlocks, blob, index, tile, &BlockEntry::labels, DecodeLabelTile, DecodeLabelBlock);
}

Bytes EncodeGone(const BlockTile& tile, TileIndex index, const SubmapInfo&) {
  return EncodeGoneTile(BlocksOf(tile, &BlockEntry::gone), index);
}
Status DecodeGone(ByteView blob, TileIndex index, BlockTile& tile) {
  return DecodeInto(BlobKind::kGoneBlocks, blob, index, tile, &BlockEntry::gone, DecodeGoneTile, DecodeGoneBlock);
}

constexpr ObjectLayer kLayers[kNumBlockLayers] = {
    {BlockLayer::kTsdf, LayerNumber(BlobKind::kTsdfTile), "tsdf", &SubmapCounts::num_tsdf_blocks, EncodeTsdf,
     DecodeTsdf},
    {BlockLayer::kLabels, LayerNumber(BlobKind::kLabelsTile), "label", &SubmapCounts::num_label_blocks, EncodeLabels,
     DecodeLabels},
    {BlockLayer::kGone, LayerNumber(BlobKind::kGoneTile), "gone", &SubmapCounts::num_gone_blocks, EncodeGone,
     DecodeGone},
};

}  // namespace

std::span<const ObjectLayer> ObjectLayers() { return kLayers; }

const ObjectLayer* FindObjectLayer(std::int64_t number) {
  for (const ObjectLayer& layer : kLayers) {
    if (layer.number == number) return &layer;
  }
  return nullptr;
}

std::string TileName(std::uint32_t submap_id, std::int64_t layer, TileIndex index) {
  const ObjectLayer* known = FindObjectLayer(layer);
  const std::string name = known != nullptr ? std::string(known->name) : "layer " + std::to_string(layer);
  return "submap " + std::to_string(submap_id) + ": " + NameOfTile(name, index);
}

SubmapCounts CountBlocks(const Submap& submap) {
  SubmapCounts counts;
  for (const TileEntry& tile : submap.blocks().tiles()) {
    for (const ObjectLayer& layer : kLayers) {
      if (layer.count != nullptr) counts.*layer.count += std::popcount(tile.tile->CellsWith(layer.layer));
    }
  }
  return counts;
}

Status CheckCounts(const SubmapCounts& found, const SubmapCounts& stored) {
  for (const ObjectLayer& layer : kLayers) {
    if (layer.count == nullptr || found.*layer.count == stored.*layer.count) continue;
    return DataLoss("has " + std::to_string(found.*layer.count) + " " + std::string(layer.name) + " blocks, not " +
                    std::to_string(stored.*layer.count));
  }
  return Status::Ok();
}

}  // namespace dhpmap
