// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/watch/change_filter.h"

namespace dhpmap {

bool ChangeFilter::Passes(const SubmapEvent& event) const {
  if (!submaps.empty() && !submaps.contains(event.info.id)) return false;
  if (!kinds.empty() && !kinds.contains(event.kind)) return false;
  if (event.kind == ChangeKind::kChanged && !parts.empty() && !event.parts.HasAnyOf(parts)) return false;
  if (event.before && place.Passes(*event.before)) return true;
  const bool is_gone = event.kind == ChangeKind::kRemoved || event.kind == ChangeKind::kMerged;
  // An object that came and went between two states may have been anywhere: clients that listed it must learn of its
  // removal.
  if (is_gone) return !event.before;
  return place.Passes({event.info.panoptic, event.info.class_id, event.observed});
}

bool ChangeFilter::Passes(const RegionEvent& event) const {
  const bool is_of_objects = !submaps.empty() || !kinds.empty() || !parts.empty() || place.classes || place.panoptic;
  if (is_of_objects) return false;
  if (!place.region) return true;
  const Eigen::AlignedBox3d box(place.region->min_m, place.region->max_m);
  if (const auto* of_event = std::get_if<Eigen::AlignedBox3d>(&event.region)) return box.intersects(*of_event);
  const auto& sphere = std::get<BoundingSphere>(event.region);
  return Touches(box, sphere.center_m, sphere.radius_m);
}

}  // namespace dhpmap
