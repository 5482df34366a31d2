// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/base/spread.h"
#include "mapping/paging/page_reader.h"
#include "server/app/states/map_view.h"
#include "server/grpc/call_runner.h"

namespace dhpmap {

/// The cost of answering a query.
struct QueryEffort {
  std::size_t num_items = 1;     ///< points, rays, calls
  bool is_quick = false;         ///< a millisecond at most
  std::size_t answer_bytes = 0;  ///< upper bound: the question as held, the answer, and the answer's bytes
};

/// Where a query is answered: one state of a map. `fits` is an error if the answers do not fit into the budget; a query
/// returns it after it has validated the request. `spread` parallelises queries with many parts.
struct QueryPlace {
  const ServiceContext& context;
  const MapView& view;
  const Status& fits;
  const std::stop_token& stop;
  const Spread& spread;
};

// Each query is two functions of its request, for unary calls and for streams.

QueryEffort EffortOf(const v1::QueryPointsRequest& request);
Status AnswerQuery(const QueryPlace& place, const v1::QueryPointsRequest& request, v1::QueryPointsResponse& response);

QueryEffort EffortOf(const v1::QueryDistancesRequest& request);
Status AnswerQuery(const QueryPlace& place, const v1::QueryDistancesRequest& request,
                   v1::QueryDistancesResponse& response);

QueryEffort EffortOf(const v1::CastRaysRequest& request);
Status AnswerQuery(const QueryPlace& place, const v1::CastRaysRequest& request, v1::CastRaysResponse& response);

QueryEffort EffortOf(const v1::QueryOccupancySliceRequest& request);
Status AnswerQuery(const QueryPlace& place, const v1::QueryOccupancySliceRequest& request,
                   v1::QueryOccupancySliceResponse& response);

QueryEffort EffortOf(const v1::SearchSubmapsRequest& request);
Status AnswerQuery(const QueryPlace& place, const v1::SearchSubmapsRequest& request,
                   v1::SearchSubmapsResponse& response);

QueryEffort EffortOf(const v1::QueryRelationsRequest& request);
Status AnswerQuery(const QueryPlace& place, const v1::QueryRelationsRequest& request,
                   v1::QueryRelationsResponse& response);

// Queries that are answered in pieces: see CheckAnswer.
QueryEffort EffortOf(const v1::CheckCollisionsRequest& request);
QueryEffort EffortOf(const v1::CheckTrajectoryRequest& request);

/// The error for `fits` if so many bytes exceed the budget of all calls.
Status AnswersTooLarge(std::size_t bytes);

/// Answers any query above, within the budget, and counts it.
template <typename Request, typename Response>
Status AnswerFromMap(const ServiceContext& context, const std::shared_ptr<const MapView>& view, const Request& request,
                     Response& response, const std::stop_token& stop) {
  const QueryEffort effort = EffortOf(request);
  const bool can_fit = effort.answer_bytes <= context.options.inflight->limit_bytes();
  const Status fits = can_fit ? Status::Ok() : AnswersTooLarge(effort.answer_bytes);
  const Spread spread = effort.is_quick ? Spread(InPlace) : OnBulkLane(context);
  DHPMAP_RETURN_IF_ERROR(AnswerQuery({context, *view, fits, stop, spread}, request, response));
  if (context.observer.on_query) context.observer.on_query(effort.num_items);
  return Status::Ok();
}

}  // namespace dhpmap
