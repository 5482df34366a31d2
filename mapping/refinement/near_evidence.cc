// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/near_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mapping/refinement/member_grid.h"

namespace dhpmap {
namespace {

/// Borders of masks and grazing rays label voxels far before and behind the surface, more often wrongly than not.
constexpr float kAtSurface_vox = 1.5f;

}  // namespace

std::vector<NearTap> NearTaps(double radius_vox) {
  std::vector<NearTap> taps;
  const double radius = std::min(radius_vox, double{kBlockSide});
  const int reach = std::max(0, static_cast<int>(std::ceil(radius)) - 1);
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double d = std::sqrt(x * x + y * y + z * z) / radius;
        if (!(d > 0 && d < 1)) continue;
        const double angle = 2 * std::numbers::pi * d;
        const double weight = (2 + std::cos(angle)) / 3 * (1 - d) + std::sin(angle) / (2 * std::numbers::pi);
        taps.push_back({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z),
                        static_cast<float>(weight)});
      }
    }
  }
  return taps;
}

ScratchVector<float> GatherEvidence(const TileProblem& problem, double radius_vox, double voxel_size_m) {
  const auto num_channels = static_cast<std::size_t>(problem.channels().num_channels());
  ScratchVector<float> evidence(problem.members().size() * num_channels, 0.0f);
  for (std::size_t m = 0; m < problem.members().size(); ++m) {
    problem.VisitSeen(problem.members()[m], [&](std::uint32_t channel, std::uint32_t count) {
      evidence[m * num_channels + channel] = static_cast<float>(count);
    });
  }
  const std::vector<NearTap> taps = NearTaps(radius_vox);
  if (taps.empty()) return evidence;
  const MemberGrid grid(problem);
  const float most_m = kAtSurface_vox * static_cast<float>(voxel_size_m);
  std::vector<std::pair<std::uint32_t, float>> seen;
  for (const TileProblem::Member& member : problem.members()) {
    if (std::abs(problem.BlockOf(member).entry->tsdf->distance_m[member.linear]) > most_m) continue;
    seen.clear();
    problem.VisitSeen(member, [&](std::uint32_t channel, std::uint32_t count) {
      seen.emplace_back(channel, kNearWeight * static_cast<float>(count));
    });
    for (const NearTap& tap : taps) {
      const std::uint32_t to = grid.At(member.place, member.linear, tap.x, tap.y, tap.z);
      if (to == MemberGrid::kNone) continue;
      float* row = evidence.data() + (to - 1) * num_channels;
      for (const auto& [channel, count] : seen) row[channel] += tap.weight * count;
    }
  }
  return evidence;
}

}  // namespace dhpmap
