// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "dhpmap/v1/query_service.grpc.pb.h"
#include "proto/types/resource_names.h"
#include "server/app/queries/distance_grid.h"
#include "server/grpc/answered_anywhere.h"
#include "server/grpc/check_answer.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/passing_time.h"
#include "server/grpc/query_answers.h"
#include "server/grpc/query_stream.h"
#include "server/grpc/read_view.h"
#include "server/grpc/revision_waits.h"
#include "server/grpc/services.h"
#include "server/wire/grid_conversion.h"

namespace dhpmap {
namespace {

class QueryService final : public CountedService<v1::QueryService> {
 public:
  QueryService(const ServiceContext& context, OpenStreams& streams)
      : CountedService(context), context_(context), streams_(streams) {
    Take(&QueryService::QueryPoints, &QueryService::QueryDistances, &QueryService::CastRays,
         &QueryService::CheckCollisions, &QueryService::CheckTrajectory, &QueryService::QueryOccupancySlice,
         &QueryService::QueryDistanceGrid, &QueryService::SearchSubmaps, &QueryService::QueryRelations);
    TakeStream<v1::StreamQueriesRequest>(&QueryService::BeginStream);
  }

  using Reactor = grpc::ServerUnaryReactor;

  Reactor* QueryPoints(Context* call, const v1::QueryPointsRequest* request,
                       v1::QueryPointsResponse* response) override {
    return Answer(call, "QueryService/QueryPoints", request, response);
  }
  Reactor* QueryDistances(Context* call, const v1::QueryDistancesRequest* request,
                          v1::QueryDistancesResponse* response) override {
    return Answer(call, "QueryService/QueryDistances", request, response);
  }
  Reactor* CastRays(Context* call, const v1::CastRaysRequest* request, v1::CastRaysResponse* response) override {
    return Answer(call, "QueryService/CastRays", request, response);
  }
  Reactor* QueryOccupancySlice(Context* call, const v1::QueryOccupancySliceRequest* request,
                               v1::QueryOccupancySliceResponse* response) override {
    return Answer(call, "QueryService/QueryOccupancySlice", request, response);
  }
  Reactor* SearchSubmaps(Context* call, const v1::SearchSubmapsRequest* request,
                         v1::SearchSubmapsResponse* response) override {
    return Answer(call, "QueryService/SearchSubmaps", request, response);
  }
  Reactor* QueryRelations(Context* call, const v1::QueryRelationsRequest* request,
                          v1::QueryRelationsResponse* response) override {
    return Answer(call, "QueryService/QueryRelations", request, response);
  }

  grpc::ServerWriteReactor<v1::QueryDistanceGridResponse>* QueryDistanceGrid(
      Context* call, const v1::QueryDistanceGridRequest* request) override {
    using Stream = ChunkStream<v1::QueryDistanceGridResponse>;
    return Stream::Start(
        context_, call, {"QueryService/QueryDistanceGrid", request},
        [=, this](const std::stop_token& stop, const StreamKeeps& keeps) -> Result<Stream::Next> {
          DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
          DHPMAP_ASSIGN_OR_RETURN(auto view, ViewFor(context_, map, *request));
          DHPMAP_ASSIGN_OR_RETURN(const GridQuestion question, GridQuestionFromProto(*request, view->snapshot()));
          DHPMAP_RETURN_IF_ERROR(keeps.hold(view->shared_snapshot()));
          DistanceGrid grid(std::move(view), context_.registry.surfaces(), question);
          return Stream::Next([chunks = std::make_shared<GridChunks>(std::move(grid), *request),
                               stop](v1::QueryDistanceGridResponse& message) { return chunks->Next(message, stop); });
        });
  }

  grpc::ServerBidiReactor<grpc::ByteBuffer, v1::StreamQueriesResponse>* BeginStream(Context* call) {
    return dhpmap::QueryStream::Start(context_, CallerOf(*call), streams_);
  }

  Reactor* CheckCollisions(Context* call, const v1::CheckCollisionsRequest* request,
                           v1::CheckCollisionsResponse* response) override {
    return AnswerCheck(call, "QueryService/CheckCollisions", request, response);
  }
  Reactor* CheckTrajectory(Context* call, const v1::CheckTrajectoryRequest* request,
                           v1::CheckTrajectoryResponse* response) override {
    return AnswerCheck(call, "QueryService/CheckTrajectory", request, response);
  }

