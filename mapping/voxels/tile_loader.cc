// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tile_loader.h"

namespace dhpmap {
namespace {

std::atomic<std::uint64_t>& HitsOfProcess() {
  static constinit std::atomic<std::uint64_t> hits = 0;
  return hits;
}

std::size_t BytesOfBlocks(const std::vector<BlockEntry>& blocks) {
  std::size_t bytes = blocks.capacity() * sizeof(BlockEntry);
  for (const BlockEntry& block : blocks) {
    ForEachLayer([&bytes](BlockLayer, const auto& layer) { bytes += layer != nullptr ? layer->MemoryBytes() : 0; },
                 block);
  }
  return bytes;
}

}  // namespace

void TileLoader::SetBlocks(std::vector<BlockEntry> blocks) const {
  blocks_ = std::move(blocks);
  num_bytes_ = BytesOfBlocks(blocks_);
  num_label_plane_bytes_ = LabelPlaneBytesOf(blocks_);
  is_read_.store(true, std::memory_order_release);
}

void TileLoader::AddHits() { HitsOfProcess().fetch_add(std::exchange(hits_of_thread_, 0), std::memory_order_relaxed); }

std::uint64_t TileLoader::NumHits() { return HitsOfProcess().load(std::memory_order_relaxed); }

}  // namespace dhpmap
