// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/object_motion.h"

#include <algorithm>
#include <set>
#include <string>

#include "mapping/query/relations.h"
#include "mapping/submap/submap_outline.h"
#include "mapping/submap/upper_side.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {
namespace {

Status NoSurface(SubmapId id) {
  return FailedPrecondition("submap " + std::to_string(id.value) + " has no surface")
      .WithReason("NO_SURFACE")
      .WithViolation("submap", "has no surface");
}

/// The things whose blocks are at blocks of an object, including the object.
std::vector<SubmapId> ThingsAround(const Submap& object, const MapSnapshot& map) {
  const BoundingSphere of_object = object.BoundingSphereInMap();
  std::vector<SubmapId> around;
  for (const auto& submap : map.submaps()) {
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    const double reach_m = sphere.radius_m + of_object.radius_m + object.info().truncation_m;
    const bool is_near = (sphere.center_m - of_object.center_m).norm() <= reach_m;
    const bool is_thing = submap->info().panoptic == Panoptic::kThing && !submap->IsAbsent();
    if (submap->id() == object.id() || (is_thing && is_near)) around.push_back(submap->id());
  }
  return around;
}

}  // namespace

Result<Transform> TurnOf(const Submap& submap, double angle_rad) {
  const auto outline = OutlineInMap(submap);
  if (!outline) return NoSurface(submap.id());
  const Eigen::Vector3d& middle_m = outline->box.center_m;
  return Transform(Eigen::Translation3d(middle_m) * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()) *
                   Eigen::Translation3d(-middle_m));
}

Result<Transform> PlacingOf(const Submap& submap, const Submap& support,
                            const std::optional<Eigen::Vector2d>& point_m) {
  const auto outline = OutlineInMap(submap);
  if (!outline) return NoSurface(submap.id());
  const auto there_m = point_m ? SurfaceFromAbove(support, *point_m) : MiddleOfUpperSide(support);
  if (!there_m) {
    return FailedPrecondition("submap " + std::to_string(support.id().value) +
                              (point_m ? " has no surface there" : " has no level upper side: name a point on it"))
        .WithReason("NO_SURFACE")
        .WithViolation("place.support", point_m ? "has no surface there" : "has no level upper side");
  }
  Eigen::Vector3d lowest_m = outline->box.center_m;
  lowest_m.z() -= outline->box.size_m.z() / 2;
  return Transform(Eigen::Translation3d(*there_m - lowest_m));
}

std::vector<SubmapId> SupportedBy(SubmapId id, Map& map) {
  constexpr std::size_t kSurface_bytes = std::size_t{256} << 20;
  const auto state = map.Freeze();
  SurfaceCache cache(kSurface_bytes);
  const auto surfaces = cache.Of(state);
  std::set<SubmapId> supported = {id};
  std::vector<SubmapId> to_ask = {id};
  while (!to_ask.empty()) {
    const Submap* object = state->Find(to_ask.back());
    to_ask.pop_back();
    RelationQuestion question{.submap = object->id(), .kinds = {{RelationKind::kOn}}};
    question.scope.submaps = ThingsAround(*object, *state);
    question.most = question.scope.submaps->size();
    for (const Relation& relation : FindRelations(*surfaces, question)) {
      if (relation.object != object) continue;
      if (supported.insert(relation.subject->id()).second) to_ask.push_back(relation.subject->id());
    }
  }
  supported.erase(id);
  return {supported.begin(), supported.end()};
}

}  // namespace dhpmap