 private:
  /// Answers a query on the lane that fits its cost, once the map has reached the requested revision.
  template <typename Request, typename Response>
  Reactor* Answer(Context* context, const char* name, const Request* request, Response* response) {
    const QueryEffort effort = EffortOf(*request);
    const bool can_fit = effort.answer_bytes <= BudgetHere(*context_.options.inflight).limit_bytes();
    const auto answer = [=, this](const std::stop_token& stop) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, *request));
      if (effort.is_quick) return AnswerFromMap(context_, view, *request, *response, stop);
      return WhileThereIsRoom(context_, view->shared_snapshot(), stop, [&](const std::stop_token& ended) {
        return AnswerFromMap(context_, view, *request, *response, ended);
      });
    };
    const CallMessages call{name, request, response, request->map()};
    if (Waits(*request)) {
      return AnswerOnceThere(context, call, *request, [=, this](const Respond& respond, const std::stop_token& stop) {
        Lane& lane = effort.is_quick ? context_.lanes.quick : context_.lanes.bulk;
        PostOrRefuse(lane, respond, [=, this] {
          const Status status = RunGuarded([&] { return answer(stop); });
          if (effort.is_quick) return respond(status);
          context_.lanes.answers.Post([=] { respond(status); });
        });
      });
    }
    if (effort.is_quick) return Run(context_, call, [answer] { return answer({}); });
    return RunBulk(context_, call, can_fit ? effort.answer_bytes : 0, answer);
  }

  /// The same for a query that is answered in pieces.
  template <typename Request, typename Response>
  Reactor* AnswerCheck(Context* context, const char* name, const Request* request, Response* response) {
    const QueryEffort effort = EffortOf(*request);
    const bool can_fit = effort.answer_bytes <= BudgetHere(*context_.options.inflight).limit_bytes();
    const CheckBegins begins = effort.is_quick ? CheckBegins::kQuickly : CheckBegins::kInLane;
    const auto answer = [=, this](const Respond& respond, const std::stop_token& stop) {
      const Status begun = RunGuarded([&]() -> Status {
        DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
        DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, *request));
        DHPMAP_ASSIGN_OR_RETURN(auto check, CheckAnswer::Begin(context_, view, *request, *response));
        AnswerInPieces(context_, std::move(check), view->shared_snapshot(), begins, stop,
                       [=, this](const Status& status) {
                         if (status.ok() && context_.observer.on_query) context_.observer.on_query(effort.num_items);
                         respond(status);
                       });
        return Status::Ok();
      });
      if (begun.ok()) return;
      if (effort.is_quick) return respond(begun);
      context_.lanes.answers.Post([=] { respond(begun); });
    };
    const CallMessages call{name, request, response, request->map()};
    if (Waits(*request)) {
      return AnswerOnceThere(context, call, *request, [=, this](const Respond& respond, const std::stop_token& stop) {
        Lane& lane = effort.is_quick ? context_.lanes.quick : context_.lanes.checks;
        PostOrRefuse(lane, respond, [=] { answer(respond, stop); });
      });
    }
    if (effort.is_quick) return RunAsync(context_, call, answer);
    return RunAsyncIn(context_.lanes.checks, context_, call, can_fit ? effort.answer_bytes : 0, answer);
  }

  template <typename Request>
  static bool Waits(const Request& request) {
    const std::int64_t revision = MinRevision(request);
    return revision > 0 && CheckReadRevision(request.read_revision(), revision).ok();
  }

  /// Calls answer() on the quick lane once the map has reached the requested revision.
  template <typename Request, typename Answer>
  Reactor* AnswerOnceThere(Context* context, const CallMessages& call, const Request& request, Answer answer) {
    return RunAsync(context_, call, [=, this, &request](const Respond& respond, const std::stop_token& stop) {
      const Result<std::string> map = ParseMapName(request.map(), "map");
      if (!map.ok()) return respond(map.status());
      waits_.Await({*map, MinRevision(request), AnsweredAnywhere(request)},
                   DeadlineOf(*context, RevisionWaits::kLongest), stop,
                   [=](const Status& there) { there.ok() ? answer(respond, stop) : respond(there); });
    });
  }

  /// For calls that have waited already and cannot be cancelled while they wait again.
  static void PostOrRefuse(Lane& lane, const Respond& respond, std::function<void()> work) {
    const auto task = std::make_shared<LaneTask>(std::move(work));
    if (lane.TryPost(task)) return;
    task->GiveUp();
    respond(TooBusy());
  }

  const ServiceContext& context_;
  OpenStreams& streams_;
  RevisionWaits waits_{context_};
};

}  // namespace

std::unique_ptr<grpc::Service> MakeQueryService(const ServiceContext& context, OpenStreams& streams) {
  return std::make_unique<QueryService>(context, streams);
}

}  // namespace dhpmap
