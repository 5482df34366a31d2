// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/body_query.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mapping/geometry/body_triangle.h"
#include "mapping/query/near_triangles.h"
#include "mapping/query/unseen_voxels.h"

namespace dhpmap {
namespace {

/// Work of a search for the nearest surface.
constexpr std::int64_t kSearchWork = 64;

BodyContact ContactOf(const SurfaceDistance& distance, double radius_m) {
  return {distance.submap, radius_m - distance.distance_m, distance.nearest_m, distance.gradient};
}

}  // namespace

BodyQuery::BodyQuery(std::shared_ptr<const MapSurfaces> surfaces, BodyOptions options)
    : options_(std::move(options)),
      world_(surfaces, options_.scope),
      distances_(std::move(surfaces), {.max_distance_m = options_.max_distance_m, .scope = options_.scope}) {}

BodyAnswer BodyQuery::Test(const Body& body, WorkBudget* work) const {
  return std::visit([&](const auto& shape) { return TestShape(shape, work); }, body);
}

BodyAnswer BodyQuery::Check(const Body& body, std::size_t max_contacts, WorkBudget* work) const {
  return std::visit([&](const auto& shape) { return CheckShape(shape, max_contacts, work); }, body);
}

template <typename Shape>
BodyAnswer BodyQuery::TestShape(const Shape& body, WorkBudget* work) const {
  (void)SpendOf(work, kSearchWork);
  BodyAnswer answer{.is_colliding = TouchesAny(body, work) || InsideOf(CentreOf(body))};
  if (!answer.is_colliding) AddUnseen(body, answer, work);
  answer.contacts.clear();
  return answer;
}

bool BodyQuery::TouchesAny(const Capsule& capsule, WorkBudget* work) const {
  if (capsule.a_m != capsule.b_m) return TouchesTriangle(capsule, work);
  return distances_.AnyCloserThan(capsule.a_m, capsule.radius_m);
}

bool BodyQuery::TouchesAny(const OrientedBox& box, WorkBudget* work) const { return TouchesTriangle(box, work); }

template <typename Shape>
bool BodyQuery::TouchesTriangle(const Shape& body, WorkBudget* work) const {
  bool touches = false;
  const auto visit = [&](const NearTriangle<Shape>& near) {
    touches = TouchOf(near.body, near.triangle, near.padding_m).has_value();
    return !touches;
  };
  VisitNear(world_, body, visit, work);
  return touches;
}

template <typename Shape>
BodyAnswer BodyQuery::CheckShape(const Shape& body, std::size_t max_contacts, WorkBudget* work) const {
  (void)SpendOf(work, kSearchWork);
  BodyAnswer answer{.contacts = Contacts(body, max_contacts, work)};
  if (answer.contacts.empty()) {
    if (const auto inside = InsideOf(CentreOf(body))) answer.contacts.push_back(ContactOf(*inside, 0));
  }
  answer.is_colliding = !answer.contacts.empty();
  if (!answer.is_colliding) AddUnseen(body, answer, work);
  return answer;
}

std::vector<BodyContact> BodyQuery::Contacts(const Capsule& capsule, std::size_t max_contacts, WorkBudget* work) const {
  if (capsule.a_m != capsule.b_m) return TriangleContacts(capsule, max_contacts, work);
  // A sphere: use distances, which give the exact side. Then search for the nearest object without those found before.
  std::vector<BodyContact> contacts;
  const SurfaceDistance nearest = distances_.Within(capsule.a_m, capsule.radius_m);
  if (nearest.submap == nullptr) return contacts;
  contacts.push_back(ContactOf(nearest, capsule.radius_m));
  DistanceOptions others{.max_distance_m = capsule.radius_m, .scope = options_.scope};
  while (contacts.size() < max_contacts && SpendOf(work, kSearchWork)) {
    others.scope.may_touch.push_back(contacts.back().submap->id);
    const SurfaceDistance next = DistanceQuery(world_.shared_surfaces(), others).At(capsule.a_m);
    if (next.submap == nullptr) break;
    contacts.push_back(ContactOf(next, capsule.radius_m));
  }
  return contacts;
}

std::vector<BodyContact> BodyQuery::Contacts(const OrientedBox& box, std::size_t max_contacts, WorkBudget* work) const {
  return TriangleContacts(box, max_contacts, work);
}

template <typename Shape>
std::vector<BodyContact> BodyQuery::TriangleContacts(const Shape& body, std::size_t max_contacts,
                                                     WorkBudget* work) const {
  struct Deepest {
    BodyTouch touch;
    BodyContact contact;
  };
  std::map<std::size_t, Deepest> by_submap;
  const auto visit = [&](const NearTriangle<Shape>& near) {
    const auto touch = TouchOf(near.body, near.triangle, near.padding_m);
    if (!touch) return true;
    const auto [known, is_new] = by_submap.try_emplace(near.number);
    if (!is_new && !touch->TellsMoreThan(known->second.touch)) return true;
    known->second = {*touch,
                     {&world_.surfaces().index().entries()[near.number].submap().info(), touch->depth_m,
                      near.InMap(touch->point), near.TurnedToMap(touch->normal)}};
    return true;
  };
  VisitNear(world_, body, visit, work);
  std::vector<BodyContact> contacts;
  for (const auto& [number, deepest] : by_submap) contacts.push_back(deepest.contact);
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const BodyContact& a, const BodyContact& b) { return a.depth_m > b.depth_m; });
  if (contacts.size() > max_contacts) contacts.resize(max_contacts);
  return contacts;
}

std::optional<SurfaceDistance> BodyQuery::InsideOf(const Eigen::Vector3d& p_map) const {
  // A point observed in front of a surface can be behind another one only within the band.
  const double band_m = world_.surfaces().state().info().config.truncation_m;
  const SurfaceDistance near = distances_.Within(p_map, band_m);
  if (near.submap != nullptr) return near.distance_m < 0 ? std::optional(near) : std::nullopt;
  if (world_.IsInReach(p_map) && world_.SightAt(p_map, {}).is_front) return std::nullopt;
  const SurfaceDistance far = distances_.At(p_map);
  return far.submap != nullptr && far.distance_m < 0 ? std::optional(far) : std::nullopt;
}

template <typename Shape>
void BodyQuery::AddUnseen(const Shape& body, BodyAnswer& answer, WorkBudget* work) const {
  if (options_.unknown == UnknownSpace::kFree) return;
  const auto visit = [&](VoxelIndex voxel) {
    if (IsAllowed(world_, voxel, options_.max_distance_m, work)) return true;
    answer.is_unknown = true;
    answer.contacts.push_back({.point_m = VoxelCentre(voxel, world_.voxel_size_m())});
    return false;
  };
  VisitUnseen(world_, body, visit, work);
  answer.is_colliding = answer.is_unknown && options_.unknown == UnknownSpace::kOccupied;
}

}  // namespace dhpmap
