// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/submap_filter.h"

#include <algorithm>

namespace dhpmap {
namespace {

bool Touches(const BoundingSphere& sphere, const SubmapFilter::Box& box) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d nearest = sphere.center_m.cwiseMax(box.min_m).cwiseMin(box.max_m);
  return sphere.Contains(nearest);
}

}  // namespace

bool SubmapFilter::Passes(const Submap& submap) const {
  const SubmapInfo& info = submap.info();
  if (panoptic && info.panoptic != *panoptic) return false;
  if (classes && (info.panoptic == Panoptic::kUnknown ||
                  std::find(classes->begin(), classes->end(), info.class_id) == classes->end())) {
    return false;
  }
  const BoundingSphere sphere = submap.BoundingSphereInMap();
  if (region && !Touches(sphere, *region)) return false;
  return !near || sphere.Intersects(*near);
}

std::vector<std::shared_ptr<const Submap>> SelectSubmaps(const MapSnapshot& snapshot, const SubmapFilter& filter) {
  std::vector<std::shared_ptr<const Submap>> selected;
  for (const auto& submap : snapshot.submaps()) {
    if (filter.Passes(*submap)) selected.push_back(submap);
  }
  return selected;
}

}  // namespace dhpmap
