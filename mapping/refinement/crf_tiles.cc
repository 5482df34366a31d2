// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/crf_tiles.h"

#include <algorithm>
#include <map>
#include <optional>

#include "mapping/base/index_map.h"
#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

/// The most-seen instance of some voxels, and whether it is disputed.
struct FirstChoice {
  bool is_disputed = false;
  std::optional<SubmapId> instance;

  void Add(const FirstChoice& other) {
    is_disputed = is_disputed || other.is_disputed || (instance && other.instance && *instance != *other.instance);
    if (!instance) instance = other.instance;
  }
};

/// Whether the two highest counts are equal: then neighbours may decide.
class Lead {
 public:
  void operator()(SubmapCount seen) {
    is_tied_ = seen.count == most_ || (is_tied_ && seen.count < most_);
    most_ = std::max(most_, seen.count);
  }
  [[nodiscard]] bool is_tied() const { return is_tied_; }

 private:
  std::uint32_t most_ = 0;
  bool is_tied_ = false;
};

/// An earlier conclusion may change, so such voxels are disputed.
FirstChoice ChoiceOf(const HeldBlock& block, const KnownInstances& known) {
  FirstChoice choice;
  const LabelBlock& labels = *block.entry->labels;
  for (int i = 0; i < kBlockVoxels && !choice.is_disputed; ++i) {
    if (!block.TakesPart(i)) continue;
    Lead lead;
    known.Visit(block.holder, labels, i, [&lead](SubmapCount seen) { lead(seen); });
    choice.Add(
        {.is_disputed = lead.is_tied() || labels.IsConcluded(i), .instance = known.MostSeen(block.holder, labels, i)});
  }
  return choice;
}

/// All blocks at one index: a range in the list of CollectBlocks.
struct Place {
  BlockIndex index;
  std::uint32_t begin = 0, end = 0;
  FirstChoice choice;
  bool is_disputed = false;  ///< here or within the rim
};

class Places {
 public:
  Places(std::span<const HeldBlock> blocks, const KnownInstances& known, int rim, ThreadPool& pool) : rim_(rim) {
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
      if (i == 0 || blocks[i].index != blocks[i - 1].index) places_.push_back({.index = blocks[i].index, .begin = i});
      places_.back().end = i + 1;
    }
    numbers_.Reserve(places_.size());
    numbers_bytes_.Set(numbers_.MemoryBytes());
    for (std::uint32_t p = 0; p < places_.size(); ++p) numbers_.Set(places_[p].index, p);
    pool.ParallelFor(places_.size(), [&](std::size_t p) {
      for (std::uint32_t i = places_[p].begin; i < places_[p].end; ++i)
        places_[p].choice.Add(ChoiceOf(blocks[i], known));
    });
    pool.ParallelFor(places_.size(), [&](std::size_t p) {
      FirstChoice around;
      VisitAround(places_[p].index, [&](std::uint32_t n) { around.Add(places_[n].choice); });
      places_[p].is_disputed = around.is_disputed;
    });
  }

  [[nodiscard]] const ScratchVector<Place>& all() const { return places_; }

  /// Calls visit(index of the place) for the places within the rim of `index`, including itself.
  template <typename Visitor>
  void VisitAround(BlockIndex index, Visitor&& visit) const {
    VisitBlocksAround(index, rim_, [&](BlockIndex around) {
      const std::uint32_t number = numbers_.Find(around);
      if (number != IndexMap<BlockIndex>::kNone) visit(number);
    });
  }

 private:
  const int rim_;
  ScratchVector<Place> places_;
  IndexMap<BlockIndex> numbers_;
  CountedBytes numbers_bytes_{MemoryKind::kRefinement};
};

void Append(const Place& place, ScratchVector<std::uint32_t>& blocks) {
  for (std::uint32_t i = place.begin; i < place.end; ++i) blocks.push_back(i);
}

/// The surface is within a cell's diagonal of the voxels that show it. On two KITTI excerpts labels are as correct as
/// with the whole band of 6 voxels, or more so, in half the time.
constexpr double kMostDistance_vox = 2.001;

constexpr std::int32_t FloorDiv(std::int32_t a, std::int32_t b) { return (a >= 0 ? a : a - b + 1) / b; }

}  // namespace

ScratchVector<HeldBlock> CollectBlocks(std::span<const SubmapId> ids, const Map& map, const RefinementRegion* region,
                                       int rim) {
  ScratchVector<HeldBlock> blocks;
  const auto most_distance_m = static_cast<float>(kMostDistance_vox * map.info().config.voxel_size_m);
  for (const SubmapId id : ids) {
    const Submap* submap = map.Find(id);
    if (submap == nullptr || !IsExclusive(submap->info(), map.info().config)) continue;
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (region != nullptr && !region->IsNear(entry.index, rim)) continue;
      if (entry.tsdf && entry.labels) blocks.push_back({entry.index, id, &entry, most_distance_m});
    }
  }
  std::sort(blocks.begin(), blocks.end(), [](const HeldBlock& a, const HeldBlock& b) {
    return a.index != b.index ? a.index < b.index : a.holder < b.holder;
  });
  return blocks;
}

std::vector<CrfTile> CutTiles(std::span<const HeldBlock> blocks, const KnownInstances& known, int side, int rim,
                              ThreadPool& pool, const RefinementRegion* region) {
  const Places places(blocks, known, rim, pool);
  std::map<BlockIndex, ScratchVector<std::uint32_t>> cubes;  // disputed places; sorted, so that the result is
  for (std::uint32_t p = 0; p < places.all().size(); ++p) {
    const BlockIndex& index = places.all()[p].index;
    if (!places.all()[p].is_disputed || (region != nullptr && !region->Has(CubeOf(index)))) continue;
    cubes[{FloorDiv(index.x, side), FloorDiv(index.y, side), FloorDiv(index.z, side)}].push_back(p);
  }
  std::vector<CrfTile> tiles;
  for (const auto& [cube, inner] : cubes) {
    ScratchVector<std::uint32_t> around;
    for (const std::uint32_t p : inner) {
      places.VisitAround(places.all()[p].index, [&](std::uint32_t n) { around.push_back(n); });
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    CrfTile tile;
    for (const std::uint32_t p : inner) Append(places.all()[p], tile.inner);
    for (const std::uint32_t p : around) {
      if (!std::binary_search(inner.begin(), inner.end(), p)) Append(places.all()[p], tile.rim);
    }
    tiles.push_back(std::move(tile));
  }
  const auto num_blocks = [](const CrfTile& tile) { return tile.inner.size() + tile.rim.size(); };
  std::stable_sort(tiles.begin(), tiles.end(),
                   [&](const CrfTile& a, const CrfTile& b) { return num_blocks(a) > num_blocks(b); });
  return tiles;
}

}  // namespace dhpmap
