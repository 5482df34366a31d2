// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_crf.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/evidence/voxel_handover.h"
#include "mapping/refinement/bounded_loop.h"
#include "mapping/refinement/crf_tiles.h"
#include "mapping/refinement/tied_voxels.h"
#include "mapping/refinement/tile_marginals.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {
namespace {

/// Limits of blocks in running tiles. With about 80 voxels per block and 0.5 kB per voxel they take 50 MB, more on
/// machines with many cores. The sample apartment's largest tile has 1,178 blocks.
constexpr std::size_t kMostBlocksAtOnce = 1400, kMostBlocksAThread = 500;

/// Paper eq. (2) for one voxel: the most likely label within reach of the place; on a tie with the most-seen label,
/// that one.
SubmapId LikeliestLabel(std::span<const float> q, const LabelChannels& channels, std::uint32_t place,
                        SubmapId most_seen) {
  SubmapId best = most_seen;
  float most = q[channels.ChannelOf(most_seen.value)];
  for (std::uint32_t c = 0; c < q.size(); ++c) {
    const std::uint32_t label = channels.LabelAt(place, c);
    if (q[c] <= most || label == LabelChannels::kNone) continue;
    most = q[c];
    best = SubmapId(label);
  }
  return best;
}

/// The label of each member, including the rim, from the CRF's values.
ScratchVector<SubmapId> Conclude(const TileProblem& problem, std::span<const float> values) {
  const auto stride = static_cast<std::size_t>(problem.channels().num_channels());
  ScratchVector<SubmapId> labels(problem.members().size());
  for (std::size_t m = 0; m < labels.size(); ++m) {
    const TileProblem::Member& member = problem.members()[m];
    labels[m] =
        LikeliestLabel(values.subspan(m * stride, stride), problem.channels(), member.place, problem.MostSeen(member));
  }
  KeepTiedWithTheirSurface(problem, labels);
  return labels;
}

struct TileOutcome {
  ScratchVector<Handover> handovers;
  std::int64_t num_voxels = 0;  // without the rim
};

/// Solves the inner voxels of a tile from observations only, regardless of earlier conclusions.
TileOutcome SolveTile(std::span<const HeldBlock> blocks, const KnownInstances& known, const CrfTile& tile, int rim,
                      const MapConfig& config) {
  const TileProblem problem(blocks, known, tile, rim, config.voxel_size_m);
  const ScratchVector<float> values = TileMarginals(problem, config);
  const ScratchVector<SubmapId> labels = Conclude(problem, values);
  TileOutcome outcome{.handovers = {}, .num_voxels = static_cast<std::int64_t>(problem.num_inner())};
  for (std::size_t m = 0; m < problem.num_inner(); ++m) {
    const TileProblem::Member& member = problem.members()[m];
    const HeldBlock& block = problem.BlockOf(member);
    const SubmapId best = labels[m];
    const bool is_concluded = best != problem.MostSeen(member);
    if (best == block.holder && block.entry->labels->IsConcluded(member.linear) == is_concluded) continue;
    outcome.handovers.push_back({block.index, member.linear, block.holder, best, is_concluded});
  }
  return outcome;
}

ClassId ClassOf(const Map& map, SubmapId id) { return map.Find(id)->info().class_id; }

}  // namespace

int RimOfLabels(const MapConfig& config) {
  const RefinementConfig& refine = config.refinement;
  const double reach_m = 1.5 * std::max(refine.smoothness.weight > 0 ? refine.smoothness.position_m : 0.0,
                                        refine.appearance.weight > 0 ? refine.appearance.position_m : 0.0);
  return std::max(1, static_cast<int>(std::ceil(reach_m / (kBlockSide * config.voxel_size_m))));
}

LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool, const RefinementRegion* region,
                            const std::function<bool()>& is_cancelled) {
  const MapConfig& config = map.info().config;
  const KnownInstances known(ids, map);
  const int rim = RimOfLabels(config);
  const ScratchVector<HeldBlock> blocks = CollectBlocks(ids, map, region, rim);
  const std::vector<CrfTile> tiles = CutTiles(blocks, known, kCubeSide, rim, pool, region);
  LabelCrfReport report{.num_tiles = static_cast<int>(tiles.size())};
  std::vector<TileOutcome> outcomes(tiles.size());
  std::vector<std::size_t> num_blocks;
  num_blocks.reserve(tiles.size());
  for (const CrfTile& tile : tiles) num_blocks.push_back(tile.inner.size() + tile.rim.size());
  const std::size_t most_at_once =
      std::max(kMostBlocksAtOnce, kMostBlocksAThread * static_cast<std::size_t>(pool.num_threads()));
  BoundedParallelFor(pool, num_blocks, most_at_once, [&](std::size_t t) {
    if (!is_cancelled || !is_cancelled()) outcomes[t] = SolveTile(blocks, known, tiles[t], rim, config);
  });

  // Tiles are disjoint, so their handovers are, too.
  ScratchVector<Handover> handovers;
  for (const TileOutcome& outcome : outcomes) {
    handovers.insert(handovers.end(), outcome.handovers.begin(), outcome.handovers.end());
    report.num_voxels += outcome.num_voxels;
  }
  for (const Handover& handover : handovers) {
    if (handover.from == handover.to) continue;
    report.num_changed_instances += 1;
    report.num_changed_classes += ClassOf(map, handover.from) != ClassOf(map, handover.to);
  }
  HandOver(std::move(handovers), map, pool);
  return report;
}

}  // namespace dhpmap
