// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/tied_voxels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/refinement/member_grid.h"

namespace dhpmap {
namespace {

constexpr double kOnSurface_vox = 0.01;

constexpr int kNeighbours[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

/// The labels that a member has seen as often as `likeliest`, without it; empty if it has never seen `likeliest`.
void FindTied(const TileProblem& problem, const TileProblem::Member& member, SubmapId likeliest,
              std::vector<SubmapId>& tied) {
  std::uint32_t count_of_likeliest = 0;
  const auto visit = [&](auto&& use) { problem.VisitSeen(member, use); };
  const std::uint32_t channel = problem.channels().ChannelOf(likeliest.value);
  visit([&](std::uint32_t c, std::uint32_t count) {
    if (c == channel) count_of_likeliest = count;
  });
  tied.clear();
  if (count_of_likeliest == 0) return;
  visit([&](std::uint32_t c, std::uint32_t count) {
    if (c == channel || count != count_of_likeliest) return;
    tied.push_back(SubmapId(problem.channels().LabelAt(member.place, c)));
  });
}

/// In front of the surface (1), behind it (-1), or on it (0). Within rounding it counts as on the surface, so that a
/// map that was stored and loaded in between is refined alike.
int SideOf(const TileProblem& problem, const TileProblem::Member& member) {
  const double distance_vox = problem.BlockOf(member).entry->tsdf->distance_m[member.linear] / problem.voxel_size_m();
  return distance_vox > kOnSurface_vox ? 1 : distance_vox < -kOnSurface_vox ? -1 : 0;
}

/// The labels of the neighbours (of six) on the other side of the surface.
struct Across {
  std::array<SubmapId, 6> labels;
  std::size_t num = 0;

  [[nodiscard]] std::ptrdiff_t NumOf(SubmapId label) const {
    return std::count(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(num), label);
  }
};

Across LookAcross(const TileProblem& problem, const MemberGrid& grid, std::size_t m, std::span<const SubmapId> labels) {
  const TileProblem::Member& member = problem.members()[m];
  Across across;
  for (const auto& [dx, dy, dz] : kNeighbours) {
    const std::uint32_t there = grid.At(member.place, member.linear, dx, dy, dz);
    if (there == MemberGrid::kNone) continue;
    if (SideOf(problem, problem.members()[there - 1]) * SideOf(problem, member) >= 0) continue;
    across.labels[across.num++] = labels[there - 1];
  }
  return across;
}

}  // namespace

void KeepTiedWithTheirSurface(const TileProblem& problem, std::span<SubmapId> likeliest) {
  std::optional<MemberGrid> grid;  // most tiles need none
  ScratchVector<std::pair<std::size_t, SubmapId>> kept;
  std::vector<SubmapId> tied;
  for (std::size_t m = 0; m < problem.num_inner(); ++m) {
    FindTied(problem, problem.members()[m], likeliest[m], tied);
    if (tied.empty()) continue;
    if (!grid) grid.emplace(problem);
    const Across across = LookAcross(problem, *grid, m, likeliest);
    if (across.num == 0 || across.NumOf(likeliest[m]) > 0) continue;
    std::sort(tied.begin(), tied.end());
    const auto best = std::max_element(tied.begin(), tied.end(),
                                       [&](SubmapId a, SubmapId b) { return across.NumOf(a) < across.NumOf(b); });
    if (across.NumOf(*best) > 0) kept.emplace_back(m, *best);
  }
  for (const auto& [m, label] : kept) likeliest[m] = label;
}

}  // namespace dhpmap
