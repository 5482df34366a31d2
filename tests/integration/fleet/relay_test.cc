// SPDX-License-Identifier: BSD-3-Clause
// Calls about a map that another server owns are relayed to it, and look the same.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "proto/types/metadata_keys.h"
#include "tests/integration/fleet/fleet_of_two.h"

namespace dhpmap::testing {
namespace {

TEST_F(FleetOfTwo, AnyServerAnswersAUnaryCall) {
  const auto here = owner.server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
  const auto there = other.server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
  EXPECT_EQ(here.SerializeAsString(), there.SerializeAsString());
  EXPECT_EQ(num_relayed, 1);
  EXPECT_EQ(other.fleet.num_asked(), 1) << "the owner was not known";
  ASSERT_OK(other.server.Call(&MapStub::GetMap, "maps/room"));
  EXPECT_EQ(other.fleet.num_asked(), 1) << "now it is";
}

TEST_F(FleetOfTwo, AnyServerStreamsAnAnswer) {
  v1::ListSubmapsRequest list;
  list.set_parent("maps/room");
  const auto submaps = owner.server.Call(&SubmapStub::ListSubmaps, list).value();
  ASSERT_GT(submaps.submaps_size(), 0);
  v1::GetSubmapMeshRequest request;
  request.set_name(submaps.submaps(submaps.submaps_size() - 1).name());
  const auto here = owner.server.Call(&SubmapStub::GetSubmapMesh, request).value();
  const auto there = other.server.Call(&SubmapStub::GetSubmapMesh, request).value();
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_EQ(here[i].SerializeAsString(), there[i].SerializeAsString());
}

TEST_F(FleetOfTwo, FramesGoThroughAnyServer) {
  const auto before = owner.server.Call(&MapStub::GetMap, "maps/room").value().map().num_frames();
  const FeedResult fed = Feed(other.server, "room", 3, 9);
  EXPECT_OK(fed.status);
  EXPECT_EQ(fed.acks.size(), 6u);
  EXPECT_EQ(owner.server.Call(&MapStub::GetMap, "maps/room").value().map().num_frames(), before + 6);
}

TEST_F(FleetOfTwo, AStreamOfQueriesIsRelayed) {
  grpc::ClientContext context;
  const auto stream = other.server.queries->StreamQueries(&context);
  for (int i = 1; i <= 5; ++i) {
    v1::StreamQueriesRequest request;
    request.set_sequence(i);
    *request.mutable_query_points() = TestQuery("room");
    ASSERT_TRUE(stream->Write(request));
    v1::StreamQueriesResponse response;
    ASSERT_TRUE(stream->Read(&response));
    EXPECT_EQ(response.sequence(), i);
    EXPECT_GT(response.query_points().packed().tsdf_m_size() + response.query_points().results_size(), 0);
  }
  stream->WritesDone();
  v1::StreamQueriesResponse none;
  EXPECT_FALSE(stream->Read(&none));
  EXPECT_OK(stream->Finish());
}

TEST_F(FleetOfTwo, AnswersOfEveryServerNameTheOwner) {
  for (FleetMember* asked : {&owner, &other}) {
    (void)owner.fleet.OwnerOf("room");
    grpc::ClientContext context;
    v1::GetMapRequest request;
    request.set_name("maps/room");
    v1::GetMapResponse response;
    ASSERT_OK(asked->server.maps->GetMap(&context, request, &response));
    EXPECT_EQ(HeadOf(context, kOwnerKey), owner.address() + " 1");
  }
}

TEST_F(FleetOfTwo, RelayedErrorsKeepTheirDetails) {
  const auto here = owner.server.Call(&SubmapStub::GetSubmap, "maps/room/submaps/99999");
  const auto there = other.server.Call(&SubmapStub::GetSubmap, "maps/room/submaps/99999");
  EXPECT_EQ(there.code(), grpc::NOT_FOUND);
  EXPECT_EQ(there.reason(), "SUBMAP_NOT_FOUND");
  EXPECT_EQ(there.status().error_details(), here.status().error_details());
}

TEST_F(FleetOfTwo, AMissingMapIsNotFoundWithoutARelay) {
  const auto answer = other.server.Call(&MapStub::GetMap, "maps/none");
  EXPECT_EQ(answer.reason(), "MAP_NOT_FOUND");
  EXPECT_EQ(num_relayed, 0);
}

TEST_F(FleetOfTwo, ADeadOwnerIsUnreachable) {
  ASSERT_OK(other.server.Call(&MapStub::GetMap, "maps/room"));
  ASSERT_OK(owner.server.Stop());
  const auto answer = other.server.Call(&MapStub::GetMap, "maps/room");
  EXPECT_EQ(answer.code(), grpc::UNAVAILABLE);
  EXPECT_EQ(answer.reason(), "OWNER_UNREACHABLE");
}

TEST_F(FleetOfTwo, ADeadlineReachesTheOwner) {
  // A query waits at the owner for a revision that never comes. It ends there when the call ends here.
  v1::QueryPointsRequest request = TestQuery("room");
  request.mutable_options()->set_min_revision(1'000'000);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(200));
  v1::QueryPointsResponse response;
  EXPECT_EQ(other.server.queries->QueryPoints(&context, request, &response).error_code(), grpc::DEADLINE_EXCEEDED);
}

TEST_F(FleetOfTwo, AChangedOwnerIsLookedUpOnceMore) {
  ASSERT_OK(other.server.Call(&MapStub::GetMap, "maps/room"));  // `other` now knows `owner`
  FleetMember third{room};
  ASSERT_OK(third.server.Call(&MapStub::CreateMap, CreateRequest("room")));
  room->AddMap("room", third.fleet.me());
  (void)owner.fleet.OwnerOf("room");  // `owner` knows of the change, `other` does not
  const int asked = other.fleet.num_asked();
  const auto map = other.server.Call(&MapStub::GetMap, "maps/room");
  ASSERT_OK(map);
  EXPECT_EQ(other.fleet.num_asked(), asked + 1);
  EXPECT_EQ(map->revision(), third.server.Call(&MapStub::GetMap, "maps/room")->revision());
}

TEST_F(FleetOfTwo, AFormerOwnerLooksUpTheNewOne) {
  ASSERT_OK(owner.server.Call(&MapStub::GetMap, "maps/room"));
  ASSERT_OK(other.server.Call(&MapStub::CreateMap, CreateRequest("room")));
  (void)other.fleet.OwnerOf("room");  // `other` knows `owner`, and then gets the map
  room->AddMap("room", other.fleet.me());
  owner.fleet.Forget("room");
  const auto map = owner.server.Call(&MapStub::GetMap, "maps/room");
  ASSERT_OK(map);
  EXPECT_EQ(map->map().num_frames(), 0) << "of the other one's store";
  EXPECT_TRUE(other.fleet.KnownOwner("room")->is_me);
}

TEST_F(FleetOfTwo, ACallIsRelayedAtMostOnce) {
  (void)other.fleet.OwnerOf("room");
  grpc::ClientContext context;
  context.AddMetadata(kRelayedKey, kPassedOn);
  v1::GetMapRequest request;
  request.set_name("maps/room");
  v1::GetMapResponse response;
  const grpc::Status status = other.server.maps->GetMap(&context, request, &response);
  EXPECT_EQ(ReasonOf(status), "NOT_OWNER");
  EXPECT_EQ(num_relayed, 0);
}

TEST_F(FleetOfTwo, RelayedBytesCountInTheBudget) {
  const auto budget = std::make_shared<ByteBudget>(300u << 10, 1u << 10);
  FleetMember small{room, {.inflight = budget}};
  const v1::QueryPointsRequest request = TestQuery("room");
  ASSERT_LT(request.ByteSizeLong(), budget->limit_bytes());
  ASSERT_GT(owner.server.Call(&QueryStub::QueryPoints, request)->ByteSizeLong(), budget->limit_bytes());
  EXPECT_EQ(small.server.Call(&QueryStub::QueryPoints, request).reason(), "TOO_MANY_BYTES");
  EXPECT_TRUE(Eventually([&] { return budget->used_bytes() == 0; })) << "and is given back";
  EXPECT_OK(small.server.Call(&MapStub::GetMap, "maps/room"));
}

TEST_F(FleetOfTwo, AnOwnerWithoutHeartbeatsRefuses) {
  (void)owner.fleet.OwnerOf("room");
  owner.fleet.SetMayAnswer(false);
  EXPECT_EQ(owner.server.Call(&MapStub::GetMap, "maps/room").reason(), "DATABASE_UNREACHABLE");
  EXPECT_EQ(other.server.Call(&MapStub::GetMap, "maps/room").reason(), "DATABASE_UNREACHABLE");
  owner.fleet.SetMayAnswer(true);
  EXPECT_OK(other.server.Call(&MapStub::GetMap, "maps/room"));
}

TEST_F(FleetOfTwo, AMapWithoutAnOwnerIsTakenByTheCalledServer) {
  ASSERT_OK(other.server.Call(&MapStub::CreateMap, CreateRequest("hall")));
  room->AddMap("hall", 0);
  EXPECT_OK(Feed(other.server, "hall", 0, 2).status) << "through the process, as the owner was not known";
  EXPECT_TRUE(other.fleet.KnownOwner("hall")->is_me);
  EXPECT_EQ(num_relayed, 0);
  EXPECT_OK(owner.server.Call(&MapStub::GetMap, "maps/hall"));
}

}  // namespace
}  // namespace dhpmap::testing
