// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/refinement_round.h"

#include <algorithm>

#include "mapping/refinement/label_crf.h"

namespace dhpmap {
namespace {

/// A region's rim costs as much as itself below some hundred blocks.
constexpr int kLeastBlocksARegion = 600;

}  // namespace

void RefinementRound::Begin(const MapSnapshot& state, int most_regions) {
  pending_.Note(state, RimOfLabels(state.info().config));
  if (!IsFinished()) return;
  regions_ = CutRegions(pending_, state, most_regions, kLeastBlocksARegion);
  std::reverse(regions_.begin(), regions_.end());
}

RefinementReport RefinementRound::RefineNext(Map& map, ThreadPool& pool, const std::function<bool()>& is_cancelled) {
  if (regions_.empty()) return {};
  RefinementReport report = RefineRegion(map, pool, &regions_.back(), is_cancelled);
  pending_.Remove(regions_.back().cubes());
  regions_.pop_back();
  if (regions_.empty() && !(is_cancelled && is_cancelled())) report += RefineStrayVoxels(map, pool);
  return report;
}

}  // namespace dhpmap
