// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/queries.h"

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/src/convert/answers.h"
#include "clients/cpp/src/convert/geometry.h"
#include "clients/cpp/src/convert/objects.h"
#include "clients/cpp/src/convert/options.h"
#include "clients/cpp/src/stream_source.h"

namespace dhpmap::client {
namespace {

constexpr std::size_t kMostRowsACall = 1'000'000;
constexpr int kMostAPage = 1000;

using Query = v1::StreamQueriesRequest;

/// Asks all questions, in several calls if one would be too large; later ones use the revision of the first. `ask` sets
/// the query of a part, and returns its request; `answered` returns the response.
template <typename Answer, typename Question, typename Ask, typename Answered>
Result<Answers<Answer>> AskInParts(Source& source, std::span<const Question> questions, double deadline_s,
                                   const Ask& ask, const Answered& answered) {
  Answers<Answer> out;
  out.results.reserve(questions.size());
  do {
    const auto part = questions.subspan(out.size(), std::min(kMostRowsACall, questions.size() - out.size()));
    Query query;
    ask(query, part)->set_read_revision(out.revision > 0 ? out.revision : source.read_revision());
    const Result<v1::StreamQueriesResponse> response = source.Answer(std::move(query), deadline_s);
    if (!response.ok()) return response.status();
    out.revision = answered(*response).revision();
    if (Status status = Append(answered(*response).packed(), part.size(), out.results); !status.ok()) return status;
  } while (out.size() < questions.size());
  return out;
}

v1::CheckTrajectoryRequest PathRequest(const Source& source, const Spheres& robot, const QueryOptions& options,
                                       const CheckOptions& check) {
  v1::CheckTrajectoryRequest request;
  request.set_map(source.map());
  for (const Sphere& sphere : robot.spheres_m) *request.add_robot() = ToProto(sphere);
  for (const std::string& link : robot.links) request.add_sphere_links(link);
  *request.mutable_options() = ToProto(options, source.map(), robot.may_touch);
  request.set_all_contacts(check.all_contacts);
  request.set_include_clearance(check.include_clearance);
  request.set_read_revision(source.read_revision());
  return request;
}

Result<Answers<PathCheck>> AskPaths(Source& source, v1::CheckTrajectoryRequest request, double deadline_s) {
  const int count = request.trajectories_size();
  Query query;
  *query.mutable_check_trajectory() = std::move(request);
  const Result<v1::StreamQueriesResponse> response = source.Answer(std::move(query), deadline_s);
  if (!response.ok()) return response.status();
  const v1::CheckTrajectoryResponse& answer = response->check_trajectory();
  if (answer.results_size() != count) return Error(StatusCode::kInternal, "the answer is to other paths");
  Answers<PathCheck> out{answer.revision(), {}};
  for (const v1::TrajectoryResult& result : answer.results()) out.results.push_back(FromProto(result));
  return out;
}

}  // namespace

Queries::Queries(std::shared_ptr<Source> source) : source_(std::move(source)) {}
Queries::~Queries() = default;

Result<Answers<Distance>> Queries::Distances(std::span<const Vector3> points_m, const QueryOptions& options) const {
  return AskInParts<Distance>(
      *source_, points_m, options.deadline_s,
      [&](Query& query, std::span<const Vector3> part) {
        v1::QueryDistancesRequest* request = query.mutable_query_distances();
        request->set_map(source_->map());
        request->set_packed(true);
        *request->mutable_options() = ToProto(options, source_->map());
        Pack(part, *request->mutable_packed_points_m());
        return request;
      },
      [](const auto& response) -> const auto& { return response.query_distances(); });
}

Result<Answers<PointState>> Queries::Points(std::span<const Vector3> points_m, const QueryOptions& options) const {
  return AskInParts<PointState>(
      *source_, points_m, options.deadline_s,
      [&](Query& query, std::span<const Vector3> part) {
        v1::QueryPointsRequest* request = query.mutable_query_points();
        request->set_map(source_->map());
        request->set_packed(true);
        *request->mutable_options() = ToProto(options, source_->map());
        Pack(part, *request->mutable_packed_points_m());
        return request;
      },
      [](const auto& response) -> const auto& { return response.query_points(); });
}

Result<Answers<RayHit>> Queries::CastRays(std::span<const Ray> rays, const QueryOptions& options) const {
  return AskInParts<RayHit>(
      *source_, rays, options.deadline_s,
      [&](Query& query, std::span<const Ray> part) {
        v1::CastRaysRequest* request = query.mutable_cast_rays();
        request->set_map(source_->map());
        request->set_packed(true);
        *request->mutable_options() = ToProto(options, source_->map());
        std::vector<Vector3> origins_m(part.size()), directions(part.size());
        std::transform(part.begin(), part.end(), origins_m.begin(), [](const Ray& ray) { return ray.origin_m; });
        std::transform(part.begin(), part.end(), directions.begin(), [](const Ray& ray) { return ray.direction; });
        Pack(origins_m, *request->mutable_packed_origins_m());
        Pack(directions, *request->mutable_packed_directions());
        return request;
      },
      [](const auto& response) -> const auto& { return response.cast_rays(); });
}

Result<Answers<Collision>> Queries::Collisions(std::span<const Sphere> spheres_m, const QueryOptions& options) const {
  return AskInParts<Collision>(
      *source_, spheres_m, options.deadline_s,
      [&](Query& query, std::span<const Sphere> part) {
        v1::CheckCollisionsRequest* request = query.mutable_check_collisions();
        request->set_map(source_->map());
        request->set_packed(true);
        *request->mutable_options() = ToProto(options, source_->map());
        Pack(part, *request->mutable_packed_spheres_m());
        return request;
      },
      [](const auto& response) -> const auto& { return response.check_collisions(); });
}

Result<Answers<BodyCheck>> Queries::CheckBodies(std::span<const Body> bodies, const QueryOptions& options,
                                                const CheckOptions& check) const {
  Query query;
  v1::CheckCollisionsRequest& request = *query.mutable_check_collisions();
  request.set_map(source_->map());
  for (const Body& body : bodies) *request.add_bodies() = ToProto(body);
  for (const std::string& link : check.links) request.add_body_links(link);
  *request.mutable_options() = ToProto(options, source_->map());
  request.set_all_contacts(check.all_contacts);
  request.set_read_revision(source_->read_revision());
  const Result<v1::StreamQueriesResponse> response = source_->Answer(std::move(query), options.deadline_s);
  if (!response.ok()) return response.status();
  Answers<BodyCheck> out{response->check_collisions().revision(), {}};
  for (const auto& result : response->check_collisions().results()) out.results.push_back(FromProto(result));
  if (out.size() != bodies.size()) return Error(StatusCode::kInternal, "the answer is to other bodies");
  return out;
}

Result<PathCheck> Queries::CheckPath(const Spheres& robot, std::span<const Pose> waypoints, const QueryOptions& options,
                                     const CheckOptions& check) const {
  v1::CheckTrajectoryRequest request = PathRequest(*source_, robot, options, check);
  v1::Trajectory& path = *request.add_trajectories();
  for (const Pose& T_map_robot : waypoints) *path.add_waypoints() = ToProto(T_map_robot);
  Result<Answers<PathCheck>> answers = AskPaths(*source_, std::move(request), options.deadline_s);
  if (!answers.ok()) return answers.status();
  return std::move(answers->results.front());
}

Result<Answers<PathCheck>> Queries::CheckPaths(const Spheres& robot, std::span<const std::vector<Pose>> paths,
                                               const QueryOptions& options, const CheckOptions& check) const {
  v1::CheckTrajectoryRequest request = PathRequest(*source_, robot, options, check);
  for (const std::vector<Pose>& waypoints : paths) {
    v1::Trajectory& path = *request.add_trajectories();
    for (const Pose& T_map_robot : waypoints) *path.add_waypoints() = ToProto(T_map_robot);
  }
  return AskPaths(*source_, std::move(request), options.deadline_s);
}

Result<Answers<PathCheck>> Queries::CheckPoses(const Spheres& robot, std::span<const Pose> poses,
                                               const QueryOptions& options, const CheckOptions& check) const {
  v1::CheckTrajectoryRequest request = PathRequest(*source_, robot, options, check);
  for (const Pose& T_map_robot : poses) *request.add_trajectories()->add_waypoints() = ToProto(T_map_robot);
  return AskPaths(*source_, std::move(request), options.deadline_s);
}

Result<std::vector<Object>> Queries::Find(std::string_view class_name, const FindOptions& options) const {
  v1::SearchSubmapsRequest request;
  request.set_map(source_->map());
  request.set_name_part(options.name);
  request.set_read_revision(source_->read_revision());
  *request.mutable_options() = ToProto(options.query, source_->map());
  if (!class_name.empty()) request.mutable_options()->add_class_names(std::string(class_name));
  if (options.near_m) *request.mutable_near_point_m() = ToProto(*options.near_m);
  if (options.within) {
    if (const Box* box = std::get_if<Box>(&*options.within)) *request.mutable_region() = ToProto(*box);
    else *request.mutable_sphere() = ToProto(std::get<Sphere>(*options.within));
  }
  std::vector<Object> found;
  while (static_cast<int>(found.size()) < options.limit) {
    request.set_page_size(std::min(options.limit - static_cast<int>(found.size()), kMostAPage));
    Query query;
    *query.mutable_search_submaps() = request;
    const Result<v1::StreamQueriesResponse> response = source_->Answer(std::move(query), options.query.deadline_s);
    if (!response.ok()) return response.status();
    for (const v1::SubmapMatch& match : response->search_submaps().matches()) found.push_back(FromProto(match));
    request.set_page_token(response->search_submaps().next_page_token());
    if (request.page_token().empty()) break;
  }
  return found;
}

EventualMap::EventualMap(std::shared_ptr<Source> source) : Queries(std::move(source)) {}

Pinned::Pinned(std::shared_ptr<Source> source, std::int64_t revision)
    : Queries(std::move(source)), revision_(revision) {}

Loop::Loop(std::shared_ptr<Source> source) : Queries(std::move(source)) {}

Result<std::int64_t> Loop::Pin(std::int64_t revision) {
  if (revision < 0) return BadArgument("revision", std::to_string(revision) + " is none");
  return static_cast<StreamSource&>(*source()).Pin(revision);  // Map::Loop creates a StreamSource
}

Status Loop::Unpin() { return static_cast<StreamSource&>(*source()).Pin(-1).status(); }

}  // namespace dhpmap::client
