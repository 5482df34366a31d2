// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "dhpmap/v1/query_service.grpc.pb.h"
#include "server/app/distance_lookup.h"
#include "server/app/point_query.h"
#include "server/app/ray_cast.h"
#include "server/grpc/services.h"
#include "server/wire/distance_conversion.h"
#include "server/wire/point_conversion.h"
#include "server/wire/query_options.h"
#include "server/wire/ray_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

/// More take milliseconds, which are in the way of those who ask for little.
constexpr int kMostQuickPoints = 2048, kMostQuickDistances = 256;

Status AnswersTooLarge(std::size_t bytes) {
  return InvalidArgument("the points cannot be looked up")
      .WithReason("BAD_POINTS")
      .WithViolation("packed", "the answers would take " + std::to_string(bytes >> 20) +
                                   " MiB, more than there is for all calls: ask for packed ones, or for fewer points");
}

class QueryService final : public v1::QueryService::CallbackService {
 public:
  explicit QueryService(const ServiceContext& context) : context_(context) {}

  /// In one of the lanes, by how long it takes; refused if there is no room for the answer.
  grpc::ServerUnaryReactor* QueryPoints(grpc::CallbackServerContext*, const v1::QueryPointsRequest* request,
                                        v1::QueryPointsResponse* response) override {
    const std::size_t answer_bytes = BytesOfAnswers(*request);
    const bool can_fit = answer_bytes <= context_.options.inflight->limit_bytes();
    const auto answer = [=, this](const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
      DHPMAP_ASSIGN_OR_RETURN(const auto points_m, PointsFromProto(*request, context_.options.max_query_points));
      if (!can_fit) return AnswersTooLarge(answer_bytes);
      PointAnswers answers(*request, view->snapshot().info(), points_m.size(), *response);
      DHPMAP_RETURN_IF_ERROR(
          LookUpPoints(*view, points_m, stop, [&answers](const PointInfo& point) { answers.Append(point); }));
      if (context_.observer.on_query) context_.observer.on_query(points_m.size());
      return Status::Ok();
    };
    const CallMessages call{"QueryService/QueryPoints", request, response};
    const int num_points = request->xyz_m_size() / 3 + request->points_m_size();
    if (num_points <= kMostQuickPoints) return Run(context_, call, [answer] { return answer({}); });
    return RunBulk(context_, call, can_fit ? answer_bytes : 0, answer);
  }

  /// The same.
  grpc::ServerUnaryReactor* QueryDistances(grpc::CallbackServerContext*, const v1::QueryDistancesRequest* request,
                                           v1::QueryDistancesResponse* response) override {
    const std::size_t answer_bytes = BytesOfAnswers(*request);
    const bool can_fit = answer_bytes <= context_.options.inflight->limit_bytes();
    const auto answer = [=, this](const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
      DHPMAP_ASSIGN_OR_RETURN(const auto points_m, PointsFromProto(*request, context_.options.max_query_points));
      DHPMAP_ASSIGN_OR_RETURN(const auto question, QueryOptionsFromProto(request->options(), view->snapshot()));
      if (!can_fit) return AnswersTooLarge(answer_bytes);
      DistanceAnswers answers(*request, view->snapshot().info(), points_m.size(), *response);
      DHPMAP_RETURN_IF_ERROR(
          LookUpDistances(*view, context_.registry.surfaces(), question, points_m, stop,
                          [&answers](const SurfaceDistance& distance) { answers.Append(distance); }));
      if (context_.observer.on_query) context_.observer.on_query(points_m.size());
      return Status::Ok();
    };
    const CallMessages call{"QueryService/QueryDistances", request, response};
    const int num_points = request->xyz_m_size() / 3 + request->points_m_size();
    if (num_points <= kMostQuickDistances) return Run(context_, call, [answer] { return answer({}); });
    return RunBulk(context_, call, can_fit ? answer_bytes : 0, answer);
  }

  /// The same.
  grpc::ServerUnaryReactor* CastRays(grpc::CallbackServerContext*, const v1::CastRaysRequest* request,
                                     v1::CastRaysResponse* response) override {
    const std::size_t answer_bytes = BytesOfAnswers(*request);
    const bool can_fit = answer_bytes <= context_.options.inflight->limit_bytes();
    const auto answer = [=, this](const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
      DHPMAP_ASSIGN_OR_RETURN(const auto rays, RaysFromProto(*request, context_.options.max_query_points));
      DHPMAP_ASSIGN_OR_RETURN(const auto question, QueryOptionsFromProto(request->options(), view->snapshot()));
      if (!can_fit) return AnswersTooLarge(answer_bytes);
      RayAnswers answers(*request, view->snapshot().info(), *response);
      DHPMAP_RETURN_IF_ERROR(dhpmap::CastRays(*view, context_.registry.surfaces(), question, rays, stop,
                                              [&answers](const RayHit& hit) { answers.Append(hit); }));
      if (context_.observer.on_query) context_.observer.on_query(rays.size());
      return Status::Ok();
    };
    const CallMessages call{"QueryService/CastRays", request, response};
    if (NumRays(*request) <= kMostQuickDistances) return Run(context_, call, [answer] { return answer({}); });
    return RunBulk(context_, call, can_fit ? answer_bytes : 0, answer);
  }

 private:
  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeQueryService(const ServiceContext& context) {
  return std::make_unique<QueryService>(context);
}

}  // namespace dhpmap
