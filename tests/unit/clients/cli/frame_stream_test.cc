// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_stream.h"

#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <numeric>

#include "clients/cli/frame_message.h"

namespace dhpmap {
namespace {

/// Frames 0, 1, ...; every tenth cannot be read.
class FakeDataset : public Dataset {
 public:
  const std::vector<LabelClass>& label_classes() const override { return classes_; }
  std::string preset() const override { return "indoor"; }
  bool has_persistent_ids() const override { return false; }
  std::size_t num_frames() const override { return 1000; }
  Result<DatasetFrame> Read(std::size_t index) override {
    ++num_read;
    if (index % 10 == 9) return NotFound("frame lost").WithReason("MISSING_FILE");
    DatasetFrame frame;
    frame.stamp_ns = static_cast<std::int64_t>(index);
    return frame;
  }
  std::atomic<int> num_read = 0;

 private:
  std::vector<LabelClass> classes_;
};

/// Acknowledges frames in order, but only when `max_pending` are waiting or the client has said all; fails after
/// `fail_after` frames.
class FakeMapping : public v1::MappingService::Service {
 public:
  int max_pending = 1;
  int fail_after = -1;
  std::vector<std::int64_t> stamps;
  std::string map;

  grpc::Status IntegrateFrames(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::IntegrateFramesResponse, v1::IntegrateFramesRequest>* stream) override {
    std::vector<std::int64_t> pending;
    const auto answer = [&] {
      for (std::int64_t sequence : pending) {
        v1::IntegrateFramesResponse ack;
        ack.set_sequence(sequence);
        stream->Write(ack);
      }
      pending.clear();
    };
    v1::IntegrateFramesRequest request;
    while (stream->Read(&request)) {
      if (!request.map().empty()) map += request.map();
      stamps.push_back(request.frame().stamp_ns());
      pending.push_back(request.sequence());
      if (static_cast<int>(stamps.size()) == fail_after) return {grpc::StatusCode::ABORTED, "another stream"};
      if (static_cast<int>(pending.size()) >= max_pending) answer();
    }
    answer();
    return grpc::Status::OK;
  }
};

class StreamFramesTest : public ::testing::Test {
 protected:
  grpc::Status Stream(std::size_t num_frames) {
    grpc::ServerBuilder builder;
    builder.RegisterService(&service_);
    const auto server = builder.BuildAndStart();
    const auto stub = v1::MappingService::NewStub(server->InProcessChannel({}));
    std::vector<std::size_t> indices(num_frames);
    std::iota(indices.begin(), indices.end(), 0);
    FrameQueue queue(dataset_, indices, false, [this](std::size_t index, const Status&) { skipped_.push_back(index); });
    const grpc::Status status = StreamFrames(*stub, "maps/m", queue, [&](const v1::IntegrateFramesResponse& ack) {
      acks_.push_back(ack.sequence());
      if (static_cast<int>(acks_.size()) == stop_after_) queue.Stop();
    });
    server->Shutdown();
    return status;
  }
  FakeDataset dataset_;
  FakeMapping service_;
  std::vector<std::int64_t> acks_;
  std::vector<std::size_t> skipped_;
  int stop_after_ = -1;
};

TEST_F(StreamFramesTest, SendsAllFramesInOrderAndNamesTheMapOnce) {
  const grpc::Status status = Stream(50);
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(service_.map, "maps/m");
  EXPECT_EQ(acks_.size(), 45u);
  EXPECT_EQ(acks_, service_.stamps);
  EXPECT_TRUE(std::is_sorted(acks_.begin(), acks_.end()));
  EXPECT_EQ(skipped_, (std::vector<std::size_t>{9, 19, 29, 39, 49}));
}

TEST_F(StreamFramesTest, KeepsEightFramesOnTheirWay) {
  service_.max_pending = 8;  // a client that waits for each acknowledgement would hang
  ASSERT_TRUE(Stream(20).ok());
  EXPECT_EQ(acks_.size(), 18u);
}

TEST_F(StreamFramesTest, EndsWithTheServersErrorWhileFramesAreLeft) {
  service_.fail_after = 3;
  const grpc::Status status = Stream(1000);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::ABORTED);
  EXPECT_EQ(status.error_message(), "another stream");
  EXPECT_LT(dataset_.num_read, 100) << "reading must end too";
}

TEST_F(StreamFramesTest, StopsInGoodOrderWhenTheQueueIsStopped) {
  stop_after_ = 5;
  const grpc::Status status = Stream(1000);
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(acks_.size(), service_.stamps.size()) << "everything sent is acknowledged";
  EXPECT_LT(acks_.size(), 50u);
}

TEST(ToMessage, CarriesImagesPoseAndSegments) {
  DatasetFrame frame;
  frame.stamp_ns = 5;
  frame.T_map_sensor(0, 3) = 7;
  frame.segments = {{SegmentId(3), ClassId(12), 0.5f}, {SegmentId(4), std::nullopt, 0.0f}};
  frame.camera.emplace();
  frame.camera->camera = {4, 3, 2, 2, 1.5, 1};
  frame.camera->depth = {{std::byte{1}, std::byte{2}}, 0.001};
  const v1::Frame message = ToMessage(frame, true);
  EXPECT_EQ(message.stamp_ns(), 5);
  EXPECT_EQ(message.map_from_sensor_matrix_size(), 16);
  EXPECT_EQ(message.map_from_sensor_matrix(3), 7) << "row-major";
  EXPECT_EQ(message.depth_camera().depth().data(), std::string("\x01\x02"));
  EXPECT_EQ(message.depth_camera().depth().scale_m(), 0.001);
  EXPECT_FALSE(message.depth_camera().has_color());
  EXPECT_EQ(message.segments(0).class_id(), 12u);
  EXPECT_FALSE(message.segments(1).has_class_id());
  EXPECT_TRUE(message.has_persistent_ids());
}

TEST(ToMessage, CarriesScansWithTheirCamera) {
  DatasetFrame frame;
  frame.lidar.emplace();
  frame.lidar->points_m = {{1, 2, 3}, {4, 5, 6}};
  frame.lidar->segments = {7, 8};
  EXPECT_FALSE(ToMessage(frame, true).lidar().has_camera());
  frame.lidar->P_image_lidar(0, 3) = 9;
  frame.lidar->image_width_px = 8;
  const v1::Frame message = ToMessage(frame, false);
  EXPECT_EQ(message.lidar().xyz_m(4), 5);
  EXPECT_EQ(message.lidar().segment_ids(1), 8u);
  EXPECT_EQ(message.lidar().camera().image_from_lidar(3), 9);
}

}  // namespace
}  // namespace dhpmap
