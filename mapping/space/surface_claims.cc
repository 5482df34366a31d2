// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/surface_claims.h"

#include <cstring>
#include <numeric>

#include "mapping/base/vector_clones.h"

namespace dhpmap {
namespace {

DHPMAP_WIDE_VECTOR_CLONES
void FindClaims(const float* __restrict distance_m, const float* __restrict weight, float most_m,
                std::uint8_t* __restrict claims) {
  for (int i = 0; i < kBlockVoxels; ++i) {
    const float away_m = distance_m[i] < 0 ? -distance_m[i] : distance_m[i];
    const int is_observed = weight[i] >= kMinObservedWeight ? 1 : 0, is_within = away_m < most_m ? 1 : 0;
    claims[i] = static_cast<std::uint8_t>(is_observed & is_within);
  }
}

}  // namespace

void SurfaceClaims::Read(const TsdfBlock& block, float most_m) {
  FindClaims(block.distance_m.data(), block.weight.data(), most_m, all_.data());
}

bool SurfaceClaims::Of(std::size_t octant, std::array<std::uint8_t, kOctantVoxels>& claims) const {
  constexpr std::size_t kSide = kOctantSide;
  const std::size_t first = kSide * ((octant & 1) + kBlockSide * ((octant >> 1 & 1) + kBlockSide * (octant >> 2 & 1)));
  std::uint32_t any = 0;
  for (std::size_t row = 0; row < kSide * kSide; ++row) {
    const std::size_t from = first + kBlockSide * (row % kSide + kBlockSide * (row / kSide));
    std::uint32_t four;
    std::memcpy(&four, all_.data() + from, sizeof(four));
    std::memcpy(claims.data() + kSide * row, &four, sizeof(four));
    any |= four;
  }
  return any != 0;
}

int SurfaceClaims::Count() const { return std::accumulate(all_.begin(), all_.end(), 0); }

}  // namespace dhpmap
