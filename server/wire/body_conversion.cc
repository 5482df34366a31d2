// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/body_conversion.h"

#include <algorithm>
#include <limits>
#include <string>

#include "proto/types/pose_conversion.h"
#include "server/wire/contact_conversion.h"

namespace dhpmap {
namespace {

Status BadBodies(const std::string& field, const std::string& what) {
  return InvalidArgument("the bodies cannot be checked").WithReason("BAD_POINTS").WithViolation(field, what);
}

constexpr char kBadSphere[] = "is not finite, or of a radius that is not from 0 to 10";

Result<Body> BodyFromProto(const v1::Body& proto, const std::string& field) {
  switch (proto.shape_case()) {
    case v1::Body::kSphere: {
      const Eigen::Vector3d center_m = VectorFromProto(proto.sphere().center_m());
      if (!IsUsableSphere(center_m, proto.sphere().radius_m())) return BadBodies(field + ".sphere", kBadSphere);
      return Body(Capsule{center_m, center_m, proto.sphere().radius_m()});
    }
    case v1::Body::kCapsule: {
      const v1::Capsule& c = proto.capsule();
      const Eigen::Vector3d a_m = VectorFromProto(c.a_m()), b_m = VectorFromProto(c.b_m());
      if (!IsUsableSphere(a_m, c.radius_m()) || !IsUsableSphere(b_m, c.radius_m())) {
        return BadBodies(field + ".capsule", kBadSphere);
      }
      if ((b_m - a_m).norm() > kMostBody_m) return BadBodies(field + ".capsule", "is longer than 10 m");
      return Body(Capsule{a_m, b_m, c.radius_m()});
    }
    case v1::Body::kBox: {
      const Eigen::Vector3d size_m = VectorFromProto(proto.box().size_m());
      if (!(size_m.minCoeff() >= 0 && size_m.maxCoeff() <= kMostBody_m) || size_m.hasNaN()) {
        return BadBodies(field + ".box.size_m", "is not from 0 to 10 along each axis");
      }
      DHPMAP_ASSIGN_OR_RETURN(const Transform pose, TransformFromProto(proto.box().pose(), field + ".box.pose"));
      if (!IsUsableSphere(pose.translation(), 0)) return BadBodies(field + ".box.pose", "is beyond 1,000 km");
      return Body(OrientedBox{pose, 0.5 * size_m});
    }
    case v1::Body::SHAPE_NOT_SET: break;
  }
  return BadBodies(field, "has no shape");
}

}  // namespace

std::size_t NumBodies(const v1::CheckCollisionsRequest& request) {
  return static_cast<std::size_t>(request.packed_spheres_m_size() / 4) +
         static_cast<std::size_t>(request.bodies_size());
}

RequestedLinks LinksOf(const v1::CheckCollisionsRequest& request) {
  return {request.body_links(), "body_links", NumBodies(request)};
}

Result<std::vector<Body>> BodiesFromProto(const v1::CheckCollisionsRequest& request, std::int64_t max_bodies) {
  if (request.packed_spheres_m_size() % 4 != 0) {
    return BadBodies("packed_spheres_m",
                     "has " + std::to_string(request.packed_spheres_m_size()) + " values, not four a sphere");
  }
  const std::size_t num_bodies = NumBodies(request);
  if (static_cast<std::int64_t>(num_bodies) > max_bodies) {
    return BadBodies("packed_spheres_m",
                     std::to_string(num_bodies) + " bodies are more than " + std::to_string(max_bodies));
  }
  std::vector<Body> bodies;
  bodies.reserve(num_bodies);
  for (int i = 0; i + 4 <= request.packed_spheres_m_size(); i += 4) {
    const float* s = request.packed_spheres_m().data() + i;
    const Eigen::Vector3d center_m(s[0], s[1], s[2]);
    if (!IsUsableSphere(center_m, s[3])) {
      return BadBodies("packed_spheres_m", "sphere " + std::to_string(i / 4) + " " + kBadSphere);
    }
    bodies.emplace_back(Capsule{center_m, center_m, s[3]});
  }
  for (int i = 0; i < request.bodies_size(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const Body body, BodyFromProto(request.bodies(i), "bodies[" + std::to_string(i) + "]"));
    bodies.push_back(body);
  }
  return bodies;
}

Result<std::size_t> MaxContactsFromProto(const v1::CheckCollisionsRequest& request) {
  DHPMAP_ASSIGN_OR_RETURN(const std::size_t max_contacts,
                          MaxContactsFromProto(request.all_contacts(), request.max_contacts(), request.packed()));
  if (!request.skip_contacts()) return max_contacts;
  if (request.all_contacts()) return BadBodies("all_contacts", "contradicts skip_contacts");
  return std::size_t{0};
}

std::size_t BytesOfAnswers(const v1::CheckCollisionsRequest& request) {
  // Bytes of a body: 144 in memory. Its answer: packed, 38 in arrays that may have doubled and up to 52 encoded; else a
  // message and its encoding, with contacts of two vectors and two names.
  constexpr std::size_t kBody = 144, kPacked = 2 * 38 + 52, kMessage = 100, kContact = 620;
  const std::size_t num_bodies = NumBodies(request);
  if (request.packed()) return num_bodies * (kBody + kPacked);
  const int asked = request.max_contacts() > 0 ? std::min(request.max_contacts(), kMostContacts) : kDefaultContacts;
  const int contacts = request.skip_contacts() ? 0 : request.all_contacts() ? asked : 1;
  return num_bodies * (kBody + kMessage + kContact * static_cast<std::size_t>(contacts));
}

CollisionAnswers::CollisionAnswers(const v1::CheckCollisionsRequest& request, const MapInfo& map,
                                   v1::CheckCollisionsResponse& response)
    : request_(request), map_(map), response_(response) {
  response_.set_revision(map.revision);
  if (request.packed()) (void)response_.mutable_packed();
}

void CollisionAnswers::Append(const BodyAnswer& answer) {
  if (request_.packed()) return AppendPacked(answer);
  v1::CollisionResult& result = *response_.add_results();
  result.set_status(answer.is_unknown ? v1::QueryStatus::UNKNOWN : v1::QueryStatus::OK);
  result.set_colliding(answer.is_colliding);
  for (const BodyContact& contact : answer.contacts) *result.add_contacts() = ToProto(contact, map_);
}

void CollisionAnswers::AppendPacked(const BodyAnswer& answer) {
  v1::PackedCollisionResults& packed = *response_.mutable_packed();
  packed.add_status(answer.is_unknown ? v1::QueryStatus::UNKNOWN : v1::QueryStatus::OK);
  packed.add_colliding(answer.is_colliding);
  if (request_.skip_contacts()) return;
  BodyContact none;
  none.point_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  const BodyContact& contact = answer.contacts.empty() ? none : answer.contacts.front();
  packed.add_depth_m(static_cast<float>(contact.depth_m));
  for (int axis = 0; axis < 3; ++axis) {
    packed.add_point_m(static_cast<float>(contact.point_m[axis]));
    packed.add_normal(static_cast<float>(contact.normal[axis]));
  }
  packed.add_instance_id(InstanceOf(contact));
  packed.add_class_id(ClassOf(contact));
}

}  // namespace dhpmap
