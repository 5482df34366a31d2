// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "storage/sqlite_store.h"
#include "tests/integration/test_server.h"
#include "tests/integration/test_store.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

constexpr int kWalkFrames = 24;

v1::QueryPointsResponse Query(TestServer& server, const std::string& map_id) {
  return server.Call(&QueryStub::QueryPoints, TestQuery(map_id)).value();
}

v1::ListSubmapsResponse SubmapsOf(TestServer& server, const std::string& map_id) {
  return server.Call(&SubmapStub::ListSubmaps, "maps/" + map_id).value();
}

void CreateMapNamed(TestServer& server, const std::string& map_id) {
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest(map_id)));
}

v1::FinishMappingResponse Finish(TestServer& server, const std::string& map_id) {
  return server.Call(&MappingStub::FinishMapping, "maps/" + map_id).value();
}

v1::PointResult QueryOne(TestServer& server, const std::string& map_id, double x, double y, double z) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map_id);
  v1::Vector3* p = request.add_points_m();
  p->set_x(x);
  p->set_y(y);
  p->set_z(z);
  const auto response = server.Call(&QueryStub::QueryPoints, request).value();
  return response.results_size() == 1 ? response.results(0) : v1::PointResult{};
}

TEST(Mapping, EveryFrameIsAcknowledgedInOrderAndFusedWhenTheStreamEnds) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  const FeedResult fed = Feed(server, "room", 0, kWalkFrames);
  ASSERT_OK(fed);
  ASSERT_EQ(fed.acks.size(), static_cast<std::size_t>(kWalkFrames));
  for (int i = 0; i < kWalkFrames; ++i) {
    const auto& ack = fed.acks[static_cast<std::size_t>(i)];
    EXPECT_EQ(ack.sequence(), i);
    EXPECT_EQ(ack.error().code(), 0) << ack.error().message();
    EXPECT_GT(ack.num_points(), 1000);
  }
  EXPECT_EQ(store->GetMap("room")->info.num_frames, kWalkFrames);
  const auto submaps = SubmapsOf(server, "room");
  ASSERT_EQ(submaps.submaps_size(), 4) << submaps.DebugString();  // unknown, ball, box, floor
  std::multiset<std::string> names;
  for (const auto& submap : submaps.submaps()) names.insert(submap.class_name());
  EXPECT_EQ(names, (std::multiset<std::string>{"", "thing1", "thing2", "stuff3"}));
}

TEST(Mapping, PointsOnObjectsHaveTheirClass) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  ASSERT_OK(Feed(server, "room", 0, kWalkFrames));
  const v1::PointResult ball = QueryOne(server, "room", 0, 0, 0.81);
  EXPECT_TRUE(ball.near_surface());
  EXPECT_EQ(ball.class_name(), "thing1");
  EXPECT_EQ(ball.kind(), v1::LabelClass::THING);
  EXPECT_EQ(QueryOne(server, "room", 1.2, 0.3, 0.61).class_name(), "thing2");
  EXPECT_EQ(QueryOne(server, "room", 0.6, -0.7, 0.01).class_name(), "stuff3");
  EXPECT_FALSE(QueryOne(server, "room", 0, 0, 30).near_surface());
  EXPECT_FALSE(QueryOne(server, "room", 1e30, -1e30, 1e300).near_surface());
}

