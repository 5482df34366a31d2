// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/refinement_region.h"

namespace dhpmap {

RefinementRegion::RefinementRegion(std::span<const CubeIndex> cubes) : cubes_(cubes.begin(), cubes.end()) {
  for (std::uint32_t n = 0; n < cubes_.size(); ++n) numbers_.Set(cubes_[n], n);
}

bool RefinementRegion::IsNear(BlockIndex block, int rim) const {
  const CubeIndex low = CubeOf({block.x - rim, block.y - rim, block.z - rim});
  const CubeIndex high = CubeOf({block.x + rim, block.y + rim, block.z + rim});
  for (std::int32_t x = low.x; x <= high.x; ++x) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t z = low.z; z <= high.z; ++z) {
        if (Has({x, y, z})) return true;
      }
    }
  }
  return false;
}

}  // namespace dhpmap
