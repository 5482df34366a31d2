// SPDX-License-Identifier: BSD-3-Clause
// Feeding by the C++ client: a real server, and one that loses connections by a script.
#include <algorithm>
#include <atomic>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/unit/clients/cpp/client_room.h"
#include "tests/unit/clients/cpp/owned_frame.h"
#include "tests/unit/clients/cpp/scripted_server.h"

namespace dhpmap::testing {
namespace {

class ClientFeed : public ::testing::Test {
 protected:
  client::Map NewRoom() { return CreateFedRoom(connection); }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
  client::Client connection = ConnectTo(AddressOf(server));
};

TEST_F(ClientFeed, FramesBecomeAMapAndTheSessionGoesOnWhereItWas) {
  const client::Map map = NewRoom();
  const OwnedFrame first(0);
  ASSERT_OK_AND_ASSIGN(auto feed, map.Feed({.session = "robot1", .camera = first.camera}));
  for (int i = 0; i < 10; ++i) {
    const OwnedFrame owned(i);
    ASSERT_OK_AND_ASSIGN(const auto sequence, feed.Push(owned.frame));
    EXPECT_EQ(sequence, i + 1);
  }
  ASSERT_OK(feed.Close());
  EXPECT_EQ(feed.state().num_fused, 10);
  EXPECT_EQ(feed.state().stored_sequence, 10);
  EXPECT_TRUE(feed.TakeNotes().empty());
  EXPECT_EQ(feed.Push(first.frame).status().code, client::StatusCode::kInvalidArgument) << "its stamp went back";

  ASSERT_OK_AND_ASSIGN(auto again, map.Feed({.session = "robot1", .camera = first.camera}));
  const OwnedFrame last(10);
  ASSERT_OK_AND_ASSIGN(const auto sequence, again.Push(last.frame));
  EXPECT_EQ(sequence, 11);
  ASSERT_OK(again.Close());
  ASSERT_OK(map.FinishMapping());
  ASSERT_OK_AND_ASSIGN(const auto info, map.Info());
  EXPECT_EQ(info.num_frames, 11);
  EXPECT_EQ(info.title, "Room");
  ASSERT_OK_AND_ASSIGN(const auto balls, map.Find("class 1"));
  EXPECT_EQ(balls.size(), 1);
}

TEST_F(ClientFeed, AScanIsFused) {
  const client::Map map = NewRoom();
  ASSERT_OK_AND_ASSIGN(auto feed, map.Feed({.session = "lidar"}));
  std::vector<float> points_m;
  for (int i = 0; i < 3000; ++i) {
    const float x = static_cast<float>(i % 60) * 0.03F - 0.9F, y = static_cast<float>(i / 60) * 0.03F - 0.75F;
    points_m.insert(points_m.end(), {x, y, -1.0F});
  }
  const std::vector<std::uint32_t> ids(1000 * 3, 5);
  const std::vector<client::Segment> segments{{5, 3, {}}};
  ASSERT_OK(feed.Push(client::LidarFrame{points_m, ids, segments, {}, client::PoseAt({0, 0, 1}), 1}));
  ASSERT_OK(feed.Close());
  EXPECT_EQ(feed.state().num_fused, 1);
  ASSERT_OK_AND_ASSIGN(const auto floors, map.Find("class 3"));
  EXPECT_EQ(floors.size(), 1);
}

TEST_F(ClientFeed, MistakesAreToldBeforeTheyAreSent) {
  const client::Map map = NewRoom();
  const OwnedFrame owned(0);
  ASSERT_OK_AND_ASSIGN(auto feed, map.Feed({.session = "robot1", .camera = owned.camera}));
  const auto field_of = [&](const client::RgbdFrame& frame) {
    const client::Status status = feed.Push(frame).status();
    EXPECT_EQ(status.code, client::StatusCode::kInvalidArgument);
    return status.violations.empty() ? "" : status.violations[0].field;
  };
  client::RgbdFrame frame = owned.frame;
  frame.depth_m = frame.depth_m.first(100);
  EXPECT_EQ(field_of(frame), "depth_m");
  frame = owned.frame;
  frame.T_map_camera.rotation_xyzw = {0, 0, 0, 0};
  EXPECT_EQ(field_of(frame), "T_map_camera");
  std::vector<float> millimetres(owned.depth_m);
  for (float& depth : millimetres) depth *= 1000;
  frame = owned.frame;
  frame.depth_m = millimetres;
  EXPECT_EQ(field_of(frame), "depth_m");
  EXPECT_EQ(feed.state().num_sent, 0);
  ASSERT_OK(feed.Close());
  EXPECT_EQ(map.Feed({}).status().code, client::StatusCode::kInvalidArgument);
  EXPECT_EQ(connection.OpenMap("fed")->Feed({.session = "bad name!"}).status().reason, "BAD_SESSION");
}

/// Loses its first stream after it has taken five frames, of which it has stored three; takes all of the second.
class LosingServer final : public v1::MappingService::Service {
 public:
  std::vector<std::int64_t> first, second;