TEST(Mapping, ARestartOnTheSameFileGivesTheSameAnswers) {
  const TempDir dir;
  const std::string path = (dir.path() / "maps.db").string();
  v1::QueryPointsResponse before;
  v1::ListSubmapsResponse submaps_before;
  {
    const auto store = OpenSqliteStore(path);
    ASSERT_OK(store);
    TestServer server(**store);
    CreateMapNamed(server, "room");
    ASSERT_OK(Feed(server, "room", 0, kWalkFrames));
    Finish(server, "room");
    before = Query(server, "room");
    submaps_before = SubmapsOf(server, "room");
    ASSERT_OK(server.Stop());
  }
  const auto store = OpenSqliteStore(path);
  ASSERT_OK(store);
  TestServer server(**store);
  const auto after = Query(server, "room");
  const auto submaps_after = SubmapsOf(server, "room");
  EXPECT_EQ(submaps_after.SerializeAsString(), submaps_before.SerializeAsString());
  EXPECT_EQ(after.revision(), before.revision());
  const auto& a = after.packed();
  const auto& b = before.packed();
  ASSERT_EQ(a.near_surface_size(), b.near_surface_size());
  int num_observed = 0, num_free = 0;
  for (int i = 0; i < a.near_surface_size(); ++i) {
    num_observed += a.near_surface(i) ? 1 : 0;
    num_free += a.free(i) ? 1 : 0;
    ASSERT_EQ(a.near_surface(i), b.near_surface(i));
    ASSERT_EQ(a.free(i), b.free(i));
    ASSERT_EQ(a.instance_id(i), b.instance_id(i));
    ASSERT_EQ(a.class_id(i), b.class_id(i));
    if (a.near_surface(i)) ASSERT_NEAR(a.tsdf_m(i), b.tsdf_m(i), 0.1 / 4096 + 1e-7);
    else ASSERT_TRUE(std::isnan(a.tsdf_m(i)) && std::isnan(b.tsdf_m(i)));
  }
  EXPECT_GT(num_observed, 500);
  EXPECT_GT(num_free, 50);
}

TEST(Mapping, ContinuesAfterARestartAsIfThereHadBeenNone) {
  const TempDir dir;
  const std::string path = (dir.path() / "maps.db").string();
  const auto whole_store = MakeTestStore();
  TestServer whole(*whole_store);
  CreateMapNamed(whole, "room");
  ASSERT_OK(Feed(whole, "room", 0, kWalkFrames));
  {
    const auto store = OpenSqliteStore(path);
    TestServer server(**store);
    CreateMapNamed(server, "room");
    ASSERT_OK(Feed(server, "room", 0, kWalkFrames / 2));
  }
  const auto store = OpenSqliteStore(path);
  TestServer server(**store);
  ASSERT_OK(Feed(server, "room", kWalkFrames / 2, kWalkFrames));
  const auto a = SubmapsOf(server, "room"), b = SubmapsOf(whole, "room");
  ASSERT_EQ(a.submaps_size(), b.submaps_size());
  for (int i = 0; i < a.submaps_size(); ++i) {
    EXPECT_EQ(a.submaps(i).class_id(), b.submaps(i).class_id());
    EXPECT_EQ(a.submaps(i).num_blocks(), b.submaps(i).num_blocks());
    EXPECT_EQ(a.submaps(i).num_frames_observed(), b.submaps(i).num_frames_observed());
  }
}

TEST(Mapping, ABadFrameIsRefusedInItsAcknowledgementAndChangesNothing) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  grpc::ClientContext context;
  const auto stream = server.mapping->IntegrateFrames(&context);
  std::vector<v1::Frame> frames;
  frames.push_back(TestFrame(0));
  frames.push_back(TestFrame(1));
  frames.back().set_map_from_sensor_matrix(3, std::nan(""));
  frames.push_back(TestFrame(1));
  frames.back().mutable_depth_camera()->mutable_depth()->mutable_data()->pop_back();
  frames.push_back(TestFrame(1));
  frames.back().mutable_segments()->RemoveLast();  // pixels of the floor have no table row
  frames.push_back(TestFrame(1));
  frames.back().mutable_segments(0)->set_class_id(77);
  frames.emplace_back();  // an empty frame
  frames.push_back(TestFrame(1));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    request.set_sequence(static_cast<std::int64_t>(i));
    *request.mutable_frame() = frames[i];
    ASSERT_TRUE(stream->Write(request));
    v1::IntegrateFramesResponse ack;
    ASSERT_TRUE(stream->Read(&ack));
    EXPECT_EQ(ack.sequence(), static_cast<std::int64_t>(i));
    const bool is_good = i == 0 || i + 1 == frames.size();
    EXPECT_EQ(ack.error().code(), is_good ? 0 : 3) << i << ": " << ack.error().message();
    EXPECT_EQ(ack.error().message().empty(), is_good);
  }
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 2);
}

