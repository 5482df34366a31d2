// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/src/source.h"

namespace dhpmap::client {
namespace {

class CalledSource final : public Source {
 public:
  CalledSource(std::shared_ptr<Caller> caller, std::string map, std::int64_t read_revision,
               v1::Consistency::Level consistency)
      : Source(std::move(map), read_revision), caller_(std::move(caller)), consistency_(consistency) {}

  Result<v1::StreamQueriesResponse> Answer(v1::StreamQueriesRequest query, double deadline_s) override {
    using Stub = v1::QueryService::Stub;
    using Query = v1::StreamQueriesRequest;
    using Answered = v1::StreamQueriesResponse;
    const auto ask = [&](auto method, auto& request, auto place) -> Result<Answered> {
      request.set_consistency(consistency_);
      auto answer = caller_->Call(method, request, deadline_s);
      if (!answer.ok()) return answer.status();
      Answered answered;
      *(answered.*place)() = *std::move(answer);
      return answered;
    };
    switch (query.query_case()) {
      case Query::kQueryPoints:
        return ask(&Stub::QueryPoints, *query.mutable_query_points(), &Answered::mutable_query_points);
      case Query::kQueryDistances:
        return ask(&Stub::QueryDistances, *query.mutable_query_distances(), &Answered::mutable_query_distances);
      case Query::kCastRays: return ask(&Stub::CastRays, *query.mutable_cast_rays(), &Answered::mutable_cast_rays);
      case Query::kSearchSubmaps:
        return ask(&Stub::SearchSubmaps, *query.mutable_search_submaps(), &Answered::mutable_search_submaps);
      case Query::kCheckCollisions:
        return ask(&Stub::CheckCollisions, *query.mutable_check_collisions(), &Answered::mutable_check_collisions);
      case Query::kCheckTrajectory:
        return ask(&Stub::CheckTrajectory, *query.mutable_check_trajectory(), &Answered::mutable_check_trajectory);
      case Query::kQueryOccupancySlice:
        return ask(&Stub::QueryOccupancySlice, *query.mutable_query_occupancy_slice(),
                   &Answered::mutable_query_occupancy_slice);
      case Query::kQueryRelations:
        return ask(&Stub::QueryRelations, *query.mutable_query_relations(), &Answered::mutable_query_relations);
      default: return Error(StatusCode::kInternal, "this query goes on streams only");
    }
  }

  std::unique_ptr<Parts<v1::QueryDistanceGridResponse>> AnswerGrid(v1::QueryDistanceGridRequest query,
                                                                   double deadline_s) override {
    query.set_read_revision(read_revision());
    query.set_consistency(consistency_);
    return caller_->Read(&v1::QueryService::Stub::QueryDistanceGrid, query, caller_->DeadlineOr(deadline_s));
  }

 private:
  const std::shared_ptr<Caller> caller_;
  const v1::Consistency::Level consistency_;
};

}  // namespace

std::shared_ptr<Source> MakeCalledSource(std::shared_ptr<Caller> caller, std::string map, std::int64_t read_revision) {
  return std::make_shared<CalledSource>(std::move(caller), std::move(map), read_revision,
                                        v1::Consistency::LEVEL_UNSPECIFIED);
}

std::shared_ptr<Source> MakeEventualSource(std::shared_ptr<Caller> caller, std::string map) {
  return std::make_shared<CalledSource>(std::move(caller), std::move(map), 0, v1::Consistency::EVENTUAL);
}

}  // namespace dhpmap::client
