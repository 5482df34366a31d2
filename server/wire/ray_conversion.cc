// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/ray_conversion.h"

#include <cmath>
#include <string>

#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

constexpr double kLeastDirection = 1e-6;

Status BadRays(const std::string& field, const std::string& what) {
  return InvalidArgument("the rays cannot be cast").WithReason("BAD_POINTS").WithViolation(field, what);
}

Eigen::Vector3d PackedVector(const google::protobuf::RepeatedField<float>& xyz, std::size_t number) {
  const float* v = xyz.data() + 3 * number;
  return {v[0], v[1], v[2]};
}

/// Normalises a direction; false if the ray is invalid.
bool MakeUnit(Ray& ray) {
  const double length = ray.direction.norm();
  if (!ray.origin_m.allFinite() || !(length > kLeastDirection) || !std::isfinite(length)) return false;
  ray.direction /= length;
  return true;
}

v1::QueryStatus::Code StatusOf(const RayHit& hit) {
  if (hit.is_unknown) return v1::QueryStatus::UNKNOWN;
  return hit.submap == nullptr ? v1::QueryStatus::CLAMPED : v1::QueryStatus::OK;
}

bool HasClass(const RayHit& hit) { return hit.submap != nullptr && hit.submap->panoptic != Panoptic::kUnknown; }

v1::RayResult ResultToProto(const RayHit& hit, const MapInfo& map) {
  v1::RayResult result;
  result.set_status(StatusOf(hit));
  result.set_distance_m(static_cast<float>(hit.distance_m));
  result.set_free_distance_m(static_cast<float>(hit.free_m));
  result.set_instance_id(kNobodysId);
  if (hit.submap == nullptr) return result;
  *result.mutable_point_m() = ToProto(hit.point_m);
  *result.mutable_normal() = ToProto(hit.normal);
  result.set_instance_id(hit.submap->id.value);
  result.set_submap(SubmapResourceName(map.name, hit.submap->id));
  if (HasClass(hit)) {
    result.set_class_id(hit.submap->class_id.value);
    if (const LabelClass* c = map.label_set->Find(hit.submap->class_id)) result.set_class_name(c->name);
  }
  return result;
}

void AppendPacked(const RayHit& hit, v1::PackedRayResults& packed) {
  packed.add_distance_m(static_cast<float>(hit.distance_m));
  packed.add_free_distance_m(static_cast<float>(hit.free_m));
  for (int axis = 0; axis < 3; ++axis) {
    packed.add_point_m(static_cast<float>(hit.point_m[axis]));
    packed.add_normal(static_cast<float>(hit.normal[axis]));
  }
  packed.add_instance_id(hit.submap == nullptr ? kNobodysId : std::int64_t{hit.submap->id.value});
  packed.add_class_id(HasClass(hit) ? std::int32_t{hit.submap->class_id.value} : kNoClass);
  packed.add_status(StatusOf(hit));
}

}  // namespace

std::size_t NumRays(const v1::CastRaysRequest& request) {
  return static_cast<std::size_t>(request.packed_directions_size() / 3) + static_cast<std::size_t>(request.rays_size());
}

Result<std::vector<Ray>> RaysFromProto(const v1::CastRaysRequest& request, std::int64_t max_rays) {
  const auto& origins = request.packed_origins_m();
  const auto& directions = request.packed_directions();
  if (directions.size() % 3 != 0) {
    return BadRays("packed_directions", "has " + std::to_string(directions.size()) + " values, not three a ray");
  }
  if (origins.size() != directions.size() && !(origins.size() == 3 && !directions.empty())) {
    return BadRays("packed_origins_m",
                   "has " + std::to_string(origins.size()) + " values, neither three nor three a ray");
  }
  const std::size_t num_packed = static_cast<std::size_t>(directions.size() / 3), num_rays = NumRays(request);
  if (static_cast<std::int64_t>(num_rays) > max_rays) {
    return BadRays("packed_directions", std::to_string(num_rays) + " rays are more than " + std::to_string(max_rays));
  }
  std::vector<Ray> rays;
  rays.reserve(num_rays);
  for (std::size_t i = 0; i < num_packed; ++i) {
    rays.push_back({PackedVector(origins, origins.size() == 3 ? 0 : i), PackedVector(directions, i)});
    if (!MakeUnit(rays.back())) {
      return BadRays("packed_directions", "ray " + std::to_string(i) + " is not finite or has no direction");
    }
  }
  for (int i = 0; i < request.rays_size(); ++i) {
    rays.push_back({VectorFromProto(request.rays(i).origin_m()), VectorFromProto(request.rays(i).direction())});
    if (!MakeUnit(rays.back())) return BadRays("rays[" + std::to_string(i) + "]", "is not finite or has no direction");
  }
  return rays;
}

std::size_t BytesOfAnswers(const v1::CastRaysRequest& request) {
  // Bytes of a ray: 48. Its answer: 48 packed in arrays that may have doubled and up to 54 encoded; else a message with
  // two vectors and two names.
  constexpr std::size_t kPacked = 48 + 2 * 48 + 54, kMessage = 48 + 430 + 210;
  return NumRays(request) * (request.packed() ? kPacked : kMessage);
}

RayAnswers::RayAnswers(const v1::CastRaysRequest& request, const MapInfo& map, v1::CastRaysResponse& response)
    : map_(map), is_packed_(request.packed()), response_(response) {
  response_.set_revision(map.revision);
  if (is_packed_) (void)response_.mutable_packed();
}

void RayAnswers::Append(const RayHit& hit) {
  if (is_packed_) AppendPacked(hit, *response_.mutable_packed());
  else *response_.add_results() = ResultToProto(hit, map_);
}

}  // namespace dhpmap
