// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/mapping_conversion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "server/wire/frame_conversion.h"
#include "tests/support/status_reason.h"

namespace dhpmap {
namespace {

TEST(AckOf, ContainsTheReportOfAFusedFrame) {
  FrameReport report;
  report.num_points = 100;
  report.num_unknown_points = 7;
  report.num_segments = 5;
  report.num_matched = 3;
  report.num_created = 2;
  const auto ack = AckOf(42, {.report = report, .revision = 9, .is_committed = true});
  EXPECT_EQ(ack.sequence(), 42);
  EXPECT_EQ(ack.revision(), 9);
  EXPECT_TRUE(ack.committed());
  EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_FALSE(ack.has_committed_sequence());
  EXPECT_EQ(ack.error().code(), 0);
  EXPECT_EQ(ack.num_points(), 100);
  EXPECT_EQ(ack.num_unknown_points(), 7);
  EXPECT_EQ(ack.num_segments(), 5);
  EXPECT_EQ(ack.num_matched(), 3);
  EXPECT_EQ(ack.num_created(), 2);
}

TEST(AckOf, TheFusionTimeCoversBundlingTrackingAndFusion) {
  FrameReport report;
  report.bundle_s = 1;
  report.track_s = 2;
  report.fuse_s = 4;
  report.free_s = 8;
  report.activity_s = 16;
  report.refine_s = 32;
  EXPECT_EQ(AckOf(1, {.report = report}).fusion_s(), 7);
}

TEST(AckOf, ContainsStoredProgressAndDuplicates) {
  const auto ack = AckOf(42, {.report = FrameReport{}, .revision = 9, .is_duplicate = true, .committed_sequence = 0});
  EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::DUPLICATE);
  ASSERT_TRUE(ack.has_committed_sequence());
  EXPECT_EQ(ack.committed_sequence(), 0);

  const auto answer = AnswerOf(7, {.revision = 3, .committed_sequence = -2, .commit_status = Unavailable("gone")});
  EXPECT_EQ(answer.outcome(), v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) << "it is for no frame";
  EXPECT_EQ(answer.sequence(), 7);
  EXPECT_EQ(answer.revision(), 3);
  EXPECT_EQ(answer.committed_sequence(), -2);
  EXPECT_EQ(answer.commit_error().code(), static_cast<int>(StatusCode::kUnavailable));
}

TEST(AckOf, ContainsTheErrorOfARefusedFrameInWireTerms) {
  PanopticFrame frame;
  frame.T_map_sensor.translation().x() = std::nan("");
  frame.lidar.emplace();
  frame.lidar->points_m = {{1, 2, 3}};
  frame.lidar->color = {Color{}, Color{}};
  const auto ack =
      AckOf(1, {.report = ValidateFrame(frame, LabelSet()), .commit_status = ResourceExhausted("disk \xFF full")});
  EXPECT_EQ(ack.error().code(), static_cast<int>(StatusCode::kInvalidArgument));
  EXPECT_EQ(testing::ReasonOf(ack.error()), "BAD_FRAME");
  EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::REFUSED);
  EXPECT_EQ(ack.error().message(), "the frame is not usable: map_from_sensor: has a NaN or infinite entry, and 1 more");
  EXPECT_EQ(ack.commit_error().code(), static_cast<int>(StatusCode::kResourceExhausted));
  EXPECT_EQ(ack.commit_error().message(), "disk ? full");
}

TEST(AckOf, ContainsThePlausibilityOfAFrame) {
  const auto fits =
      AckOf(1, {.report = FrameReport{}, .check = {.fit = FrameFit{.agreeing_fraction = 0, .median_residual_m = 0.5}}});
  ASSERT_TRUE(fits.fit().has_agreeing_fraction());
  EXPECT_EQ(fits.fit().agreeing_fraction(), 0);
  EXPECT_EQ(fits.fit().median_residual_m(), 0.5);
  EXPECT_FALSE(fits.fit().has_valid_depth_fraction());
  EXPECT_EQ(fits.warnings_size(), 0);
  const auto unknown = AckOf(1, {.report = FrameReport{}, .check = {.fit = FrameFit{.valid_depth_fraction = 1}}});
  EXPECT_FALSE(unknown.fit().has_agreeing_fraction());
  EXPECT_EQ(unknown.fit().valid_depth_fraction(), 1);
  EXPECT_FALSE(AckOf(1, {.report = FrameReport{}}).has_fit()) << "nobody looked at it";
}

TEST(AckOf, ContainsTheWarningsOfARefusedFrame) {
  const auto ack =
      AckOf(1, {.report = InvalidArgument("no").WithReason("IMPLAUSIBLE_FRAME"),
                .check = {.fit = FrameFit{.agreeing_fraction = 0.25},
                          .warnings = {{FrameFault::kPoseInverted, "turn it"}, {FrameFault::kStampWentBack, "\xFF"}}}});
  EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::REFUSED);
  EXPECT_EQ(testing::ReasonOf(ack.error()), "IMPLAUSIBLE_FRAME");
  EXPECT_EQ(ack.fit().agreeing_fraction(), 0.25);
  ASSERT_EQ(ack.warnings_size(), 2);
  EXPECT_EQ(ack.warnings(0).fault(), v1::FrameWarning::POSE_INVERTED);
  EXPECT_EQ(ack.warnings(0).message(), "turn it");
  EXPECT_EQ(ack.warnings(1).fault(), v1::FrameWarning::STAMP_WENT_BACK);
  EXPECT_EQ(ack.warnings(1).message(), "?");
}

TEST(AckOf, EveryFaultHasAWireValue) {
  for (int i = 0; i <= static_cast<int>(FrameFault::kStampWentBack); ++i) {
    const auto fault = static_cast<FrameFault>(i);
    const auto ack = AckOf(1, {.report = FrameReport{}, .check = {.warnings = {{fault, ""}}}});
    EXPECT_EQ(v1::FrameWarning::Fault_Name(ack.warnings(0).fault()), FaultName(fault));
  }
}

TEST(InWireTerms, RenamesEveryFieldOfAFrame) {
  Status status = InvalidArgument("the frame is not usable").WithReason("BAD_FRAME");
  for (const char* field :
       {"T_map_sensor", "camera.camera.fx_px", "camera.depth_m", "camera.color", "camera.segments", "lidar.points_m",
        "lidar.color", "lidar.segments", "segments[3].score", "sensor", "lidar.segment_ids", "depth_camera.depth"}) {
    status.AddViolation(field, "is bad");
  }
  std::vector<std::string> fields;
  const Status renamed = InWireTerms(status);
  for (const FieldViolation& violation : renamed.violations()) fields.push_back(violation.field);
  EXPECT_EQ(fields, (std::vector<std::string>{"map_from_sensor", "depth_camera.camera.fx_px", "depth_camera.depth",
                                              "depth_camera.color", "depth_camera.segments", "lidar.packed_points_m",
                                              "lidar.rgb", "lidar.segment_ids", "segments[3].score", "sensor",
                                              "lidar.segment_ids", "depth_camera.depth"}));
}

}  // namespace
}  // namespace dhpmap
