// SPDX-License-Identifier: BSD-3-Clause
// Answers to implausible frames, and their effects.
#include <gtest/gtest.h>

#include "tests/integration/feeder.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

using Ack = v1::IntegrateFramesResponse;

class FramesThatDoNotFit : public ::testing::Test {
 protected:
  FramesThatDoNotFit() {
    v1::CreateMapResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(server_.maps->CreateMap(&context, CreateRequest("room"), &response).ok());
  }

  std::int64_t NumFrames() { return server_.registry().GetOpen("room").value()->View()->snapshot().info().num_frames; }

  const std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_{*store_};
};

Ack Fed(Feeder& feeder, std::int64_t sequence, v1::Frame frame) {
  EXPECT_TRUE(feeder.Send(sequence, std::move(frame)));
  const auto ack = feeder.Read();
  EXPECT_TRUE(ack);
  return ack.value_or(Ack());
}

v1::Frame InMillimetres(v1::Frame frame) {
  for (const int translation : {3, 7, 11}) {
    frame.set_map_from_sensor_matrix(translation, 1000 * frame.map_from_sensor_matrix(translation));
  }
  return frame;
}

TEST_F(FramesThatDoNotFit, EachAnswerDescribesHowTheFrameFits) {
  Feeder feeder(server_, "room");
  for (int i = 0; i < 6; ++i) {
    const Ack ack = Fed(feeder, i, TestFrame(i));
    EXPECT_EQ(ack.warnings_size(), 0) << ack.ShortDebugString();
    ASSERT_TRUE(ack.has_fit());
    EXPECT_GT(ack.fit().valid_depth_fraction(), 0.5);
    EXPECT_EQ(ack.fit().has_agreeing_fraction(), i > 0) << "the first one meets nothing known";
    if (i == 0) continue;
    EXPECT_GT(ack.fit().agreeing_fraction(), 0.9);
    EXPECT_LT(ack.fit().median_residual_m(), 0.01);
  }
}

TEST_F(FramesThatDoNotFit, TheyAreFusedWithAWarning) {
  Feeder feeder(server_, "room");
  EXPECT_EQ(Fed(feeder, 0, InMillimetres(TestFrame(0))).warnings_size(), 0) << "nobody can tell";
  const Ack ack = Fed(feeder, 1, InMillimetres(TestFrame(1)));
  EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::FUSED);
  ASSERT_EQ(ack.warnings_size(), 1) << ack.ShortDebugString();
  EXPECT_EQ(ack.warnings(0).fault(), v1::FrameWarning::TRANSLATION_IN_MILLIMETRES);
  EXPECT_NE(ack.warnings(0).message().find("must be in metres"), std::string::npos) << ack.warnings(0).message();
}

TEST_F(FramesThatDoNotFit, AFeedMayAskToRefuseThem) {
  Feeder feeder(server_, "room", {.session = "robot", .refuse_implausible = true});
  EXPECT_EQ(Fed(feeder, 0, TestFrame(0)).outcome(), v1::IntegrateFramesResponse::FUSED);
  const Ack refused = Fed(feeder, 1, InMillimetres(TestFrame(1)));
  EXPECT_EQ(refused.outcome(), v1::IntegrateFramesResponse::REFUSED);
  EXPECT_EQ(refused.error().code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(ReasonOf(refused.error()), "IMPLAUSIBLE_FRAME");
  ASSERT_EQ(refused.warnings_size(), 1);
  EXPECT_EQ(refused.warnings(0).fault(), v1::FrameWarning::TRANSLATION_IN_MILLIMETRES);
  v1::Frame again = TestFrame(2);
  again.set_stamp_ns(TestFrame(0).stamp_ns());
  EXPECT_EQ(ReasonOf(Fed(feeder, 2, std::move(again)).error()), "IMPLAUSIBLE_FRAME");
  EXPECT_EQ(Fed(feeder, 3, TestFrame(2)).outcome(), v1::IntegrateFramesResponse::FUSED)
      << "the stream goes on, and what was refused is nothing";
  feeder.HalfClose();
  EXPECT_TRUE(feeder.Finish().ok());
  EXPECT_EQ(NumFrames(), 2);
}

TEST_F(FramesThatDoNotFit, StampsContinueAcrossStreamsOfASessionOnly) {
  const auto faults_of = [this](const std::string& session, int frame) {
    static std::int64_t sequence = 0;
    Feeder feeder(server_, "room", {.session = session});
    const Ack ack = Fed(feeder, ++sequence, TestFrame(frame));
    feeder.HalfClose();
    EXPECT_TRUE(feeder.Finish().ok());
    std::vector<v1::FrameWarning::Fault> faults;
    for (const auto& warning : ack.warnings()) faults.push_back(warning.fault());
    return faults;
  };
  const std::vector<v1::FrameWarning::Fault> none, repeated{v1::FrameWarning::STAMP_REPEATED},
      back{v1::FrameWarning::STAMP_WENT_BACK};
  EXPECT_EQ(faults_of("robot", 3), none);
  EXPECT_EQ(faults_of("robot", 3), repeated);
  EXPECT_EQ(faults_of("robot", 1), back);
  EXPECT_EQ(faults_of("robot", 2), none);
  EXPECT_EQ(faults_of("another", 2), none);
  EXPECT_EQ(faults_of("", 5), none);
  EXPECT_EQ(faults_of("", 5), none) << "a stream without a session has a clock of its own";
  Feeder feeder(server_, "room");
  EXPECT_EQ(Fed(feeder, 0, TestFrame(1)).warnings_size(), 0);
  EXPECT_EQ(Fed(feeder, 1, TestFrame(1)).warnings_size(), 1) << "within it they go forward";
}

}  // namespace
}  // namespace dhpmap::testing
