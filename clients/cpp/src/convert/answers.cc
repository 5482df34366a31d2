// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/answers.h"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/src/convert/geometry.h"

namespace dhpmap::client {
namespace {

/// OK if each column has `count` rows. `sizes`: pairs of a column's size and its numbers per row.
Status CheckRows(std::size_t count, std::initializer_list<std::pair<std::size_t, std::size_t>> sizes) {
  for (const auto& [size, per_row] : sizes) {
    if (size != count * per_row) {
      return Error(StatusCode::kInternal, "a column of the answer has " + std::to_string(size) + " numbers for " +
                                              std::to_string(count) + " questions");
    }
  }
  return {};
}

std::size_t Size(const auto& column) { return static_cast<std::size_t>(column.size()); }

Vector3 VectorAt(const Floats& column, int row) { return {column[3 * row], column[3 * row + 1], column[3 * row + 2]}; }

void PackVector(const Vector3& v, Floats& packed) {
  for (const double value : {v.x, v.y, v.z}) packed.AddAlreadyReserved(static_cast<float>(value));
}

Contact ContactOf(const v1::Contact& contact) {
  return {{contact.instance_id(), contact.class_name()},
          contact.depth_m(),
          FromProto(contact.point_m()),
          FromProto(contact.normal())};
}

PathContact PathContactOf(const v1::TrajectoryContact& its) {
  PathContact contact{{its.waypoint(), its.fraction(), its.sphere()}, {}, ContactOf(its.contact())};
  if (!its.attached().empty()) contact.attached = Ref{IdOfName(its.attached()), {}};
  return contact;
}

}  // namespace

void Pack(std::span<const Vector3> points, Floats& packed) {
  packed.Reserve(static_cast<int>(3 * points.size()));
  for (const Vector3& point : points) PackVector(point, packed);
}

void Pack(std::span<const Sphere> spheres_m, Floats& packed) {
  packed.Reserve(static_cast<int>(4 * spheres_m.size()));
  for (const Sphere& sphere : spheres_m) {
    PackVector(sphere.center_m, packed);
    packed.AddAlreadyReserved(static_cast<float>(sphere.radius_m));
  }
}

Status Append(const v1::PackedDistanceResults& packed, std::size_t count, std::vector<Distance>& out) {
  Status status = CheckRows(count, {{Size(packed.distance_m()), 1},
                                    {Size(packed.gradient()), 3},
                                    {Size(packed.nearest_point_m()), 3},
                                    {Size(packed.instance_id()), 1},
                                    {Size(packed.class_id()), 1},
                                    {Size(packed.status()), 1}});
  for (int i = 0; status.ok() && i < static_cast<int>(count); ++i) {
    out.push_back({packed.status(i) != v1::QueryStatus::UNKNOWN, packed.status(i) == v1::QueryStatus::CLAMPED,
                   packed.distance_m(i), VectorAt(packed.gradient(), i), VectorAt(packed.nearest_point_m(), i),
                   packed.instance_id(i), packed.class_id(i)});
  }
  return status;
}

Status Append(const v1::PackedPointResults& packed, std::size_t count, std::vector<PointState>& out) {
  Status status = CheckRows(count, {{Size(packed.near_surface()), 1},
                                    {Size(packed.free()), 1},
                                    {Size(packed.instance_id()), 1},
                                    {Size(packed.class_id()), 1},
                                    {Size(packed.tsdf_m()), 1},
                                    {Size(packed.weight()), 1},
                                    {packed.rgb().size(), 3},
                                    {Size(packed.class_confidence()), 1},
                                    {Size(packed.instance_confidence()), 1}});
  for (int i = 0; status.ok() && i < static_cast<int>(count); ++i) {
    PointState its{packed.near_surface(i),
                   packed.free(i),
                   packed.instance_id(i),
                   packed.class_id(i),
                   packed.tsdf_m(i),
                   packed.weight(i),
                   {},
                   packed.class_confidence(i),
                   packed.instance_confidence(i)};
    std::copy_n(packed.rgb().begin() + std::ptrdiff_t{3} * i, 3, its.rgb.begin());
    out.push_back(its);
  }
  return status;
}

Status Append(const v1::PackedRayResults& packed, std::size_t count, std::vector<RayHit>& out) {
  Status status = CheckRows(count, {{Size(packed.distance_m()), 1},
                                    {Size(packed.free_distance_m()), 1},
                                    {Size(packed.point_m()), 3},
                                    {Size(packed.normal()), 3},
                                    {Size(packed.instance_id()), 1},
                                    {Size(packed.class_id()), 1},
                                    {Size(packed.status()), 1}});
  for (int i = 0; status.ok() && i < static_cast<int>(count); ++i) {
    out.push_back({packed.instance_id(i) >= 0, packed.status(i) != v1::QueryStatus::UNKNOWN, packed.distance_m(i),
                   packed.free_distance_m(i), VectorAt(packed.point_m(), i), VectorAt(packed.normal(), i),
                   packed.instance_id(i), packed.class_id(i)});
  }
  return status;
}

Status Append(const v1::PackedCollisionResults& packed, std::size_t count, std::vector<Collision>& out) {
  Status status = CheckRows(count, {{Size(packed.colliding()), 1},
                                    {Size(packed.depth_m()), 1},
                                    {Size(packed.point_m()), 3},
                                    {Size(packed.normal()), 3},
                                    {Size(packed.instance_id()), 1},
                                    {Size(packed.class_id()), 1},
                                    {Size(packed.status()), 1}});
  for (int i = 0; status.ok() && i < static_cast<int>(count); ++i) {
    out.push_back({packed.colliding(i), packed.status(i) != v1::QueryStatus::UNKNOWN, packed.depth_m(i),
                   VectorAt(packed.point_m(), i), VectorAt(packed.normal(), i), packed.instance_id(i),
                   packed.class_id(i)});
  }
  return status;
}

BodyCheck FromProto(const v1::CollisionResult& result) {
  BodyCheck check{result.colliding(), result.status() != v1::QueryStatus::UNKNOWN, {}};
  for (const v1::Contact& contact : result.contacts()) check.contacts.push_back(ContactOf(contact));
  return check;
}

PathCheck FromProto(const v1::TrajectoryResult& result) {
  PathCheck check{result.valid(), result.status() != v1::QueryStatus::UNKNOWN, {}, {}};
  for (const v1::TrajectoryContact& contact : result.contacts()) check.contacts.push_back(PathContactOf(contact));
  if (result.has_clearance()) {
    const v1::Clearance& its = result.clearance();
    check.clearance = Clearance{its.distance_m(),
                                {its.waypoint(), its.fraction(), its.sphere()},
                                {its.instance_id(), its.class_name()},
                                FromProto(its.point_m())};
  }
  return check;
}

}  // namespace dhpmap::client
