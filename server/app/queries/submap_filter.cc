// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/submap_filter.h"

#include <algorithm>

#include "mapping/submap/observed_sphere.h"

namespace dhpmap {
namespace {

bool TouchesRegion(const BoundingSphere& sphere, const SubmapFilter::Box& box) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d nearest = sphere.center_m.cwiseMax(box.min_m).cwiseMin(box.max_m);
  return sphere.Contains(nearest);
}

}  // namespace

bool SubmapFilter::PassesLabels(Panoptic its_panoptic, ClassId its_class) const {
  if (panoptic && its_panoptic != *panoptic) return false;
  if (!classes) return true;
  return its_panoptic != Panoptic::kUnknown && std::find(classes->begin(), classes->end(), its_class) != classes->end();
}

bool SubmapFilter::TouchesAll(const BoundingSphere& sphere) const {
  return (!region || TouchesRegion(sphere, *region)) && (!near || sphere.Intersects(*near));
}

bool SubmapFilter::Passes(const Submap& submap) const {
  if (!PassesLabels(submap.info().panoptic, submap.info().class_id)) return false;
  if (!region && !near) return true;
  return TouchesAll(submap.BoundingSphereInMap()) && TouchesAll(SphereOfObservedInMap(submap));  // the cheap test first
}

bool SubmapFilter::Passes(const SubmapPlace& place) const {
  return PassesLabels(place.panoptic, place.class_id) && TouchesAll(place.sphere);
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
