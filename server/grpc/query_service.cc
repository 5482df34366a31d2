// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "dhpmap/v1/query_service.grpc.pb.h"
#include "server/app/distance_lookup.h"
#include "server/app/point_query.h"
#include "server/app/ray_cast.h"
#include "server/grpc/revision_waits.h"
#include "server/grpc/services.h"
#include "server/wire/distance_conversion.h"
#include "server/wire/point_conversion.h"
#include "server/wire/query_options.h"
#include "server/wire/ray_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

/// More take milliseconds, which are in the way of those who ask for little.
constexpr std::size_t kMostQuickPoints = 2048, kMostQuickDistances = 256;

Status AnswersTooLarge(std::size_t bytes) {
  return InvalidArgument("the points cannot be looked up")
      .WithReason("BAD_POINTS")
      .WithViolation("packed", "the answers would take " + std::to_string(bytes >> 20) +
                                   " MiB, more than there is for all calls: ask for packed ones, or for fewer points");
}

template <typename Request>
std::size_t NumPoints(const Request& request) {
  return static_cast<std::size_t>(request.xyz_m_size() / 3 + request.points_m_size());
}

/// The revision that a query is to wait for; 0: none.
template <typename Request>
std::int64_t MinRevision(const Request& request) {
  if constexpr (requires { request.options().min_revision(); }) return request.options().min_revision();
  else return 0;
}

class QueryService final : public v1::QueryService::CallbackService {
 public:
  explicit QueryService(const ServiceContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* QueryPoints(grpc::CallbackServerContext* call, const v1::QueryPointsRequest* request,
                                        v1::QueryPointsResponse* response) override {
    const auto ask = [=, this](const MapView& view, const Status& fits, const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auto points_m, PointsFromProto(*request, context_.options.max_query_points));
      DHPMAP_RETURN_IF_ERROR(fits);
      PointAnswers answers(*request, view.snapshot().info(), points_m.size(), *response);
      return LookUpPoints(view, points_m, stop, [&answers](const PointInfo& point) { answers.Append(point); });
    };
    return Answer(call, "QueryService/QueryPoints", request, response, NumPoints(*request), kMostQuickPoints, ask);
  }

  grpc::ServerUnaryReactor* QueryDistances(grpc::CallbackServerContext* call, const v1::QueryDistancesRequest* request,
                                           v1::QueryDistancesResponse* response) override {
    const auto ask = [=, this](const MapView& view, const Status& fits, const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auto points_m, PointsFromProto(*request, context_.options.max_query_points));
      DHPMAP_ASSIGN_OR_RETURN(const auto question,
                              QueryOptionsFromProto(request->options(), view.snapshot(), kDistanceOptions));
      DHPMAP_RETURN_IF_ERROR(fits);
      DistanceAnswers answers(*request, view.snapshot().info(), points_m.size(), *response);
      return LookUpDistances(view, context_.registry.surfaces(), question, points_m, stop,
                             [&answers](const SurfaceDistance& distance) { answers.Append(distance); });
    };
    return Answer(call, "QueryService/QueryDistances", request, response, NumPoints(*request), kMostQuickDistances,
                  ask);
  }

  grpc::ServerUnaryReactor* CastRays(grpc::CallbackServerContext* call, const v1::CastRaysRequest* request,
                                     v1::CastRaysResponse* response) override {
    const auto ask = [=, this](const MapView& view, const Status& fits, const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auto rays, RaysFromProto(*request, context_.options.max_query_points));
      DHPMAP_ASSIGN_OR_RETURN(const auto question,
                              QueryOptionsFromProto(request->options(), view.snapshot(), kRayOptions));
      DHPMAP_RETURN_IF_ERROR(fits);
      RayAnswers answers(*request, view.snapshot().info(), *response);
      return dhpmap::CastRays(view, context_.registry.surfaces(), question, rays, stop,
                              [&answers](const RayHit& hit) { answers.Append(hit); });
    };
    return Answer(call, "QueryService/CastRays", request, response, NumRays(*request), kMostQuickDistances, ask);
  }

 private:
  /// A query of `num_items` points or rays, in one of the lanes, by how long it takes. `ask(view, fits, stop)` answers;
  /// it returns `fits`, an error where there is not that much room for answers, once it knows the request to be sound.
  template <typename Request, typename Response, typename Ask>
  grpc::ServerUnaryReactor* Answer(grpc::CallbackServerContext* context, const char* name, const Request* request,
                                   Response* response, std::size_t num_items, std::size_t most_quick, const Ask& ask) {
    const std::size_t answer_bytes = BytesOfAnswers(*request);
    const bool can_fit = answer_bytes <= context_.options.inflight->limit_bytes();
    const auto answer = [=, this](const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
      DHPMAP_RETURN_IF_ERROR(ask(*view, can_fit ? Status::Ok() : AnswersTooLarge(answer_bytes), stop));
      if (context_.observer.on_query) context_.observer.on_query(num_items);
      return Status::Ok();
    };
    const CallMessages call{name, request, response};
    if (const std::int64_t revision = MinRevision(*request); revision > 0) {
      return RunAsync(context_, call, [=, this](const Respond& respond, const std::stop_token& stop) {
        const Result<std::string> map = ParseMapName(request->map(), "map");
        if (!map.ok()) return respond(map.status());
        waits_.Await(*map, revision, context->deadline(), stop, [=, this](const Status& there) {
          if (!there.ok()) return respond(there);
          AnswerInLane(
              num_items <= most_quick, [=] { return answer(stop); }, respond);
        });
      });
    }
    if (num_items <= most_quick) return Run(context_, call, [answer] { return answer({}); });
    return RunBulk(context_, call, can_fit ? answer_bytes : 0, answer);
  }

  /// For calls that have waited, and cannot be given up while they wait once more.
  void AnswerInLane(bool is_quick, const std::function<Status()>& answer, const Respond& respond) {
    const auto task = std::make_shared<LaneTask>([=, this] {
      const Status status = RunGuarded(answer);
      if (is_quick) return respond(status);
      context_.lanes.answers.Post([=] { respond(status); });
    });
    if ((is_quick ? context_.lanes.quick : context_.lanes.bulk).TryPost(task)) return;
    task->GiveUp();
    respond(TooBusy());
  }

  const ServiceContext& context_;
  RevisionWaits waits_{context_};
};

}  // namespace

std::unique_ptr<grpc::Service> MakeQueryService(const ServiceContext& context) {
  return std::make_unique<QueryService>(context);
}

}  // namespace dhpmap
