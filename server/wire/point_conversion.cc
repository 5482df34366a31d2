// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/point_conversion.h"

#include <limits>
#include <string>

#include "proto/types/label_conversion.h"
#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

Status BadPoints(const std::string& field, const std::string& what) {
  return InvalidArgument("the points cannot be looked up").WithReason("BAD_POINTS").WithViolation(field, what);
}

v1::PointResult ResultToProto(const PointInfo& point, const MapInfo& map) {
  v1::PointResult result;
  result.set_free(point.is_free);
  if (!point.is_observed) return result;
  result.set_near_surface(true);
  result.set_instance_id(point.submap.value);
  result.set_submap(SubmapResourceName(map.name, point.submap));
  result.set_kind(ToProto(point.panoptic));
  if (point.panoptic != Panoptic::kUnknown) {
    result.set_class_id(point.class_id.value);
    if (const LabelClass* c = map.label_set->Find(point.class_id)) result.set_class_name(c->name);
  }
  result.set_tsdf_m(point.distance_m);
  result.set_weight(point.weight);
  *result.mutable_color() = ToProto(point.color);
  result.set_class_confidence(point.class_confidence);
  result.set_instance_confidence(point.instance_confidence);
  return result;
}

void Reserve(int num_points, v1::PackedPointResults& packed) {
  packed.mutable_near_surface()->Reserve(num_points);
  packed.mutable_instance_id()->Reserve(num_points);
  packed.mutable_class_id()->Reserve(num_points);
  packed.mutable_tsdf_m()->Reserve(num_points);
  packed.mutable_free()->Reserve(num_points);
  packed.mutable_weight()->Reserve(num_points);
  packed.mutable_class_confidence()->Reserve(num_points);
  packed.mutable_instance_confidence()->Reserve(num_points);
  packed.mutable_rgb()->reserve(3 * static_cast<std::size_t>(num_points));
  packed.mutable_kind()->reserve(static_cast<std::size_t>(num_points));
}

void Append(const PointInfo& found, v1::PackedPointResults& packed) {
  const PointInfo point = found.is_observed ? found : PointInfo{};
  packed.add_near_surface(point.is_observed);
  packed.add_instance_id(point.submap.value);
  packed.add_class_id(point.panoptic == Panoptic::kUnknown ? kNoClass : std::int32_t{point.class_id.value});
  packed.add_tsdf_m(point.is_observed ? point.distance_m : std::numeric_limits<float>::quiet_NaN());
  packed.add_free(found.is_free);
  packed.add_weight(point.weight);
  for (const std::uint8_t channel : {point.color.r, point.color.g, point.color.b}) {
    packed.mutable_rgb()->push_back(static_cast<char>(channel));
  }
  packed.add_class_confidence(point.class_confidence);
  packed.add_instance_confidence(point.instance_confidence);
  packed.mutable_kind()->push_back(static_cast<char>(ToProto(point.panoptic)));
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> PointsFromProto(const google::protobuf::RepeatedField<float>& packed_points_m,
                                                     const google::protobuf::RepeatedPtrField<v1::Vector3>& points_m,
                                                     std::int64_t max_points) {
  if (packed_points_m.size() % 3 != 0) {
    return BadPoints("packed_points_m", "has " + std::to_string(packed_points_m.size()) + " values, not three a point");
  }
  const int num_packed = packed_points_m.size() / 3;
  const std::int64_t num_points = std::int64_t{num_packed} + points_m.size();
  if (num_points > max_points) {
    return BadPoints("packed_points_m",
                     std::to_string(num_points) + " points are more than " + std::to_string(max_points));
  }
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(num_points));
  for (int i = 0; i < num_packed; ++i) {
    const float* xyz = packed_points_m.data() + 3 * std::ptrdiff_t{i};
    points.emplace_back(xyz[0], xyz[1], xyz[2]);
    if (!points.back().allFinite())
      return BadPoints("packed_points_m", "point " + std::to_string(i) + " is not finite");
  }
  for (int i = 0; i < points_m.size(); ++i) {
    points.push_back(VectorFromProto(points_m[i]));
    if (!points.back().allFinite()) return BadPoints("points_m[" + std::to_string(i) + "]", "is not finite");
  }
  return points;
}

std::size_t BytesOfAnswers(const v1::QueryPointsRequest& request) {
  // Bytes of a point: 24 for its position. Its answer: 34 packed and up to 48 encoded; else a name and its own colour.
  constexpr std::size_t kPacked = 24 + 34 + 48, kMessage = 24 + 260 + 100;
  const auto num_points = static_cast<std::size_t>(request.packed_points_m_size() / 3 + request.points_m_size());
  return num_points * (request.packed() ? kPacked : kMessage);
}

PointAnswers::PointAnswers(const v1::QueryPointsRequest& request, const MapInfo& map, std::size_t num_points,
                           v1::QueryPointsResponse& response)
    : map_(map), is_packed_(request.packed()), response_(response) {
  response_.set_revision(map.revision);
  if (is_packed_) Reserve(static_cast<int>(num_points), *response_.mutable_packed());
}

void PointAnswers::Append(const PointInfo& point) {
  if (is_packed_) dhpmap::Append(point, *response_.mutable_packed());
  else *response_.add_results() = ResultToProto(point, map_);
}

}  // namespace dhpmap
