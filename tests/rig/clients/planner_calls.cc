// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/planner_calls.h"

#include <chrono>
#include <cstdio>
#include <thread>

namespace dhpmap::rig {
namespace {

constexpr std::size_t kMaxComplaints = 10;
constexpr int kPoints = 100, kWaypoints = 50, kSpheres = 20;

v1::Vector3 Vector(double x, double y, double z) {
  v1::Vector3 v;
  v.set_x(x);
  v.set_y(y);
  v.set_z(z);
  return v;
}

}  // namespace

PlannerCalls::PlannerCalls(const Target& target, unsigned seed)
    : target_(target), client_(OwnChannel(target.grpc_address)), http_(target.http_port), random_(seed) {}

void PlannerCalls::Run(double rate_hz, Table& table, const std::stop_token& stop) {
  using Call = bool (PlannerCalls::*)();
  constexpr std::array<Call, kKinds.size()> kCalls = {
      &PlannerCalls::Points,     &PlannerCalls::Distances, &PlannerCalls::Rays,           &PlannerCalls::Collisions,
      &PlannerCalls::Trajectory, &PlannerCalls::Slice,     &PlannerCalls::Grid,           &PlannerCalls::Search,
      &PlannerCalls::Relations,  &PlannerCalls::Stream,    &PlannerCalls::PointsOverRest, &PlannerCalls::Edits};
  // As often as a robot asks: what steers it, what it looks up now and then, what people do.
  std::discrete_distribution<std::size_t> kinds{10, 10, 10, 10, 10, 3, 3, 3, 1, 10, 10, 2};
  const std::chrono::duration<double> pause(1 / rate_hz);
  while (!stop.stop_requested()) {
    const auto begin = std::chrono::steady_clock::now();
    const std::size_t kind = kinds(random_);
    if ((this->*kCalls[kind])()) {
      table[kind].Add(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    } else {
      table[kind].AddFailure();
    }
    std::this_thread::sleep_until(begin + pause);
  }
}

bool PlannerCalls::Complain(const std::string& what) {
  if (complaints_.size() < kMaxComplaints) complaints_.push_back(what);
  return false;
}

bool PlannerCalls::IsRight(const grpc::Status& status, std::int64_t revision, int num_answered, int num_asked) {
  if (!status.ok()) return Complain(status.error_message());
  if (num_answered != num_asked)
    return Complain(std::to_string(num_answered) + " answers to " + std::to_string(num_asked));
  if (revision < revision_) {
    return Complain("revision " + std::to_string(revision) + " after " + std::to_string(revision_));
  }
  revision_ = revision;
  return true;
}

v1::Vector3 PlannerCalls::Place() { return Vector(Any(11), Any(8), Any(2.6)); }

/// As a planner asks: around one place.
template <typename Request>
void PlannerCalls::AddPlaces(Request& request, int number) {
  request.set_map("maps/" + target_.map_id);
  request.set_packed(true);
  const v1::Vector3 middle = Place();
  for (int i = 0; i < number; ++i) {
    request.add_packed_points_m(static_cast<float>(middle.x() + Any(1)));
    request.add_packed_points_m(static_cast<float>(middle.y() + Any(1)));
    request.add_packed_points_m(static_cast<float>(middle.z() + Any(0.5)));
  }
}

bool PlannerCalls::Points() {
  v1::QueryPointsRequest request;
  AddPlaces(request, kPoints);
  const auto answer = client_.Call(&testing::QueryStub::QueryPoints, request);
  return IsRight(answer.status(), answer->revision(), answer->packed().near_surface_size(), kPoints);
}

bool PlannerCalls::Distances() {
  v1::QueryDistancesRequest request;
  AddPlaces(request, kPoints);
  const auto answer = client_.Call(&testing::QueryStub::QueryDistances, request);
  return IsRight(answer.status(), answer->revision(), answer->packed().distance_m_size(), kPoints);
}

bool PlannerCalls::Rays() {
  v1::CastRaysRequest request;
  request.set_map("maps/" + target_.map_id);
  request.set_packed(true);
  for (int i = 0; i < 3; ++i) request.add_packed_origins_m(static_cast<float>(1 + Any(1)));
  for (int i = 0; i < 3 * kPoints; ++i) request.add_packed_directions(static_cast<float>(0.1 + Any(1)));
  const auto answer = client_.Call(&testing::QueryStub::CastRays, request);
  return IsRight(answer.status(), answer->revision(), answer->packed().distance_m_size(), kPoints);
}

bool PlannerCalls::Collisions() {
  v1::CheckCollisionsRequest request;
  request.set_map("maps/" + target_.map_id);
  for (int i = 0; i < kPoints; ++i) {
    v1::Body& body = *request.add_bodies();
    if (i % 3 == 0) {
      *body.mutable_sphere()->mutable_center_m() = Place();
      body.mutable_sphere()->set_radius_m(0.05 + Any(0.3));
    } else if (i % 3 == 1) {
      *body.mutable_box()->mutable_pose()->mutable_translation_m() = Place();
      body.mutable_box()->mutable_pose()->mutable_rotation()->set_w(1);
      *body.mutable_box()->mutable_size_m() = Vector(0.1 + Any(0.4), 0.1 + Any(0.4), 0.1 + Any(0.4));
    } else {
      const v1::Vector3 a = Place();
      *body.mutable_capsule()->mutable_a_m() = a;
      *body.mutable_capsule()->mutable_b_m() = Vector(a.x() + Any(0.5), a.y() + Any(0.5), a.z());
      body.mutable_capsule()->set_radius_m(0.05 + Any(0.2));
    }
  }
  const auto answer = client_.Call(&testing::QueryStub::CheckCollisions, request);
  return IsRight(answer.status(), answer->revision(), answer->results_size(), kPoints);
}

bool PlannerCalls::Trajectory() {
  v1::CheckTrajectoryRequest request;
  request.set_map("maps/" + target_.map_id);
  for (int i = 0; i < kSpheres; ++i) {
    v1::Sphere& sphere = *request.add_robot();
    *sphere.mutable_center_m() = Vector(0, 0, 0.1 + 0.05 * i);
    sphere.set_radius_m(0.1);
  }
  const v1::Vector3 begin = Place(), end = Place();
  v1::Trajectory& way = *request.add_trajectories();
  for (int i = 0; i < kWaypoints; ++i) {
    const double share = i / (kWaypoints - 1.0);
    v1::Pose& pose = *way.add_waypoints();
    *pose.mutable_translation_m() =
        Vector(begin.x() + share * (end.x() - begin.x()), begin.y() + share * (end.y() - begin.y()), 0);
    pose.mutable_rotation()->set_w(1);
  }
  const auto answer = client_.Call(&testing::QueryStub::CheckTrajectory, request);
  return IsRight(answer.status(), answer->revision(), answer->results_size(), 1);
}

bool PlannerCalls::Slice() {
  v1::QueryOccupancySliceRequest request;
  request.set_map("maps/" + target_.map_id);
  request.set_min_z_m(0.1);
  request.set_max_z_m(1);
  const v1::Vector3 corner = Place();
  request.mutable_area()->set_min_x_m(corner.x());
  request.mutable_area()->set_min_y_m(corner.y());
  request.mutable_area()->set_max_x_m(corner.x() + 2);
  request.mutable_area()->set_max_y_m(corner.y() + 2);
  const auto answer = client_.Call(&testing::QueryStub::QueryOccupancySlice, request);
  return IsRight(answer.status(), answer->revision(), static_cast<int>(answer->cells().size()),
                 answer->width() * answer->height());
}

bool PlannerCalls::Grid() {
  v1::QueryDistanceGridRequest request;
  request.set_map("maps/" + target_.map_id);
  request.set_resolution_m(0.1);
  const v1::Vector3 corner = Place();
  *request.mutable_box()->mutable_min_m() = corner;
  *request.mutable_box()->mutable_max_m() = Vector(corner.x() + 1, corner.y() + 1, corner.z() + 0.5);
  const auto parts = client_.Call(&testing::QueryStub::QueryDistanceGrid, request);
  std::int64_t revision = revision_;
  int num_nodes = 0, num_read = 0;
  for (const v1::QueryDistanceGridResponse& part : *parts) {
    if (num_read == 0) num_nodes = part.num_x() * part.num_y() * part.num_z();
    num_read += part.distance_m_size();
    if (part.revision() != 0) revision = part.revision();
  }
  return IsRight(parts.status(), revision, num_read, num_nodes);
}

bool PlannerCalls::Search() {
  v1::SearchSubmapsRequest request;
  request.set_map("maps/" + target_.map_id);
  *request.mutable_near_point_m() = Place();
  request.set_page_size(5);
  const auto answer = client_.Call(&testing::QueryStub::SearchSubmaps, request);
  return IsRight(answer.status(), answer->revision(), answer->matches_size(), 5);
}

bool PlannerCalls::Relations() {
  v1::QueryRelationsRequest request;
  request.set_map("maps/" + target_.map_id);
  const auto answer = client_.Call(&testing::QueryStub::QueryRelations, request);
  return IsRight(answer.status(), answer->revision(), 0, 0);
}

/// Three answers of one state, while frames go on.
bool PlannerCalls::Stream() {
  grpc::ClientContext context;
  const auto stream = testing::QueryStub(client_.channel()).StreamQueries(&context);
  v1::StreamQueriesRequest pin, points, distances;
  pin.mutable_pin()->set_map("maps/" + target_.map_id);
  AddPlaces(*points.mutable_query_points(), 10);
  AddPlaces(*distances.mutable_query_distances(), 10);
  stream->Write(pin);
  stream->Write(points);
  stream->Write(distances);
  stream->WritesDone();
  std::vector<std::int64_t> revisions;
  v1::StreamQueriesResponse answer;
  while (stream->Read(&answer)) {
    if (answer.has_error()) return Complain("StreamQueries: " + answer.error().message());
    revisions.push_back(answer.has_pin()            ? answer.pin().revision()
                        : answer.has_query_points() ? answer.query_points().revision()
                                                    : answer.query_distances().revision());
  }
  const grpc::Status status = stream->Finish();
  if (status.ok() && (revisions.size() != 3 || revisions[1] != revisions[0] || revisions[2] != revisions[0])) {
    return Complain("a pinned stream has answers of several revisions");
  }
  return IsRight(status, revisions.empty() ? 0 : revisions[0], static_cast<int>(revisions.size()), 3);
}

bool PlannerCalls::PointsOverRest() {
  char body[160];
  const v1::Vector3 place = Place();
  std::snprintf(body, sizeof body, R"({"points_m": [{"x": %.4f, "y": %.4f, "z": %.4f}]})", place.x(), place.y(),
                place.z());
  const http::HttpAnswer answer = http_.Ask("POST", "/v1/maps/" + target_.map_id + ":queryPoints", body);
  if (answer.status == 200 && answer.is_complete) return true;
  return Complain("REST: " + std::to_string(answer.status) + " " + answer.body);
}

/// Copies an object to where no camera looks, moves the copy, renames it and deletes it.
bool PlannerCalls::Edits() {
  v1::ListSubmapsRequest list;
  list.set_parent("maps/" + target_.map_id);
  list.set_kind(v1::LabelClass::THING);
  const auto things = client_.Call(&testing::SubmapStub::ListSubmaps, list);
  if (!IsRight(things.status(), things->revision(), 0, 0)) return false;
  if (things->submaps().empty()) return Complain("there is no thing to edit");
  v1::CloneSubmapRequest clone;
  clone.set_name(things->submaps(static_cast<int>(Any(things->submaps_size()))).name());
  clone.mutable_map_from_submap()->mutable_translation_m()->set_z(50 + Any(10));
  clone.mutable_map_from_submap()->mutable_rotation()->set_w(1);
  const auto cloned = client_.Call(&testing::SubmapStub::CloneSubmap, clone);
  if (cloned.code() == grpc::StatusCode::NOT_FOUND) return true;  // mapping or another client took it away
  if (!IsRight(cloned.status(), cloned->revision(), 0, 0)) return false;
  v1::UpdateSubmapRequest update;
  update.mutable_submap()->set_name(cloned->submap().name());
  update.mutable_submap()->set_display_name("a copy");
  update.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_z(70 + Any(10));
  update.mutable_submap()->mutable_map_from_submap()->mutable_rotation()->set_w(1);
  update.mutable_update_mask()->add_paths("display_name");
  update.mutable_update_mask()->add_paths("map_from_submap");
  const auto updated = client_.Call(&testing::SubmapStub::UpdateSubmap, update);
  if (!IsRight(updated.status(), updated->revision(), 0, 0)) return false;
  const auto deleted = client_.Call(&testing::SubmapStub::DeleteSubmap, cloned->submap().name());
  return IsRight(deleted.status(), deleted->revision(), 0, 0);
}

}  // namespace dhpmap::rig
