// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

#include "clients/cli/ack_summary.h"
#include "clients/cli/frame_message.h"
#include "tests/support/assert_ok.h"
#include "tests/unit/clients/cpp/scripted_server.h"

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
        ack.set_outcome(v1::IntegrateFramesResponse::FUSED);
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

std::shared_ptr<client::Caller> ConnectTo(const std::string& address) {
  auto caller = client::Caller::Connect(address, {});
  EXPECT_OK(caller);
  return *std::move(caller);
}

std::vector<std::size_t> IndicesOf(std::size_t num_frames) {
  std::vector<std::size_t> indices(num_frames);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

class StreamFramesTest : public ::testing::Test {
 protected:
  client::Status Stream(std::size_t num_frames) {
    const testing::ScriptedServer server(service_);
    const FrameHooks hooks{.read = [this](const auto& left) { return Read(left); },
                           .on_stored_before = [](std::size_t) { ADD_FAILURE() << "of a session without a name"; },
                           .on_ack =
                               [this](const v1::IntegrateFramesResponse& ack) {
                                 acks_.push_back(ack.sequence());
                                 is_stopped_ = static_cast<int>(acks_.size()) == stop_after_ || is_stopped_;
                               },
                           .on_progress = [](const auto&) {},
                           .reconnect = [](const auto&) { return true; },
                           .is_interrupted = [this] { return is_stopped_.load(); }};
    return StreamFrames(ConnectTo(server.address()), {.map = "maps/m"}, IndicesOf(num_frames), hooks);
  }
  std::unique_ptr<FrameQueue> Read(const std::vector<std::size_t>& left) {
    return std::make_unique<FrameQueue>(dataset_, left, false,
                                        [this](std::size_t index, const Status&) { skipped_.push_back(index); });
  }
  FakeDataset dataset_;
  FakeMapping service_;
  std::vector<std::int64_t> acks_;
  std::vector<std::size_t> skipped_;
  int stop_after_ = -1;
  std::atomic<bool> is_stopped_ = false;
};

TEST_F(StreamFramesTest, SendsAllFramesInOrderAndNamesTheMapOnce) {
  const client::Status status = Stream(50);
  ASSERT_TRUE(status.ok()) << status.message;
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
  const client::Status status = Stream(1000);
  EXPECT_EQ(status.code, client::StatusCode::kAborted);
  EXPECT_EQ(status.message, "another stream");
  EXPECT_LT(dataset_.num_read, 100) << "reading must end too";
}

TEST_F(StreamFramesTest, StopsInGoodOrderWhenItIsInterrupted) {
  stop_after_ = 5;
  const client::Status status = Stream(1000);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(acks_.size(), service_.stamps.size()) << "everything sent is acknowledged";
  EXPECT_LT(acks_.size(), 50u);
}

/// Remembers a session as the server does: takes frames in order, stores every fourth with those before, and breaks the
/// connection after so many frames, for which what is not stored is lost.
class FakeSessions : public v1::MappingService::Service {
 public:
  int break_after = 7;
  std::int64_t stored = -1;
  std::vector<std::int64_t> taken;
  std::vector<v1::IntegrateFramesRequest> greetings;

  grpc::Status IntegrateFrames(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::IntegrateFramesResponse, v1::IntegrateFramesRequest>* stream) override {
    std::int64_t last = stored;
    int num_frames = 0;
    v1::IntegrateFramesRequest request;
    for (bool is_first = true; stream->Read(&request); is_first = false) {
      v1::IntegrateFramesResponse answer;
      if (is_first) {
        greetings.push_back(request);
      } else {
        if (++num_frames == break_after) {
          std::erase_if(taken, [this](std::int64_t sequence) { return sequence > stored; });
          return {grpc::StatusCode::UNAVAILABLE, "gone"};
        }
        taken.push_back(request.sequence());
        last = request.sequence();
        if (num_frames % 4 == 0) stored = last;
        answer.set_outcome(v1::IntegrateFramesResponse::FUSED);
        answer.set_sequence(last);
      }
      if (stored >= 0) answer.set_committed_sequence(stored);
      stream->Write(answer);
    }
    stored = last;
    v1::IntegrateFramesResponse answer;
    answer.set_committed_sequence(stored);
    stream->Write(answer);
    return grpc::Status::OK;
  }
};

class StreamSessionTest : public ::testing::Test {
 protected:
  client::Status Stream(const FrameSession& session, std::size_t num_frames) {
    const testing::ScriptedServer server(service_);
    const FrameHooks hooks{
        .read =
            [this](const std::vector<std::size_t>& left) {
              return std::make_unique<FrameQueue>(dataset_, left, false, [](std::size_t, const Status&) {});
            },
        .on_stored_before = [this](std::size_t count) { stored_before_.push_back(count); },
        .on_ack = [this](const v1::IntegrateFramesResponse& ack) { EXPECT_FALSE(summary_.AddAck(ack)); },
        .on_progress = [this](const v1::IntegrateFramesResponse& a) { summary_.AddProgress(a); },
        .reconnect = [this](const client::Status&) { return ++num_lost_ < max_lost_; },
        .is_interrupted = [] { return false; }};
    return StreamFrames(ConnectTo(server.address()), session, IndicesOf(num_frames), hooks);
  }
  FakeDataset dataset_;
  FakeSessions service_;
  AckSummary summary_;
  std::vector<std::size_t> stored_before_;
  int num_lost_ = 0, max_lost_ = 1000;
};

TEST_F(StreamSessionTest, GoesOnAfterEachLostConnectionWithWhatIsNotStored) {
  const client::Status status =
      Stream({.map = "maps/m", .name = "robot", .take_over = true, .refuse_implausible = true}, 30);
  ASSERT_TRUE(status.ok()) << status.message;
  std::vector<std::int64_t> wanted;
  for (std::int64_t i = 0; i < 30; ++i) {
    if (i % 10 != 9) wanted.push_back(i);  // the others cannot be read
  }
  EXPECT_EQ(service_.taken, wanted) << "each once, in order, none is missing";
  EXPECT_GE(num_lost_, 3);
  EXPECT_EQ(summary_.num_fused(), wanted.size());
  EXPECT_EQ(summary_.num_stored(), wanted.size());
  EXPECT_EQ(stored_before_, (std::vector<std::size_t>{0})) << "said once";
  for (std::size_t i = 0; i < service_.greetings.size(); ++i) {
    const v1::IntegrateFramesRequest& greeting = service_.greetings[i];
    EXPECT_EQ(greeting.map(), "maps/m");
    EXPECT_EQ(greeting.session(), "robot");
    EXPECT_FALSE(greeting.has_frame());
    EXPECT_EQ(greeting.take_over(), i == 0) << "who took over from us since may keep it";
    EXPECT_TRUE(greeting.refuse_implausible()) << "of every connection";
  }
}

TEST_F(StreamSessionTest, SendsOnlyWhatAnEarlierRunHasNotStored) {
  service_.break_after = -1;
  service_.stored = 11;
  ASSERT_TRUE(Stream({.map = "maps/m", .name = "robot"}, 15).ok());
  EXPECT_EQ(service_.taken, (std::vector<std::int64_t>{12, 13, 14}));
  EXPECT_EQ(stored_before_, (std::vector<std::size_t>{12}));
}

TEST_F(StreamSessionTest, EndsIfThereIsNoOtherConnectionAndSaysWhatIsStored) {
  max_lost_ = 1;
  EXPECT_EQ(Stream({.map = "maps/m", .name = "robot"}, 30).code, client::StatusCode::kUnavailable);
  EXPECT_LE(summary_.num_stored(), 4u);
}

TEST_F(StreamSessionTest, AFrameThatEndsTheServerEachTimeEndsItAfterTenMore) {
  service_.break_after = 1;
  EXPECT_EQ(Stream({.map = "maps/m", .name = "robot"}, 30).code, client::StatusCode::kUnavailable);
  EXPECT_EQ(num_lost_, 11);
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
  EXPECT_TRUE(message.persistent_ids());
}

TEST(ToMessage, CarriesScansWithTheirCamera) {
  DatasetFrame frame;
  frame.lidar = DatasetFrame::Lidar{};  // clang 14 takes emplace() for ill-formed
  frame.lidar->points_m = {{1, 2, 3}, {4, 5, 6}};
  frame.lidar->segments = {7, 8};
  EXPECT_FALSE(ToMessage(frame, true).lidar().has_camera());
  frame.lidar->P_image_lidar(0, 3) = 9;
  frame.lidar->image_width_px = 8;
  const v1::Frame message = ToMessage(frame, false);
  EXPECT_EQ(message.lidar().packed_points_m(4), 5);
  EXPECT_EQ(message.lidar().segment_ids(1), 8u);
  EXPECT_EQ(message.lidar().camera().image_from_lidar(3), 9);
}

}  // namespace
}  // namespace dhpmap
