// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/refinement_round.h"

#include <algorithm>

#include "mapping/refinement/label_crf.h"

namespace dhpmap {
namespace {

/// Dropped labels are restored from the whole submap.
bool HasDroppedLabels(const MapSnapshot& state) {
  const auto is_without = [](const TileEntry& tile) {
    return (tile.tile->CellsWith(BlockLayer::kTsdf) & ~tile.tile->CellsWith(BlockLayer::kLabels)) != 0;
  };
  return std::any_of(state.submaps().begin(), state.submaps().end(), [&](const auto& submap) {
    if (submap->id() == kUnknownSubmap || !IsRefined(submap->info(), state.info().config)) return false;
    const auto tiles = submap->blocks().tiles();
    return std::any_of(tiles.begin(), tiles.end(), is_without);
  });
}

}  // namespace

void RefinementRound::Begin(const MapSnapshot& state, int most_steps, int least_blocks) {
  rim_ = RimOfLabels(state.info().config);
  pending_.Note(state, rim_);
  needs_all_ = HasDroppedLabels(state);
  if (!IsFinished()) return;
  regions_ = CutRegions(pending_, state, std::max(1, most_steps - 1), least_blocks);
  std::reverse(regions_.begin(), regions_.end());
  are_strays_left_ = !regions_.empty();
  have_strays_a_step_ = regions_.size() > 1;
}

RegionPart RefinementRound::NextPart() const {
  if (needs_all_ || regions_.empty() || IsOnlyStep()) return {};
  return {regions_.back(), rim_};
}

RefinementReport RefinementRound::RefineNext(Map& map, ThreadPool& pool, const std::function<bool()>& is_cancelled) {
  RefinementReport report;
  const bool is_turn_of_strays = are_strays_left_ && (regions_.empty() || IsOnlyStep());
  if (!regions_.empty()) {
    report = RefineRegion(map, pool, &regions_.back(), is_cancelled);
    pending_.Remove(regions_.back().cubes());
    regions_.pop_back();
  }
  if (!is_turn_of_strays) return report;
  are_strays_left_ = false;
  if (!is_cancelled || !is_cancelled()) report += RefineStrayVoxels(map, pool);
  return report;
}

}  // namespace dhpmap
