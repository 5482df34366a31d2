// SPDX-License-Identifier: BSD-3-Clause
// A server that is told to end keeps its grace, whatever it is fusing.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "mapping/pipeline/map_builder.h"
#include "server/wire/frame_conversion.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/wire_frame.h"

namespace dhpmap::testing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kFrames = 4;  // as many as a stream may have under way

double SecondsSince(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// A wall, in voxels so small that fusing it takes long.
v1::Frame HugeFrame(int i) {
  PanopticFrame frame;
  frame.stamp_ns = i;
  frame.T_map_sensor = LookAt({0, 0.01 * i, 1}, {1, 0.01 * i, 1});
  frame.camera.emplace().camera = {640, 480, 640, 640, 320, 240};
  constexpr std::size_t kPixels = std::size_t{640} * 480;
  frame.camera->depth_m.assign(kPixels, 1.0f);
  frame.camera->color.assign(kPixels, {90, 90, 90});
  frame.camera->segments.assign(kPixels, 0);
  return ToWire(frame);
}

class Shutdown : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const std::string map : {"first", "room"}) {
      grpc::ClientContext create;
      v1::CreateMapRequest request = CreateRequest(map);
      request.mutable_config()->set_voxel_size_m(0.002);
      request.mutable_config()->set_truncation_m(0.016);
      v1::CreateMapResponse created;
      ASSERT_TRUE(server_.maps->CreateMap(&create, request, &created).ok());
    }
  }

  /// Sends all frames at once, reads what comes back, and counts what was fused.
  int FeedAll(const std::string& map) {
    grpc::ClientContext context;
    const auto stream = server_.mapping->IntegrateFrames(&context);
    for (int i = 0; i < kFrames; ++i) {
      v1::IntegrateFramesRequest request;
      request.set_map("maps/" + map);
      request.set_sequence(i);
      *request.mutable_frame() = HugeFrame(i);
      if (!stream->Write(request)) break;
    }
    stream->WritesDone();
    has_sent_ = true;
    int num_fused = 0;
    v1::IntegrateFramesResponse answer;
    while (stream->Read(&answer)) {
      num_fused += answer.outcome() == v1::FUSED;
      if (!answer.error_message().empty()) last_error_ = answer.error_message();
    }
    const grpc::Status status = stream->Finish();
    if (!status.ok() && last_error_.empty()) last_error_ = status.error_message();
    return num_fused;
  }

  std::atomic<bool> has_sent_ = false;
  std::string last_error_;
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_{*store_};
};

TEST_F(Shutdown, GivesUpWhatIsBeingFusedOnceTheGraceIsOver) {
  const auto begin = Clock::now();
  ASSERT_EQ(FeedAll("first"), kFrames) << last_error_;
  const double whole_s = SecondsSince(begin);

  has_sent_ = false;
  std::jthread client([this] { FeedAll("room"); });
  ASSERT_TRUE(Eventually([&] { return has_sent_.load(); }));
  std::this_thread::sleep_for(std::chrono::duration<double>(whole_s / kFrames / 2));  // in the middle of one
  const auto told = Clock::now();
  const double grace_s = whole_s / kFrames / 4;
  server_.grpc().Shutdown(grace_s);
  EXPECT_LT(SecondsSince(told), grace_s + whole_s / 3) << kFrames << " frames take " << whole_s << " s";
  client.join();
  ASSERT_TRUE(server_.registry().Shutdown().ok());

  // What it stored are frames as a whole.
  const auto stored = store_->LoadMap("room");
  ASSERT_TRUE(stored.ok());
  const std::int64_t num_frames = (*stored)->info().num_frames;
  EXPECT_LT(num_frames, kFrames);
  MapInfo info = (*stored)->info();
  info.num_frames = 0;
  info.next_submap_id = SubmapId(1);
  MapBuilder alone(info, 1);
  for (int i = 0; i < num_frames; ++i) {
    const auto frame = FrameFromProto(HugeFrame(i));
    ASSERT_TRUE(frame.ok());
    ASSERT_TRUE(alone.Integrate(*frame).ok());
  }
  ASSERT_EQ(alone.map().submaps().size(), (*stored)->submaps().size());
  for (std::size_t s = 0; s < alone.map().submaps().size(); ++s) {
    EXPECT_EQ(alone.map().submaps()[s]->blocks().size(), (*stored)->submaps()[s]->blocks().size());
  }
}

TEST(ShutdownAtOnce, LeavesNothingRunningThatLooksForMaps) {
  for (int i = 0; i < 40; ++i) {
    const std::unique_ptr<MapStore> store = MakeMemoryStore();
    TestServer server(*store);
    grpc::ClientContext create;
    v1::CreateMapResponse created;
    ASSERT_TRUE(server.maps->CreateMap(&create, CreateRequest("room"), &created).ok());
    server.grpc().Shutdown(1e-4 * i);  // the grace ends about when all else has
  }
}

}  // namespace
}  // namespace dhpmap::testing
