// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/tsdf_block.h"

#include <algorithm>

namespace dhpmap {

bool TsdfBlock::HasObservedVoxel() const {
  return std::any_of(weight.begin(), weight.end(), [](float w) { return w >= kMinObservedWeight; });
}

int TsdfBlock::NumObservedVoxels() const {
  return static_cast<int>(std::count_if(weight.begin(), weight.end(), [](float w) { return w >= kMinObservedWeight; }));
}

}  // namespace dhpmap