TEST(Mapping, OneFrameInFlightAndTheInProcessChannelAreEnough) {
  const auto store = MakeTestStore();
  TestServer server(*store, {}, {.num_threads = 1, .max_frames_in_flight = 1});
  CreateMapNamed(server, "room");
  const auto mapping = v1::MappingService::NewStub(server.grpc().InProcessChannel());
  const FeedResult fed = Feed(*mapping, "room", 0, 8);
  EXPECT_OK(fed);
  EXPECT_EQ(fed.acks.size(), 8u);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 8);
}

TEST(Mapping, AClientThatReadsNoAcknowledgementsLosesNothing) {
  const auto store = MakeTestStore();
  TestServer server(*store, {}, {.max_frames_in_flight = 2});
  CreateMapNamed(server, "room");
  grpc::ClientContext context;
  const auto stream = server.mapping->IntegrateFrames(&context);
  for (int i = 0; i < 20; ++i) {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    *request.mutable_frame() = TestFrame(i);
    ASSERT_TRUE(stream->Write(request));
  }
  stream->WritesDone();
  int num_acks = 0;
  v1::IntegrateFramesResponse ack;
  while (stream->Read(&ack)) ++num_acks;
  EXPECT_EQ(num_acks, 20);
  EXPECT_OK(stream->Finish());
}

TEST(Mapping, OneStreamFeedsOneMap) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  CreateMapNamed(server, "hall");
  grpc::ClientContext context;
  const auto stream = server.mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest request;
  for (const char* map : {"maps/room", "", "maps/hall"}) {
    request.set_map(map);
    *request.mutable_frame() = TestFrame(0);
    stream->Write(request);
  }
  int num_acks = 0;
  v1::IntegrateFramesResponse ack;
  while (stream->Read(&ack)) ++num_acks;
  EXPECT_EQ(num_acks, 2);
  EXPECT_EQ(stream->Finish().error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 2);  // acknowledged frames are stored nevertheless
}

TEST(Mapping, ASecondStreamIntoTheSameMapIsAborted) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  grpc::ClientContext context;
  const auto first = server.mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest request;
  request.set_map("maps/room");
  *request.mutable_frame() = TestFrame(0);
  ASSERT_TRUE(first->Write(request));
  v1::IntegrateFramesResponse ack;
  ASSERT_TRUE(first->Read(&ack));
  EXPECT_EQ(Feed(server, "room", 0, 1).status.error_code(), grpc::ABORTED);

  EXPECT_EQ(server.Call(&MapStub::DeleteMap, "maps/room").code(), grpc::FAILED_PRECONDITION);

  first->WritesDone();
  EXPECT_OK(first->Finish());
  EXPECT_OK(Feed(server, "room", 1, 2));
  EXPECT_OK(server.Call(&MapStub::DeleteMap, "maps/room"));
  EXPECT_EQ(Feed(server, "room", 2, 3).status.error_code(), grpc::NOT_FOUND);
}

TEST(Mapping, ADisconnectedFeederLeavesTheMapFreeForOthers) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  {
    grpc::ClientContext context;
    const auto stream = server.mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    for (int i = 0; i < 3; ++i) {
      *request.mutable_frame() = TestFrame(i);
      ASSERT_TRUE(stream->Write(request));
    }
    v1::IntegrateFramesResponse ack;
    ASSERT_TRUE(stream->Read(&ack));
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::CANCELLED);
  }
  grpc::StatusCode code = grpc::ABORTED;
  EXPECT_TRUE(Eventually([&] {
    code = Feed(server, "room", 3, 4).status.error_code();
    return code != grpc::ABORTED;
  }));
  EXPECT_EQ(code, grpc::OK);
}

TEST(Mapping, ShutdownEndsAnOpenStreamAfterStoringWhatItAcknowledged) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMapNamed(server, "room");
  grpc::ClientContext context;
  const auto stream = server.mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest request;
  request.set_map("maps/room");
  *request.mutable_frame() = TestFrame(0);
  ASSERT_TRUE(stream->Write(request));
  v1::IntegrateFramesResponse ack;
  ASSERT_TRUE(stream->Read(&ack));
  EXPECT_OK(server.Stop());
  EXPECT_FALSE(stream->Read(&ack));
  EXPECT_EQ(stream->Finish().error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1);
}

}  // namespace
}  // namespace dhpmap::testing
