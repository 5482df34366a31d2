// SPDX-License-Identifier: BSD-3-Clause
// A server that gets SIGTERM while it fuses for long keeps its grace, and what it has acknowledged.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <string>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "tests/e2e/rest_fixture.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/support/wire_frame.h"

namespace dhpmap::testing {
namespace {

/// A wall, in voxels so small that fusing it takes long. Without colour, and ids of one byte: many wait in memory.
v1::IntegrateFramesRequest WallAt(int sequence) {
  constexpr std::size_t kNumPixels = std::size_t{640} * 480;
  constexpr std::uint32_t kWall = 1, kStuffClass = 3;
  PanopticFrame frame;
  const double y_m = 1e-4 * sequence;
  frame.T_map_sensor = LookAt({0, y_m, 1}, {1, y_m, 1});
  frame.camera.emplace().camera = {640, 480, 640, 640, 320, 240};
  frame.camera->depth_m.assign(kNumPixels, 1.0f);
  v1::IntegrateFramesRequest request;
  request.set_sequence(sequence);
  *request.mutable_frame() = ToWire(frame);
  request.mutable_frame()->set_stamp_ns(sequence);
  v1::DepthCameraFrame& camera = *request.mutable_frame()->mutable_depth_camera();
  camera.clear_color();
  camera.mutable_segments()->set_encoding(v1::Image::RAW_U8);
  camera.mutable_segments()->set_data(std::string(kNumPixels, static_cast<char>(kWall)));
  v1::Segment& wall = *request.mutable_frame()->add_segments();
  wall.set_id(kWall);
  wall.set_class_id(kStuffClass);
  wall.set_score(0.9f);
  return request;
}

class ShutdownGrace : public RestTest {
 protected:
  static constexpr double kGrace_s = 0.1;
  static constexpr int kNumWaiting = 250;  ///< takes many times as long to fuse, on whatever machine

  void SetUp() override {
    Start({{"DHPMAP_SHUTDOWN_GRACE_S", std::to_string(kGrace_s)},
           {"DHPMAP_MAPPING_NUM_THREADS", "1"},
           {"DHPMAP_MAPPING_MAX_FRAMES_IN_FLIGHT", std::to_string(kNumWaiting)},
           {"DHPMAP_LIMITS_INFLIGHT_MIB", "4000"}});
    v1::CreateMapRequest request = CreateRequest("room");
    request.mutable_config()->set_voxel_size_m(0.002);
    request.mutable_config()->set_truncation_m(0.016);
    const http::HttpAnswer made = Ask("POST", "/v1/maps", JsonOf(request));
    ASSERT_EQ(made.status, 200) << made.body;
  }
};

TEST_F(ShutdownGrace, IsKeptWhileFramesAreFusedForLongAndWhatWasAcknowledgedIsThereAfterwards) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + 2 * kPatience);
  const auto stream = mapping_->IntegrateFrames(&context);
  v1::IntegrateFramesRequest first = WallAt(0);
  first.set_map("maps/room");
  first.set_session("robot");
  v1::IntegrateFramesResponse answer;
  ASSERT_TRUE(stream->Write(first));
  ASSERT_TRUE(stream->Read(&answer));
  ASSERT_EQ(answer.outcome(), v1::IntegrateFramesResponse::FUSED) << answer.error().message();

  for (int sequence = 1; sequence <= kNumWaiting; ++sequence) ASSERT_TRUE(stream->Write(WallAt(sequence)));
  server_->process().Signal(SIGTERM);
  std::int64_t last_fused = answer.sequence();
  while (stream->Read(&answer)) {
    if (answer.outcome() == v1::IntegrateFramesResponse::FUSED) last_fused = std::max(last_fused, answer.sequence());
  }
  EXPECT_FALSE(stream->Finish().ok()) << "the client had not ended it";
  const std::optional<int> exit_code = server_->process().Wait();
  EXPECT_EQ(exit_code, 0);
  EXPECT_LT(last_fused, kNumWaiting / 2) << "of those that waited";

  ASSERT_TRUE(exit_code.has_value());
  server_.emplace(root(), db());
  ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
  EXPECT_GE(Get<v1::GetMapResponse>("maps/room").map().num_frames(), last_fused + 1);
  const auto sessions = Get<v1::ListSessionsResponse>("maps/room/sessions");
  ASSERT_EQ(sessions.sessions_size(), 1);
  EXPECT_GE(sessions.sessions(0).committed_sequence(), last_fused);
}

}  // namespace
}  // namespace dhpmap::testing