 private:
  using Stream = grpc::ServerReaderWriter<v1::IntegrateFramesResponse, v1::IntegrateFramesRequest>;

  grpc::Status IntegrateFrames(grpc::ServerContext*, Stream* stream) override {
    std::vector<std::int64_t>& taken = first.empty() ? first : second;
    const bool is_first = first.empty();
    v1::IntegrateFramesRequest request;
    v1::IntegrateFramesResponse response;
    if (!stream->Read(&request)) return grpc::Status::OK;
    if (!is_first) response.set_committed_sequence(3);
    stream->Write(response);
    while (stream->Read(&request)) {
      taken.push_back(request.sequence());
      response.set_sequence(request.sequence());
      response.set_outcome(v1::IntegrateFramesResponse::FUSED);
      if (is_first) response.set_committed_sequence(std::min<std::int64_t>(request.sequence(), 3));
      stream->Write(response);
      if (is_first && taken.size() == 5) return {grpc::StatusCode::UNAVAILABLE, "lost"};
    }
    response = {};
    response.set_committed_sequence(taken.empty() ? 3 : taken.back());
    stream->Write(response);
    return grpc::Status::OK;
  }
  grpc::Status ListSessions(grpc::ServerContext*, const v1::ListSessionsRequest*, v1::ListSessionsResponse*) override {
    return grpc::Status::OK;
  }
};

/// OpenMap asks for it.
class AnyMap final : public v1::MapService::Service {
  grpc::Status GetMap(grpc::ServerContext*, const v1::GetMapRequest*, v1::GetMapResponse*) override {
    return grpc::Status::OK;
  }
};

TEST_F(ClientFeed, WhatALostServerHadNotStoredComesAgainAndNothingElse) {
  LosingServer losing;
  AnyMap maps;
  const ScriptedServer<LosingServer, AnyMap> scripted(losing, maps);
  const client::Map map = *ConnectTo(scripted.address()).OpenMap("room");
  const OwnedFrame first(0);
  ASSERT_OK_AND_ASSIGN(auto feed, map.Feed({.session = "robot1", .camera = first.camera}));
  for (int i = 0; i < 12; ++i) {
    const OwnedFrame owned(i);
    ASSERT_OK(feed.Push(owned.frame));
  }
  ASSERT_OK(feed.Close());
  EXPECT_EQ(losing.first, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(losing.second, (std::vector<std::int64_t>{4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(feed.state().stored_sequence, 12);
}

/// Greets, and says nothing of any frame.
class SilentServer final : public v1::MappingService::Service {
 public:
  std::atomic<int> num_taken = 0;

 private:
  grpc::Status IntegrateFrames(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::IntegrateFramesResponse, v1::IntegrateFramesRequest>* stream) override {
    v1::IntegrateFramesRequest request;
    stream->Read(&request);
    stream->Write({});
    while (stream->Read(&request)) ++num_taken;
    return grpc::Status::OK;
  }
  grpc::Status ListSessions(grpc::ServerContext*, const v1::ListSessionsRequest*, v1::ListSessionsResponse*) override {
    return grpc::Status::OK;
  }
};

TEST_F(ClientFeed, NoMoreThanEightFramesAreOnTheirWay) {
  SilentServer silent;
  AnyMap maps;
  const ScriptedServer<SilentServer, AnyMap> scripted(silent, maps);
  const client::Map map = *ConnectTo(scripted.address()).OpenMap("room");
  const OwnedFrame first(0);
  ASSERT_OK_AND_ASSIGN(auto feed, map.Feed({.session = "robot1", .camera = first.camera, .deadline_s = 0.2}));
  int num_pushed = 0;
  client::Status status;
  for (; num_pushed < 20 && status.ok(); ++num_pushed) {
    const OwnedFrame owned(num_pushed);
    status = feed.Push(owned.frame).status();
  }
  EXPECT_EQ(status.code, client::StatusCode::kDeadlineExceeded);
  EXPECT_EQ(num_pushed, 9);
  EXPECT_LE(silent.num_taken, 8);
}  // and its end waits for nobody

}  // namespace
}  // namespace dhpmap::testing
