// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/index_map.h"

namespace dhpmap {

/// A cube of 8 x 8 x 8 blocks of the map's grid: one CRF problem. With 12 blocks a side PQ is equal within 0.004, and
/// memory doubles.
inline constexpr int kCubeSideLog2 = 3, kCubeSide = 1 << kCubeSideLog2;
struct CubeIndex {
  std::int32_t x = 0, y = 0, z = 0;
  constexpr auto operator<=>(const CubeIndex&) const = default;
};

constexpr CubeIndex CubeOf(BlockIndex b) { return {b.x >> kCubeSideLog2, b.y >> kCubeSideLog2, b.z >> kCubeSideLog2}; }

/// The cubes of a map that are refined together. Immutable, thread-safe.
class RefinementRegion {
 public:
  explicit RefinementRegion(std::span<const CubeIndex> cubes);

  [[nodiscard]] const std::vector<CubeIndex>& cubes() const { return cubes_; }
  [[nodiscard]] bool Has(CubeIndex cube) const { return numbers_.Find(cube) != IndexMap<CubeIndex>::kNone; }
  /// Whether a block of the region lies within `rim` blocks of `block` along each axis.
  [[nodiscard]] bool IsNear(BlockIndex block, int rim) const;

 private:
  std::vector<CubeIndex> cubes_;
  IndexMap<CubeIndex> numbers_;
};

}  // namespace dhpmap
