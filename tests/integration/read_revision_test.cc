// SPDX-License-Identifier: BSD-3-Clause
// Answers about recent revisions equal those given at the time.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/integration/test_store.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// A mapped room that is stored only at the end of a stream of frames and with edits.
class ReadRevision : public ::testing::Test {
 protected:
  ReadRevision() { Begin(64); }

  void Begin(std::size_t max_kept_states) {
    server.reset();
    store = MakeTestStore();
    OpenMapOptions options{.publish = {.frames = 1}, .commit = {.frames = 1000, .delay_s = 1000}};
    options.history.max_states = max_kept_states;
    server = std::make_unique<TestServer>(*store, std::move(options));
    EXPECT_OK(server->Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(Feed(*server, "room", 0, 6));
  }

  /// The answer to a call, or its reason.
  template <typename Stub, typename Request, typename Response>
  std::string Tell(Client::Unary<Stub, Request, Response> method, const Request& request) {
    const auto answer = server->Call(method, request);
    status = answer.status();
    return status.ok() ? answer->SerializeAsString() : answer.reason();
  }
  /// All messages of a stream, or its reason.
  template <typename Stub, typename Request, typename Response>
  std::string Tell(Client::Streaming<Stub, Request, Response> method, const Request& request) {
    const auto answer = server->Call(method, request);
    status = answer.status();
    std::string told;
    for (const Response& message : *answer) told += message.SerializeAsString();
    return status.ok() ? told : answer.reason();
  }
  template <typename Request>
  static Request AskAt(std::int64_t revision, const std::string& resource = "maps/room") {
    auto request = About<Request>(resource);
    request.set_read_revision(revision);
    return request;
  }
  /// By a request without other fields.
  template <typename Stub, typename Request, typename Response>
  std::string TellAbout(Client::Unary<Stub, Request, Response> method, const std::string& resource,
                        std::int64_t revision) {
    return Tell(method, AskAt<Request>(revision, resource));
  }
  template <typename Stub, typename Request, typename Response>
  std::string TellAbout(Client::Streaming<Stub, Request, Response> method, const std::string& resource,
                        std::int64_t revision) {
    return Tell(method, AskAt<Request>(revision, resource));
  }
  std::string List(std::int64_t revision) { return TellAbout(&SubmapStub::ListSubmaps, "maps/room", revision); }
  std::string Points(std::int64_t revision) {
    v1::QueryPointsRequest request = TestQuery("room");
    request.set_read_revision(revision);
    return Tell(&QueryStub::QueryPoints, request);
  }
  std::string Distances(std::int64_t revision) {
    auto request = AskAt<v1::QueryDistancesRequest>(revision);
    for (int i = 0; i < 30; ++i) request.add_packed_points_m(-0.9F + 0.13F * static_cast<float>(i));
    request.set_packed(true);
    return Tell(&QueryStub::QueryDistances, request);
  }
  std::string Rays(std::int64_t revision) {
    auto request = AskAt<v1::CastRaysRequest>(revision);
    for (int i = 0; i < 10; ++i) {
      v1::Ray& ray = *request.add_rays();
      ray.mutable_origin_m()->set_x(0.15 * i);
      ray.mutable_origin_m()->set_z(2);
      ray.mutable_direction()->set_z(-1);
    }
    return Tell(&QueryStub::CastRays, request);
  }
  std::string Bodies(std::int64_t revision) {
    auto request = AskAt<v1::CheckCollisionsRequest>(revision);
    for (const float value : {0.0F, 0.0F, 1.0F, 0.3F, 1.2F, 0.3F, 0.8F, 0.3F}) request.add_packed_spheres_m(value);
    return Tell(&QueryStub::CheckCollisions, request);
  }
  std::string Motions(std::int64_t revision) {
    auto request = AskAt<v1::CheckTrajectoryRequest>(revision);
    request.add_robot()->set_radius_m(0.2);
    for (const double x_m : {-1.0, 2.0}) {
      if (request.trajectories().empty()) request.add_trajectories();
      v1::Pose& pose = *request.mutable_trajectories(0)->add_waypoints();
      pose.mutable_translation_m()->set_x(x_m);
      pose.mutable_translation_m()->set_z(0.5);
      pose.mutable_rotation()->set_w(1);
    }
    return Tell(&QueryStub::CheckTrajectory, request);
  }
  std::string Slice(std::int64_t revision) {
    auto request = AskAt<v1::QueryOccupancySliceRequest>(revision);
    request.set_max_z_m(1);
    request.set_include_objects(true);
    return Tell(&QueryStub::QueryOccupancySlice, request);
  }
  std::string Stats(std::int64_t revision) {
    v1::GetMapStatsResponse response =
        server->Call(&MapStub::GetMapStats, AskAt<v1::GetMapStatsRequest>(revision)).KeepStatus(status);
    response.clear_disk_bytes();  // of the store's present state
    return status.ok() ? response.SerializeAsString() : ReasonOf(status);
  }
  std::string Grid(std::int64_t revision) {
    auto request = AskAt<v1::QueryDistanceGridRequest>(revision);
    request.mutable_box()->mutable_min_m()->set_x(-0.5);
    request.mutable_box()->mutable_max_m()->set_x(1.5);
    request.mutable_box()->mutable_max_m()->set_y(0.5);
    request.mutable_box()->mutable_max_m()->set_z(1);
    request.set_resolution_m(0.25);
    return Tell(&QueryStub::QueryDistanceGrid, request);
  }
  using Reading = std::function<std::string(std::int64_t)>;
  /// Every way to read a map.
  std::map<std::string, Reading> Readings() {
    const auto about = [this]<typename Method>(Method method, const std::string& resource) -> Reading {
      return [=, this](std::int64_t revision) { return TellAbout(method, resource, revision); };
    };
    const std::string map = "maps/room", object = "maps/room/submaps/2";
    return {{"ListSubmaps", [this](std::int64_t r) { return List(r); }},
            {"GetSubmap", about(&SubmapStub::GetSubmap, object)},
            {"StreamSubmapVoxels", about(&SubmapStub::StreamSubmapVoxels, object)},
            {"GetSubmapMesh", about(&SubmapStub::GetSubmapMesh, map)},
            {"GetMap", about(&MapStub::GetMap, map)},
            {"GetMapStats", [this](std::int64_t r) { return Stats(r); }},
            {"ListIgnoredRegions", about(&EditStub::ListIgnoredRegions, map)},
            {"QueryPoints", [this](std::int64_t r) { return Points(r); }},
            {"QueryDistances", [this](std::int64_t r) { return Distances(r); }},
            {"CastRays", [this](std::int64_t r) { return Rays(r); }},
            {"CheckCollisions", [this](std::int64_t r) { return Bodies(r); }},
            {"CheckTrajectory", [this](std::int64_t r) { return Motions(r); }},
            {"QueryOccupancySlice", [this](std::int64_t r) { return Slice(r); }},
            {"QueryDistanceGrid", [this](std::int64_t r) { return Grid(r); }},
            {"SearchSubmaps", about(&QueryStub::SearchSubmaps, map)},
            {"QueryRelations", about(&QueryStub::QueryRelations, map)}};
  }

  std::int64_t Now() { return (*server->registry().ViewOf("room"))->snapshot().revision(); }
  static v1::Edit On(int id) {
    v1::Edit edit;
    edit.set_submap("maps/room/submaps/" + std::to_string(id));
    return edit;
  }
  /// Whether the edit was made: a deleted object cannot be edited.
  bool Apply(const v1::Edit& edit) {
    v1::ApplyEditsRequest request;
    request.set_map("maps/room");
    *request.add_edits() = edit;
    status = server->Call(&EditStub::ApplyEdits, request).status();
    return status.ok();
  }
  bool Rename(int id, const std::string& name) {
    v1::Edit edit = On(id);
    edit.mutable_rename()->set_display_name(name);
    return Apply(edit);
  }
  std::map<std::string, std::string> Metadata() const {
    const auto info = ErrorInfoOf(status);
    return {info.metadata().begin(), info.metadata().end()};
  }

  std::unique_ptr<MapStore> store;
  std::unique_ptr<TestServer> server;
  grpc::Status status;
};

/// A random edit of the target; depends on the seed only.
v1::Edit RandomEditOf(const v1::Edit& target, std::mt19937& random) {
  v1::Edit edit = target;
  const double height_m = 0.001 * static_cast<double>(random() % 997);  // no two surfaces are equally near
  switch (random() % 6) {
    case 0: edit.mutable_rename()->set_display_name("name " + std::to_string(random() % 9)); break;
    case 1: {
      v1::Pose& pose = *edit.mutable_move()->mutable_map_from_submap();
      pose.mutable_translation_m()->set_x(0.1 * static_cast<double>(random() % 9));
      pose.mutable_translation_m()->set_z(height_m);
      pose.mutable_rotation()->set_w(1);
      break;
    }
    case 2: {
      v1::Pose& pose = *edit.mutable_clone()->mutable_map_from_submap();
      pose.mutable_translation_m()->set_z(height_m);
      pose.mutable_rotation()->set_w(1);
      break;
    }
    case 3: {
      edit.clear_submap();
      v1::Sphere& sphere = *edit.mutable_clear()->mutable_sphere();
      sphere.mutable_center_m()->set_x(0.2 * static_cast<double>(random() % 8));
      sphere.set_radius_m(0.2);
      break;
    }
    case 4: {
      edit.clear_submap();
      v1::IgnoreRegionEdit& region = *edit.mutable_ignore_region();
      region.set_name("region-" + std::to_string(random() % 1000));
      region.mutable_sphere()->mutable_center_m()->set_z(5);
      region.mutable_sphere()->set_radius_m(0.1);
      break;
    }
    default: edit.mutable_delete_(); break;
  }
  return edit;
}

TEST_F(ReadRevision, ReadableRevisionsAreListed) {
  Begin(4);
  for (int i = 0; i < 6; ++i) {
    v1::Edit rename = On(1);
    rename.mutable_rename()->set_display_name("lamp " + std::to_string(i));
    ASSERT_TRUE(Apply(rename));
  }
  std::vector<std::int64_t> listed;
  v1::ListMapRevisionsRequest request;
  request.set_parent("maps/room");
  request.set_page_size(2);
  do {
    const auto page = server->Call(&MapStub::ListMapRevisions, request).value();
    for (const v1::MapRevision& told : page.revisions()) {
      listed.push_back(told.revision());
      const auto map = server->Call(&MapStub::GetMap, [&] {
        v1::GetMapRequest get;
        get.set_name("maps/room");
        get.set_read_revision(told.revision());
        return get;
      }());
      ASSERT_OK(map);
      EXPECT_EQ(map->map().update_time().ShortDebugString(), told.update_time().ShortDebugString());
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  EXPECT_EQ(listed, (std::vector<std::int64_t>{Now(), Now() - 1, Now() - 2, Now() - 3}));
  EXPECT_EQ(TellAbout(&MapStub::GetMap, "maps/room", Now() - 4), "REVISION_NOT_KEPT");
}

TEST_F(ReadRevision, EveryAnswerEqualsTheOneGivenAtThatRevision) {
  std::mt19937 random(17);
  const auto readings = Readings();
  std::map<std::int64_t, std::map<std::string, std::string>> told;
  for (int step = 0; step < 24; ++step) {
    if (step % 8 == 7) {
      ASSERT_OK(Feed(*server, "room", 6 + step, 8 + step));
    } else {
      (void)Apply(RandomEditOf(On(1 + static_cast<int>(random() % 4)), random));
    }
    auto& answers = told[Now()];
    for (const auto& [name, read] : readings) {
      answers[name] = read(0);
      // For a deleted object or an empty slice, the errors must be equal, too.
      EXPECT_TRUE(status.ok() || status.error_code() == grpc::NOT_FOUND ||
                  status.error_code() == grpc::FAILED_PRECONDITION)
          << name << ": " << status.error_message();
    }
  }
  EXPECT_GT(told.size(), 8u) << "not all edits can be made";
  for (const auto& [revision, answers] : told) {
    for (const auto& [name, read] : readings) {
      EXPECT_EQ(read(revision), answers.at(name))
          << name << " at revision " << revision << ": " << status.error_message();
    }
  }
}

TEST_F(ReadRevision, EveryMethodRefusesAnUnreadableRevisionAndNamesItsNeighbours) {
  const std::int64_t stored = Now();
  ASSERT_GT(stored, 3);
  for (const auto& [name, read] : Readings()) {
    EXPECT_EQ(read(stored - 1), "REVISION_NOT_KEPT") << name << ": it was never stored";
    EXPECT_EQ(status.error_code(), grpc::OUT_OF_RANGE) << name;
    using Neighbours = std::map<std::string, std::string>;
    EXPECT_EQ(Metadata(), (Neighbours{{"revision_before", "1"}, {"revision_after", std::to_string(stored)}})) << name;
    EXPECT_EQ(read(stored + 1), "BAD_REVISION") << name;
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << name;
    EXPECT_EQ(read(-1), "BAD_REVISION") << name;
  }
  EXPECT_NE(List(1), "REVISION_NOT_KEPT") << "the neighbour can be read";
  EXPECT_OK(status);
}

TEST_F(ReadRevision, TheOldestAreDroppedAndALimitOfZeroKeepsOnlyThePresent) {
  Begin(3);
  const std::int64_t first = Now();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Rename(1, "name " + std::to_string(i)));
  EXPECT_EQ(List(first), "REVISION_NOT_KEPT");
  EXPECT_EQ(Metadata(), (std::map<std::string, std::string>{{"revision_after", std::to_string(first + 1)}}));
  (void)List(first + 1);
  EXPECT_OK(status);
  Begin(0);
  const std::int64_t before = Now();
  ASSERT_TRUE(Rename(1, "x"));
  EXPECT_EQ(List(before), "REVISION_NOT_KEPT");
  EXPECT_EQ(List(Now()), List(0));
}

TEST_F(ReadRevision, PagesOfAPastListShowTheSameRevision) {
  const std::int64_t past = Now();
  auto request = AskAt<v1::ListSubmapsRequest>(past);
  ASSERT_OK_AND_ASSIGN(const auto all, server->Call(&SubmapStub::ListSubmaps, request));
  request.set_page_size(1);
  for (int i = 0; i < all.submaps_size(); ++i) {
    ASSERT_OK_AND_ASSIGN(const auto page, server->Call(&SubmapStub::ListSubmaps, request));
    ASSERT_EQ(page.submaps_size(), 1);
    EXPECT_EQ(page.submaps(0).SerializeAsString(), all.submaps(i).SerializeAsString());
    EXPECT_EQ(page.revision(), past);
    request.set_page_token(page.next_page_token());
    (void)Rename(1 + i % 2, "renamed " + std::to_string(i));
  }
  EXPECT_TRUE(request.page_token().empty());
}

TEST_F(ReadRevision, WaitsForItsRevision) {
  const std::int64_t now = Now();
  auto request = AskAt<v1::QueryDistancesRequest>(now);
  request.add_points_m()->set_z(1.3);
  request.mutable_options()->set_min_revision(now);
  const auto ask = [&] { return Tell(&QueryStub::QueryDistances, request); };
  (void)ask();
  EXPECT_OK(status);
  request.mutable_options()->set_min_revision(now + 1);
  EXPECT_EQ(ask(), "BAD_REVISION") << "it would wait for what it does not read";
}

TEST_F(ReadRevision, AStreamPinsAPastStateAndReadsOthers) {
  const std::int64_t past = Now();
  ASSERT_TRUE(Rename(1, "later"));
  ASSERT_TRUE(Rename(1, "latest"));
  grpc::ClientContext context;
  const auto stream = server->queries->StreamQueries(&context);
  const auto revision_of = [&](const v1::StreamQueriesRequest& request) -> std::int64_t {
    v1::StreamQueriesResponse response;
    EXPECT_TRUE(stream->Write(request) && stream->Read(&response));
    EXPECT_EQ(response.error().code(), 0) << response.error().message();
    return response.has_pin() ? response.pin().revision() : response.query_points().revision();
  };
  v1::StreamQueriesRequest pin;
  pin.mutable_pin()->set_map("maps/room");
  pin.mutable_pin()->set_read_revision(past);
  EXPECT_EQ(revision_of(pin), past);
  v1::StreamQueriesRequest query;
  query.mutable_query_points()->set_map("maps/room");
  query.mutable_query_points()->add_points_m();
  EXPECT_EQ(revision_of(query), past) << "that is pinned";
  query.mutable_query_points()->set_read_revision(past + 1);
  EXPECT_EQ(revision_of(query), past + 1);
  query.mutable_query_points()->set_read_revision(past + 2);
  EXPECT_EQ(revision_of(query), past + 2);
  query.mutable_query_points()->set_read_revision(past + 3);
  v1::StreamQueriesResponse response;
  ASSERT_TRUE(stream->Write(query) && stream->Read(&response));
  EXPECT_EQ(response.error().code(), grpc::INVALID_ARGUMENT) << "and the stream goes on";
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

}  // namespace
}  // namespace dhpmap::testing
