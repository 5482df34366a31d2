// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/distance_conversion.h"

#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

bool HasClass(const SurfaceDistance& answer) {
  return answer.submap != nullptr && answer.submap->panoptic != Panoptic::kUnknown;
}

v1::DistanceResult ResultToProto(const SurfaceDistance& answer, const MapInfo& map) {
  v1::DistanceResult result;
  result.set_status(StatusToProto(answer.status));
  result.set_distance_m(static_cast<float>(answer.distance_m));
  result.set_instance_id(kNobodysId);
  if (answer.submap == nullptr) return result;
  *result.mutable_gradient() = ToProto(answer.gradient);
  *result.mutable_nearest_point_m() = ToProto(answer.nearest_m);
  result.set_instance_id(answer.submap->id.value);
  result.set_submap(SubmapResourceName(map.name, answer.submap->id));
  if (HasClass(answer)) {
    result.set_class_id(answer.submap->class_id.value);
    if (const LabelClass* c = map.label_set->Find(answer.submap->class_id)) result.set_class_name(c->name);
  }
  return result;
}

void Reserve(int num_points, v1::PackedDistanceResults& packed) {
  packed.mutable_distance_m()->Reserve(num_points);
  packed.mutable_gradient()->Reserve(3 * num_points);
  packed.mutable_nearest_point_m()->Reserve(3 * num_points);
  packed.mutable_instance_id()->Reserve(num_points);
  packed.mutable_class_id()->Reserve(num_points);
  packed.mutable_status()->Reserve(num_points);
}

void Append(const SurfaceDistance& answer, v1::PackedDistanceResults& packed) {
  packed.add_distance_m(static_cast<float>(answer.distance_m));
  for (int axis = 0; axis < 3; ++axis) {
    packed.add_gradient(static_cast<float>(answer.gradient[axis]));
    packed.add_nearest_point_m(static_cast<float>(answer.nearest_m[axis]));
  }
  packed.add_instance_id(answer.submap == nullptr ? kNobodysId : std::int64_t{answer.submap->id.value});
  packed.add_class_id(HasClass(answer) ? std::int32_t{answer.submap->class_id.value} : kNoClass);
  packed.add_status(StatusToProto(answer.status));
}

}  // namespace

v1::QueryStatus::Code StatusToProto(DistanceStatus status) {
  switch (status) {
    case DistanceStatus::kOk: return v1::QueryStatus::OK;
    case DistanceStatus::kClamped: return v1::QueryStatus::CLAMPED;
    case DistanceStatus::kUnknown: return v1::QueryStatus::UNKNOWN;
  }
  return v1::QueryStatus::QUERY_STATUS_UNSPECIFIED;
}

std::size_t BytesOfAnswers(const v1::QueryDistancesRequest& request) {
  // Bytes of a point: 24 for its position. Its answer: 44 packed and up to 50 encoded; else two vectors and two names.
  constexpr std::size_t kPacked = 24 + 44 + 50, kMessage = 24 + 420 + 200;
  const auto num_points = static_cast<std::size_t>(request.packed_points_m_size() / 3 + request.points_m_size());
  return num_points * (request.packed() ? kPacked : kMessage);
}

DistanceAnswers::DistanceAnswers(const v1::QueryDistancesRequest& request, const MapInfo& map, std::size_t num_points,
                                 v1::QueryDistancesResponse& response)
    : map_(map), is_packed_(request.packed()), response_(response) {
  response_.set_revision(map.revision);
  if (is_packed_) Reserve(static_cast<int>(num_points), *response_.mutable_packed());
}

void DistanceAnswers::Append(const SurfaceDistance& answer) {
  if (is_packed_) dhpmap::Append(answer, *response_.mutable_packed());
  else *response_.add_results() = ResultToProto(answer, map_);
}

}  // namespace dhpmap
