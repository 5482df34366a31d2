// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/submap_index.h"

namespace dhpmap {

SubmapIndex::Entry::Entry(const Submap& submap)
    : submap_(&submap),
      T_submap_map_(submap.info().T_map_submap.inverse()),
      is_on_map_axes_(IsIdentity(submap.info().T_map_submap)) {}

SubmapIndex::SubmapIndex(std::span<const std::shared_ptr<const Submap>> submaps) {
  for (const auto& submap : submaps) {
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    if (sphere.IsEmpty()) continue;
    // Rounded outwards: single precision must not lose a voxel at the rim.
    const double radius_m = sphere.radius_m * (1 + 1e-6) + 1e-6 * sphere.center_m.norm() + 1e-6;
    x_m_.push_back(static_cast<float>(sphere.center_m.x()));
    y_m_.push_back(static_cast<float>(sphere.center_m.y()));
    z_m_.push_back(static_cast<float>(sphere.center_m.z()));
    radius2_m2_.push_back(static_cast<float>(radius_m * radius_m));
    entries_.emplace_back(*submap);
  }
}

}  // namespace dhpmap
