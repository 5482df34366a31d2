// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dhpmap {

/// What a point is told apart by, in kernel widths: divided by the standard deviations; within +-10^6.
template <int D>
using LatticeFeature = std::array<float, D>;

/// Where a point lies in a lattice: the rows of its simplex' corners, counted from the first row of its chunk, and
/// their weights, scale * weight. Weights are whole numbers that add up to kCornerWeightSum but for rounding.
template <int D>
struct LatticeCorners {
  float scale;
  std::array<std::uint16_t, D + 1> weight;
  std::array<std::uint16_t, D + 1> row;
};
inline constexpr float kCornerWeightSum = 65535.0f;

/// Points [c * kLatticeChunkPoints, (c + 1) * kLatticeChunkPoints) of a lattice are chunk c.
inline constexpr std::size_t kLatticeChunkPoints = 4096;

}  // namespace dhpmap
