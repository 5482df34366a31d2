// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/submap_filter.h"

#include <algorithm>

#include "mapping/map/observed_sphere.h"

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
  const auto touches_all = [this](const BoundingSphere& sphere) {
    return (!region || Touches(sphere, *region)) && (!near || sphere.Intersects(*near));
  };
  if (!region && !near) return true;
  return touches_all(submap.BoundingSphereInMap()) && touches_all(SphereOfObservedInMap(submap));  // cheap one first
}

std::vector<std::shared_ptr<const Submap>> SelectSubmaps(const MapSnapshot& snapshot, const SubmapFilter& filter,
                                                         std::optional<SubmapId> after, std::size_t max) {
  std::vector<std::shared_ptr<const Submap>> selected;
  for (const auto& submap : snapshot.submaps()) {
    if (selected.size() >= max) break;
    if (after && submap->id() <= *after) continue;
    if (filter.Passes(*submap)) selected.push_back(submap);
  }
  return selected;
}

}  // namespace dhpmap
