// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/pending_cubes.h"

#include <algorithm>
#include <utility>

#include "mapping/refinement/refine_map.h"
#include "mapping/voxels/tile_marks.h"

namespace dhpmap {
namespace {

static_assert(kCubeSide % kTileSide == 0, "a tile lies in one cube");

CubeIndex CubeOfTile(TileIndex tile) {
  return CubeOf(BlockIndex{tile.x * kTileSide, tile.y * kTileSide, tile.z * kTileSide});
}

/// Compares block by block, because adopted blocks are in other tiles than the refined ones.
bool IsSameTile(const TileMarks& before, const TileEntry& now) {
  if (before.IsOf(now)) return true;
  const std::span<const BlockEntry> entries = now.tile->entries();
  return before.cells() == now.tile->cells() &&
         std::all_of(entries.begin(), entries.end(),
                     [&](const BlockEntry& entry) { return before.At(CellOf(entry.index)).IsOf(entry); });
}

/// Calls visit(TileIndex) for tiles that only one of both has, or that differ. Either may be null.
template <typename Visitor>
void VisitDifferentTiles(const SubmapMarks* before, const Submap* now, Visitor&& visit) {
  if (before != nullptr && now != nullptr && before->HaveUnread(*now)) return;
  for (std::size_t t = 0; now != nullptr && t < now->blocks().tiles().size(); ++t) {
    const TileEntry& tile = now->blocks().tiles()[t];
    const auto old = before != nullptr ? before->FindTile(tile.index) : nullptr;
    if (old == nullptr || !IsSameTile(*old, tile)) visit(tile.index);
  }
  for (std::size_t t = 0; before != nullptr && t < before->tiles().size(); ++t) {
    const TileIndex index = before->tiles()[t]->index();
    if (now == nullptr || now->blocks().FindTile(index) == nullptr) visit(index);
  }
}

/// Collects the cubes of tiles and those around that they affect.
class Around {
 public:
  Around(int rim, std::set<CubeIndex>& cubes) : reach_(std::max(0, (rim + kCubeSide - 1) / kCubeSide)), cubes_(cubes) {}

  void operator()(TileIndex tile) {
    const CubeIndex c = CubeOfTile(tile);
    if (has_last_ && c == last_) return;
    has_last_ = true;
    last_ = c;
    for (std::int32_t x = c.x - reach_; x <= c.x + reach_; ++x) {
      for (std::int32_t y = c.y - reach_; y <= c.y + reach_; ++y) {
        for (std::int32_t z = c.z - reach_; z <= c.z + reach_; ++z) cubes_.insert({x, y, z});
      }
    }
  }

 private:
  const int reach_;
  std::set<CubeIndex>& cubes_;
  bool has_last_ = false;
  CubeIndex last_;
};

/// The submap if it is refined, else null.
const Submap* Refined(const Submap* submap, const MapConfig& config) {
  return submap != nullptr && IsRefined(submap->info(), config) ? submap : nullptr;
}

const SubmapMarks* Refined(const SubmapMarks* marks, const MapConfig& config) {
  return marks != nullptr && IsRefined(marks->info(), config) ? marks : nullptr;
}

}  // namespace

void PendingCubes::Note(const MapSnapshot& now, int rim) {
  const MapConfig& config = now.info().config;
  Around around(rim, cubes_);
  for (const auto& submap : now.submaps()) {
    const SubmapMarks* before = marks_ != nullptr ? marks_->Find(submap->id()) : nullptr;
    if (before != nullptr && before->IsOf(submap)) continue;
    VisitDifferentTiles(Refined(before, config), Refined(submap.get(), config), around);
  }
  if (marks_ != nullptr) {
    for (const auto& [id, before] : marks_->submaps()) {
      if (now.Find(id) == nullptr) VisitDifferentTiles(Refined(before.get(), config), nullptr, around);
    }
  }
  NoteRefined(now);
}

void PendingCubes::NoteRefined(const MapSnapshot& refined, const RegionPart& part) {
  if (part.IsAll() || marks_ == nullptr) {
    marks_ = std::make_shared<const StateMarks>(refined, marks_.get());
  } else {
    marks_ =
        std::make_shared<const StateMarks>(*marks_, refined, [&part](BlockIndex block) { return part.Has(block); });
  }
}

void PendingCubes::Remove(std::span<const CubeIndex> cubes) {
  for (const CubeIndex cube : cubes) cubes_.erase(cube);
}

std::vector<RefinementRegion> CutRegions(const PendingCubes& pending, const MapSnapshot& state, int most_regions,
                                         int least_blocks) {
  std::map<CubeIndex, std::size_t> num_blocks;
  std::size_t all = 0;
  for (const auto& submap : state.submaps()) {
    if (Refined(submap.get(), state.info().config) == nullptr) continue;
    for (const TileEntry& tile : submap->blocks().tiles()) {
      if (!pending.cubes().contains(CubeOfTile(tile.index))) continue;
      num_blocks[CubeOfTile(tile.index)] += tile.tile->size();
      all += tile.tile->size();
    }
  }
  const std::size_t most_blocks =
      std::max<std::size_t>(static_cast<std::size_t>(least_blocks), all / static_cast<std::size_t>(most_regions) + 1);
  std::vector<RefinementRegion> regions;
  std::vector<CubeIndex> cubes;
  std::size_t in_region = 0, before = 0;
  for (const auto& [cube, count] : num_blocks) {
    cubes.push_back(cube);
    in_region += count;
    if (before + in_region < most_blocks * (regions.size() + 1)) continue;
    regions.emplace_back(cubes);
    before += std::exchange(in_region, 0);
    cubes.clear();
  }
  if (!cubes.empty()) regions.emplace_back(cubes);
  return regions;
}

}  // namespace dhpmap
