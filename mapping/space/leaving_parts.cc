// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/leaving_parts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "mapping/base/index_map.h"

namespace dhpmap {
namespace {

/// The surface of a block; nothing if it has none.
std::optional<SurfacePart> PartIn(const BlockEntry& entry, double voxel_size_m) {
  if (entry.tsdf == nullptr) return std::nullopt;
  SurfacePart part;
  const auto near_m = static_cast<float>(voxel_size_m);
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (!entry.tsdf->IsObserved(linear)) continue;
    if (std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(linear)]) >= near_m) continue;
    ++part.num_voxels;
    part.num_doubted += entry.gone != nullptr && entry.gone->Count(linear) >= 2;
  }
  if (part.num_voxels == 0) return std::nullopt;
  part.blocks.push_back(entry.index);
  return part;
}

/// Removes a block's part from `open`, with the parts of all blocks connected to it.
SurfacePart TakeTogether(std::size_t first, std::vector<std::optional<SurfacePart>>& open,
                         const IndexMap<BlockIndex>& numbers) {
  SurfacePart whole = *std::exchange(open[first], std::nullopt);
  for (std::size_t i = 0; i < whole.blocks.size(); ++i) {
    const BlockIndex block = whole.blocks[i];
    for (int n = 0; n < 27; ++n) {
      const std::uint32_t number = numbers.Find({block.x + n % 3 - 1, block.y + n / 3 % 3 - 1, block.z + n / 9 - 1});
      if (number == IndexMap<BlockIndex>::kNone || !open[number]) continue;
      whole.blocks.push_back(open[number]->blocks.front());
      whole.num_voxels += open[number]->num_voxels;
      whole.num_doubted += open[number]->num_doubted;
      open[number].reset();
    }
  }
  std::sort(whole.blocks.begin(), whole.blocks.end());
  return whole;
}

void ContradictAll(BlockIndex block, Submap& submap) {
  const std::shared_ptr<const TsdfBlock> tsdf = submap.blocks().Find(block)->tsdf;
  GoneBlock& gone = submap.MutableGone(block);
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (tsdf->IsObserved(linear)) gone.Set(linear, GoneBlock::kContradicted);
  }
}

}  // namespace

std::vector<SurfacePart> FindSurfaceParts(const Submap& submap) {
  std::vector<std::optional<SurfacePart>> open;
  IndexMap<BlockIndex> numbers;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    auto part = PartIn(entry, submap.info().voxel_size_m);
    if (!part) continue;
    numbers.Set(entry.index, static_cast<std::uint32_t>(open.size()));
    open.push_back(std::move(part));
  }
  std::vector<SurfacePart> parts;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i]) parts.push_back(TakeTogether(i, open, numbers));
  }
  std::sort(parts.begin(), parts.end(),
            [](const SurfacePart& a, const SurfacePart& b) { return a.blocks.front() < b.blocks.front(); });
  return parts;
}

std::vector<SurfacePart> LetPartsLeave(SubmapId id, Map& map) {
  std::vector<SurfacePart> parts = FindSurfaceParts(*map.Find(id));
  const auto is_leaving = [](const SurfacePart& part) { return part.IsLeaving(); };
  if (std::all_of(parts.begin(), parts.end(), is_leaving)) return parts;
  for (const SurfacePart& part : parts) {
    // A part that is already gone is not written again.
    if (!part.IsLeaving() || part.num_doubted == part.num_voxels) continue;
    for (const BlockIndex block : part.blocks) ContradictAll(block, *map.FindMutable(id));
  }
  std::erase_if(parts, is_leaving);
  return parts;
}

}  // namespace dhpmap
