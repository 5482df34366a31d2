// SPDX-License-Identifier: BSD-3-Clause
// Two servers on one store. One writes a map; the other answers reads and watches of it from a copy.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "tests/integration/member_store.h"
#include "tests/integration/test_server.h"
#include "tests/integration/watcher.h"

namespace dhpmap::testing {
namespace {

class EventualReads : public ::testing::Test {
 protected:
  EventualReads() {
    const OpenMapOptions options{.publish = {.frames = 1}, .commit = {.frames = 1, .delay_s = 0}};
    owner = std::make_unique<TestServer>(owners_way, options);
    EXPECT_OK(owner->Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(Feed(*owner, "room", 0, 4));
    reader = std::make_unique<TestServer>(readers_way, options);
  }

  template <typename Request>
  static Request Eventual(const std::string& resource) {
    auto request = About<Request>(resource);
    request.set_consistency(v1::Consistency::EVENTUAL);
    return request;
  }
  /// A server's answer, or the reason of its error.
  template <typename Stub, typename Request, typename Response>
  static std::string Tell(TestServer& server, Client::Unary<Stub, Request, Response> method, const Request& request) {
    const auto answer = server.Call(method, request);
    return answer.ok() ? answer->SerializeAsString() : "refused: " + answer.reason();
  }
  template <typename Stub, typename Request, typename Response>
  static std::string Tell(TestServer& server, Client::Streaming<Stub, Request, Response> method,
                          const Request& request) {
    const auto answer = server.Call(method, request);
    std::string told;
    for (const Response& message : *answer) told += message.SerializeAsString();
    return answer.ok() ? told : "refused: " + answer.reason();
  }

  using Reading = std::function<std::string(TestServer&)>;
  /// Every way to read a map, except statistics, which depend on the disk.
  static std::map<std::string, Reading> Readings() {
    const auto of = []<typename Stub, typename Request, typename Response>(
                        Client::Unary<Stub, Request, Response> method, const Request& request) -> Reading {
      return [=](TestServer& server) { return Tell(server, method, request); };
    };
    const auto all_of = []<typename Stub, typename Request, typename Response>(
                            Client::Streaming<Stub, Request, Response> method, const Request& request) -> Reading {
      return [=](TestServer& server) { return Tell(server, method, request); };
    };
    const std::string map = "maps/room", object = "maps/room/submaps/2";
    auto points = TestQuery("room");
    points.set_consistency(v1::Consistency::EVENTUAL);
    auto distances = Eventual<v1::QueryDistancesRequest>(map);
    for (int i = 0; i < 30; ++i) distances.add_packed_points_m(-0.9F + 0.13F * static_cast<float>(i));
    auto rays = Eventual<v1::CastRaysRequest>(map);
    for (const float value : {0.5F, 0.5F, 2.0F}) rays.add_packed_origins_m(value);
    for (const float value : {0.0F, 0.0F, -1.0F}) rays.add_packed_directions(value);
    auto bodies = Eventual<v1::CheckCollisionsRequest>(map);
    for (const float value : {0.0F, 0.0F, 1.0F, 0.3F}) bodies.add_packed_spheres_m(value);
    auto slice = Eventual<v1::QueryOccupancySliceRequest>(map);
    slice.set_max_z_m(1);
    auto grid = Eventual<v1::QueryDistanceGridRequest>(map);
    grid.mutable_box()->mutable_max_m()->set_x(1);
    grid.mutable_box()->mutable_max_m()->set_y(1);
    grid.mutable_box()->mutable_max_m()->set_z(1);
    grid.set_resolution_m(0.25);
    return {{"ListSubmaps", of(&SubmapStub::ListSubmaps, Eventual<v1::ListSubmapsRequest>(map))},
            {"GetSubmap", of(&SubmapStub::GetSubmap, Eventual<v1::GetSubmapRequest>(object))},
            {"Voxels", all_of(&SubmapStub::StreamSubmapVoxels, Eventual<v1::StreamSubmapVoxelsRequest>(object))},
            {"Mesh", all_of(&SubmapStub::GetSubmapMesh, Eventual<v1::GetSubmapMeshRequest>(map))},
            {"GetMap", of(&MapStub::GetMap, Eventual<v1::GetMapRequest>(map))},
            {"Regions", of(&EditStub::ListIgnoredRegions, Eventual<v1::ListIgnoredRegionsRequest>(map))},
            {"Points", of(&QueryStub::QueryPoints, points)},
            {"Distances", of(&QueryStub::QueryDistances, distances)},
            {"Rays", of(&QueryStub::CastRays, rays)},
            {"Collisions", of(&QueryStub::CheckCollisions, bodies)},
            {"Slice", of(&QueryStub::QueryOccupancySlice, slice)},
            {"Grid", all_of(&QueryStub::QueryDistanceGrid, grid)},
            {"Search", of(&QueryStub::SearchSubmaps, Eventual<v1::SearchSubmapsRequest>(map))},
            {"Relations", of(&QueryStub::QueryRelations, Eventual<v1::QueryRelationsRequest>(map))}};
  }

  /// Makes an edit at the owner; returns the map's new revision.
  std::int64_t Rename(const std::string& name) {
    v1::ApplyEditsRequest request;
    request.set_map("maps/room");
    v1::Edit& edit = *request.add_edits();
    edit.set_submap("maps/room/submaps/1");
    edit.mutable_rename()->set_display_name(name);
    return owner->Call(&EditStub::ApplyEdits, request).value().revision();
  }
  static v1::QueryPointsRequest PointsFrom(std::int64_t min_revision) {
    v1::QueryPointsRequest request = TestQuery("room");
    request.set_consistency(v1::Consistency::EVENTUAL);
    request.mutable_options()->set_min_revision(min_revision);
    return request;
  }

  std::unique_ptr<MapStore> shared = MakeMemoryStore();
  ReadersFleet fleet;
  MemberStore owners_way{*shared, nullptr, &fleet}, readers_way{*shared, &fleet, nullptr};
  std::unique_ptr<TestServer> owner, reader;
};

TEST_F(EventualReads, OfAnotherServersMapEqualItsOwnersAnswers) {
  for (int step = 0; step < 3; ++step) {
    const std::int64_t revision = Rename("lamp " + std::to_string(step));
    EXPECT_EQ(reader->Call(&QueryStub::QueryPoints, PointsFrom(revision)).value().revision(), revision);
    for (const auto& [name, read] : Readings()) {
      const std::string told = read(*reader);
      EXPECT_EQ(told, read(*owner)) << name;
      EXPECT_FALSE(told.empty() || told.starts_with("refused")) << name << ": " << told;
    }
  }
  EXPECT_EQ(readers_way.num_taken, 0) << "reading takes no map";
}

TEST_F(EventualReads, NeverGoBackAndCatchUpWithMinRevision) {
  std::int64_t last = 0;
  for (int step = 0; step < 20; ++step) {
    const std::int64_t revision = Rename("lamp " + std::to_string(step));
    const auto now = reader->Call(&QueryStub::QueryPoints, PointsFrom(0)).value().revision();
    EXPECT_GE(now, last);
    last = reader->Call(&QueryStub::QueryPoints, PointsFrom(revision)).value().revision();
    EXPECT_EQ(last, revision);
  }
}

TEST_F(EventualReads, OfAStreamStayAtItsPinnedRevision) {
  grpc::ClientContext context;
  const auto stream = reader->queries->StreamQueries(&context);
  const auto ask = [&stream](const v1::StreamQueriesRequest& request) {
    v1::StreamQueriesResponse response;
    EXPECT_TRUE(stream->Write(request));
    EXPECT_TRUE(stream->Read(&response));
    return response;
  };
  v1::StreamQueriesRequest pin, query;
  *pin.mutable_pin() = Eventual<v1::PinRequest>("maps/room");
  const std::int64_t pinned = ask(pin).pin().revision();
  EXPECT_GT(pinned, 0);
  const std::int64_t later = Rename("lamp");
  EXPECT_EQ(reader->Call(&QueryStub::QueryPoints, PointsFrom(later)).value().revision(), later);
  *query.mutable_query_points() = PointsFrom(0);
  EXPECT_EQ(ask(query).query_points().revision(), pinned);
  query.mutable_query_points()->clear_consistency();
  EXPECT_EQ(ask(query).query_points().revision(), pinned);
  EXPECT_TRUE(stream->WritesDone());
  EXPECT_OK(stream->Finish());
}

TEST_F(EventualReads, OfAMissingMapAreNotFound) {
  const auto answer = reader->Call(&SubmapStub::ListSubmaps, Eventual<v1::ListSubmapsRequest>("maps/attic"));
  EXPECT_EQ(answer.reason(), "MAP_NOT_FOUND");
}

TEST_F(EventualReads, OfASingleServerAreThePresentState) {
  const std::int64_t revision = Rename("lamp");
  EXPECT_EQ(owner->Call(&QueryStub::QueryPoints, PointsFrom(0)).value().revision(), revision);
}

TEST_F(EventualReads, AWatchOfAnotherServersMapReceivesItsCommits) {
  Watcher watcher(*reader, "room", 0);
  v1::WatchMapResponse message;
  ASSERT_TRUE(watcher.Read(message)) << "where it begins";
  for (int step = 0; step < 3; ++step) {
    const std::int64_t revision = Rename("lamp " + std::to_string(step));
    do {
      ASSERT_TRUE(watcher.Read(message));
    } while (!message.has_change());
    EXPECT_EQ(message.change().last_revision(), revision);
    ASSERT_EQ(message.change().submaps_size(), 1);
    EXPECT_EQ(message.change().submaps(0).submap().display_name(), "lamp " + std::to_string(step));
  }
}

}  // namespace
}  // namespace dhpmap::testing
