// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/query_answers.h"

#include <algorithm>
#include <string>
#include <utility>

#include "server/app/queries/distance_lookup.h"
#include "server/app/queries/object_queries.h"
#include "server/app/queries/point_query.h"
#include "server/app/queries/ray_cast.h"
#include "server/app/queries/slice_export.h"
#include "server/wire/body_conversion.h"
#include "server/wire/distance_conversion.h"
#include "server/wire/object_conversion.h"
#include "server/wire/point_conversion.h"
#include "server/wire/query_options.h"
#include "server/wire/ray_conversion.h"
#include "server/wire/slice_conversion.h"
#include "server/wire/trajectory_conversion.h"

namespace dhpmap {
namespace {

/// Larger queries take milliseconds and would delay small ones.
constexpr std::size_t kMostQuickPoints = 2048, kMostQuickDistances = 256, kMostQuickBodies = 256,
                      kMostQuickSpheres = 2048;

template <typename Request>
std::size_t NumPoints(const Request& request) {
  return static_cast<std::size_t>(request.packed_points_m_size() / 3 + request.points_m_size());
}

template <typename Request>
QueryEffort EffortOfItems(const Request& request, std::size_t num_items, std::size_t most_quick) {
  return {.num_items = num_items, .is_quick = num_items <= most_quick, .answer_bytes = BytesOfAnswers(request)};
}

const MapInfo& InfoOf(const QueryPlace& place) { return place.view.snapshot().info(); }
SurfaceCache& SurfacesOf(const QueryPlace& place) { return place.context.registry.surfaces(); }

template <typename Request>
Result<Pager> PagerFor(const QueryPlace& place, const Request& request, PageSizes sizes) {
  const MapInfo& map = InfoOf(place);
  const PageMark now{.history_id = map.history_id, .revision = place.view.snapshot().revision()};
  return Pager::Begin(request, now, *place.context.registry.LostRevisionsOf(map.name), sizes);
}

}  // namespace

Status AnswersTooLarge(std::size_t bytes) {
  return InvalidArgument("the query cannot be answered")
      .WithReason("BAD_POINTS")
      .WithViolation("packed", "the answers would take " + std::to_string(bytes >> 20) +
                                   " MiB, more than there is for all calls: ask for packed ones, or for fewer");
}

QueryEffort EffortOf(const v1::QueryPointsRequest& request) {
  return EffortOfItems(request, NumPoints(request), kMostQuickPoints);
}

Status AnswerQuery(const QueryPlace& place, const v1::QueryPointsRequest& request, v1::QueryPointsResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(auto points_m, PointsFromProto(request, place.context.options.max_query_points));
  DHPMAP_ASSIGN_OR_RETURN(const Transform T_map_query, FrameOptionsFromProto(request.options()));
  if (request.options().has_map_from_query()) {
    for (Eigen::Vector3d& p : points_m) p = T_map_query * p;
    const bool is_finite = std::all_of(points_m.begin(), points_m.end(), [](const auto& p) { return p.allFinite(); });
    if (!is_finite) {
      return InvalidArgument("the points cannot be looked up")
          .WithReason("BAD_POINTS")
          .WithViolation("options.map_from_query", "takes points to where no number goes");
    }
  }
  DHPMAP_RETURN_IF_ERROR(place.fits);
  PointAnswers answers(request, InfoOf(place), points_m.size(), response);
  return LookUpPoints(place.view, points_m, place.stop, place.spread,
                      [&](const PointInfo& point) { answers.Append(point); });
}

QueryEffort EffortOf(const v1::QueryDistancesRequest& request) {
  return EffortOfItems(request, NumPoints(request), kMostQuickDistances);
}

Status AnswerQuery(const QueryPlace& place, const v1::QueryDistancesRequest& request,
                   v1::QueryDistancesResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(const auto points_m, PointsFromProto(request, place.context.options.max_query_points));
  DHPMAP_ASSIGN_OR_RETURN(const auto question,
                          QueryOptionsFromProto(request.options(), place.view.snapshot(), kDistanceOptions));
  DHPMAP_RETURN_IF_ERROR(place.fits);
  DistanceAnswers answers(request, InfoOf(place), points_m.size(), response);
  return LookUpDistances(place.view, SurfacesOf(place), question, points_m, place.stop, place.spread,
                         [&](const SurfaceDistance& distance) { answers.Append(distance); });
}

QueryEffort EffortOf(const v1::CastRaysRequest& request) {
  return EffortOfItems(request, NumRays(request), kMostQuickDistances);
}

Status AnswerQuery(const QueryPlace& place, const v1::CastRaysRequest& request, v1::CastRaysResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(const auto rays, RaysFromProto(request, place.context.options.max_query_points));
  DHPMAP_ASSIGN_OR_RETURN(const auto question,
                          QueryOptionsFromProto(request.options(), place.view.snapshot(), kRayOptions));
  DHPMAP_RETURN_IF_ERROR(place.fits);
  RayAnswers answers(request, InfoOf(place), response);
  return CastRays(place.view, SurfacesOf(place), question, rays, place.stop,
                  [&](const RayHit& hit) { answers.Append(hit); });
}

QueryEffort EffortOf(const v1::QueryOccupancySliceRequest& request) {
  return {.answer_bytes = BytesOfAnswers(request)};
}

Status AnswerQuery(const QueryPlace& place, const v1::QueryOccupancySliceRequest& request,
                   v1::QueryOccupancySliceResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(const SliceRequest wanted, SliceRequestFromProto(request, place.view.snapshot()));
  DHPMAP_RETURN_IF_ERROR(place.fits);
  DHPMAP_ASSIGN_OR_RETURN(SliceAnswer slice, ExportSlice(place.view, SurfacesOf(place), wanted, place.stop));
  ToProto(wanted, InfoOf(place), std::move(slice), response);
  return Status::Ok();
}

QueryEffort EffortOf(const v1::SearchSubmapsRequest& request) { return {.answer_bytes = BytesOfAnswers(request)}; }

Status AnswerQuery(const QueryPlace& place, const v1::SearchSubmapsRequest& request,
                   v1::SearchSubmapsResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(Pager pager, PagerFor(place, request, kMatchPages));
  DHPMAP_ASSIGN_OR_RETURN(const SubmapQuestion question,
                          SubmapQuestionFromProto(request, place.view.snapshot(), pager));
  DHPMAP_RETURN_IF_ERROR(place.fits);
  DHPMAP_ASSIGN_OR_RETURN(const auto matches, FindSubmaps(place.view, SurfacesOf(place), question, place.stop));
  ToProto(question, matches, place.view, pager, response);
  return Status::Ok();
}

QueryEffort EffortOf(const v1::QueryRelationsRequest& request) { return {.answer_bytes = BytesOfAnswers(request)}; }

Status AnswerQuery(const QueryPlace& place, const v1::QueryRelationsRequest& request,
                   v1::QueryRelationsResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(Pager pager, PagerFor(place, request, kRelationPages));
  DHPMAP_ASSIGN_OR_RETURN(const RelationQuestion question,
                          RelationQuestionFromProto(request, place.view.snapshot(), pager));
  DHPMAP_RETURN_IF_ERROR(place.fits);
  DHPMAP_ASSIGN_OR_RETURN(const auto relations, ListRelations(place.view, SurfacesOf(place), question, place.stop));
  ToProto(relations, InfoOf(place), pager, response);
  return Status::Ok();
}

QueryEffort EffortOf(const v1::CheckCollisionsRequest& request) {
  return EffortOfItems(request, NumBodies(request), kMostQuickBodies);
}

QueryEffort EffortOf(const v1::CheckTrajectoryRequest& request) {
  // Attached objects add many spheres.
  const std::size_t most_quick = request.options().attached_size() > 0 ? 0 : kMostQuickSpheres;
  return EffortOfItems(request, NumSpheres(request), most_quick);
}

}  // namespace dhpmap
