// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/member_grid.h"

namespace dhpmap {

MemberGrid::MemberGrid(const TileProblem& problem)
    : numbers_(problem.num_places() * kBlockVoxels, kNone), around_(problem.num_places()) {
  for (std::size_t m = 0; m < problem.members().size(); ++m) {
    const TileProblem::Member& member = problem.members()[m];
    numbers_[member.place * std::size_t{kBlockVoxels} + member.linear] = static_cast<std::uint32_t>(m + 1);
  }
  for (std::uint32_t p = 0; p < around_.size(); ++p) {
    std::size_t n = 0;
    VisitBlocksAround(problem.IndexOf(p), 1, [&](BlockIndex index) { around_[p][n++] = problem.PlaceAt(index); });
  }
}

}  // namespace dhpmap
