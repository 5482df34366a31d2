// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/tile_marginals.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "mapping/crf/dense_crf.h"
#include "mapping/refinement/near_evidence.h"

namespace dhpmap {
namespace {

/// Count for a voxel without observations; evidence below it has little effect.
constexpr float kPriorCount = 1.0f;

/// The unary term of paper eq. (3), from evidence instead of shares: with shares, 300 against 200 observations would
/// equal 3 against 2. It is the difference between two labels in standard deviations of pure chance.
float EnergyOf(float evidence, float all) { return -evidence / std::sqrt(all + kPriorCount); }

/// Converts evidence to unaries. A label that does not occur within reach of a voxel is impossible there, so that many
/// observations elsewhere in the tile have no effect; a label within reach that the voxel has not seen has no evidence.
void BecomeUnaries(const TileProblem& problem, std::span<float> values) {
  const LabelChannels& channels = problem.channels();
  const auto num_channels = static_cast<std::size_t>(channels.num_channels());
  for (std::size_t m = 0; m < problem.members().size(); ++m) {
    const std::span<float> row = values.subspan(m * num_channels, num_channels);
    const float all = std::accumulate(row.begin(), row.end(), 0.0f);
    for (std::uint32_t c = 0; c < num_channels; ++c) {
      const bool is_near = channels.LabelAt(problem.members()[m].place, c) != LabelChannels::kNone;
      row[c] = is_near ? EnergyOf(row[c], all) : std::numeric_limits<float>::infinity();
    }
  }
}

CrfKernel KernelOf(const CrfKernelConfig& config) {
  return {.position_m = config.position_m, .color = config.color, .weight = config.weight};
}

}  // namespace

ScratchVector<float> TileMarginals(const TileProblem& problem, const MapConfig& map_config) {
  const RefinementConfig& config = map_config.refinement;
  ThreadPool here(1);
  DenseCrf crf(here);
  crf.SetPoints(problem.Points(), KernelOf(config.smoothness), KernelOf(config.appearance));
  ScratchVector<float> values =
      GatherEvidence(problem, config.evidence_radius_m / problem.voxel_size_m(), problem.voxel_size_m());
  BecomeUnaries(problem, values);
  const int num_channels[] = {problem.channels().num_channels()};
  crf.Infer(num_channels, config.crf_iterations, values);
  return values;
}

}  // namespace dhpmap
