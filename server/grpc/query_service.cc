// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <cmath>
#include <string>

#include "dhpmap/v1/query_service.grpc.pb.h"
#include "server/grpc/map_conversion.h"
#include "server/grpc/resource_names.h"
#include "server/grpc/services.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kPointsBetweenCancelChecks = 4096;

/// The points of a request, packed ones first.
class QueryPointList {
 public:
  explicit QueryPointList(const v1::QueryPointsRequest& request)
      : request_(request), num_packed_(request.xyz_m_size() / 3) {}

  [[nodiscard]] std::int64_t size() const { return std::int64_t{num_packed_} + request_.points_m_size(); }
  [[nodiscard]] Eigen::Vector3d operator[](std::int64_t i) const {
    if (i < num_packed_) {
      const float* xyz = request_.xyz_m().data() + 3 * i;
      return {xyz[0], xyz[1], xyz[2]};
    }
    const v1::Vector3& p = request_.points_m(static_cast<int>(i - num_packed_));
    return {p.x(), p.y(), p.z()};
  }

  [[nodiscard]] Status Validate(std::int64_t max_points) const {
    const auto bad = [](const std::string& field, const std::string& what) {
      return InvalidArgument("the points cannot be looked up").WithReason("BAD_POINTS").WithViolation(field, what);
    };
    if (request_.xyz_m_size() % 3 != 0) {
      return bad("xyz_m", "has " + std::to_string(request_.xyz_m_size()) + " values, not three a point");
    }
    if (size() > max_points) {
      return bad("xyz_m", std::to_string(size()) + " points are more than " + std::to_string(max_points));
    }
    for (std::int64_t i = 0; i < size(); ++i) {
      if ((*this)[i].allFinite()) continue;
      return i < num_packed_ ? bad("xyz_m", "point " + std::to_string(i) + " is not finite")
                             : bad("points_m[" + std::to_string(i - num_packed_) + "]", "is not finite");
    }
    return Status::Ok();
  }

 private:
  const v1::QueryPointsRequest& request_;
  int num_packed_;
};

v1::PointResult ToProto(const PointInfo& point, const MapInfo& map) {
  v1::PointResult result;
  if (!point.is_observed) return result;
  result.set_observed(true);
  result.set_instance_id(point.submap.value);
  result.set_submap(SubmapResourceName(map.name, point.submap));
  result.set_kind(ToProto(point.panoptic));
  if (point.panoptic != Panoptic::kUnknown) {
    result.set_class_id(point.class_id.value);
    if (const LabelClass* c = map.label_set->Find(point.class_id)) result.set_class_name(c->name);
  }
  result.set_distance_m(point.distance_m);
  result.set_weight(point.weight);
  *result.mutable_color() = ToProto(point.color);
  result.set_class_confidence(point.class_confidence);
  result.set_instance_confidence(point.instance_confidence);
  return result;
}

void Reserve(int num_points, v1::PackedPointResults& packed) {
  packed.mutable_observed()->Reserve(num_points);
  packed.mutable_instance_id()->Reserve(num_points);
  packed.mutable_class_id()->Reserve(num_points);
  packed.mutable_distance_m()->Reserve(num_points);
  packed.mutable_weight()->Reserve(num_points);
  packed.mutable_class_confidence()->Reserve(num_points);
  packed.mutable_instance_confidence()->Reserve(num_points);
  packed.mutable_rgb()->reserve(3 * static_cast<std::size_t>(num_points));
  packed.mutable_kind()->reserve(static_cast<std::size_t>(num_points));
}

void Append(const PointInfo& found, v1::PackedPointResults& packed) {
  const PointInfo point = found.is_observed ? found : PointInfo{};
  packed.add_observed(point.is_observed);
  packed.add_instance_id(point.submap.value);
  packed.add_class_id(point.panoptic == Panoptic::kUnknown ? 0 : point.class_id.value);
  packed.add_distance_m(point.distance_m);
  packed.add_weight(point.weight);
  for (const std::uint8_t channel : {point.color.r, point.color.g, point.color.b}) {
    packed.mutable_rgb()->push_back(static_cast<char>(channel));
  }
  packed.add_class_confidence(point.class_confidence);
  packed.add_instance_confidence(point.instance_confidence);
  packed.mutable_kind()->push_back(static_cast<char>(ToProto(point.panoptic)));
}

Status Answer(const grpc::CallbackServerContext& call, const v1::QueryPointsRequest& request, const MapView& view,
              std::int64_t max_points, v1::QueryPointsResponse& response) {
  const QueryPointList points(request);
  DHPMAP_RETURN_IF_ERROR(points.Validate(max_points));
  const MapInfo& map = view.snapshot().info();
  response.set_revision(map.revision);
  if (request.packed()) Reserve(static_cast<int>(points.size()), *response.mutable_packed());
  for (std::int64_t i = 0; i < points.size(); ++i) {
    if (i % kPointsBetweenCancelChecks == 0 && call.IsCancelled()) return Cancelled("the client went away");
    const PointInfo point = view.lookup().At(points[i]);
    if (request.packed()) Append(point, *response.mutable_packed());
    else *response.add_results() = ToProto(point, map);
  }
  return Status::Ok();
}

class QueryService final : public v1::QueryService::CallbackService {
 public:
  explicit QueryService(const ServiceContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* QueryPoints(grpc::CallbackServerContext* call, const v1::QueryPointsRequest* request,
                                        v1::QueryPointsResponse* response) override {
    return Run(context_, call, "QueryService/QueryPoints", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const auto session, context_.registry.OpenSession(name));
      const auto view = session->View();
      DHPMAP_RETURN_IF_ERROR(Answer(*call, *request, *view, context_.options.max_query_points, *response));
      const auto num_points = static_cast<std::size_t>(QueryPointList(*request).size());
      if (context_.observer.on_query) context_.observer.on_query(num_points);
      return Status::Ok();
    });
  }

 private:
  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeQueryService(const ServiceContext& context) {
  return std::make_unique<QueryService>(context);
}

}  // namespace dhpmap
