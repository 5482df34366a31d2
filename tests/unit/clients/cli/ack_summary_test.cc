// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/ack_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "google/rpc/error_details.pb.h"

namespace dhpmap {
namespace {

v1::IntegrateFramesResponse Fused(std::int64_t revision, std::int64_t num_points, std::int64_t num_unknown) {
  v1::IntegrateFramesResponse ack;
  ack.set_revision(revision);
  ack.set_num_points(num_points);
  ack.set_num_unknown_points(num_unknown);
  return ack;
}

void Refuse(v1::IntegrateFramesResponse& ack, int code, const std::string& reason, const std::string& message) {
  ack.mutable_error()->set_code(code);
  ack.mutable_error()->set_message(message);
  google::rpc::ErrorInfo info;
  info.set_reason(reason);
  if (!reason.empty()) ack.mutable_error()->add_details()->PackFrom(info);
}

v1::IntegrateFramesResponse Refused(int code, const std::string& reason, const std::string& message) {
  v1::IntegrateFramesResponse ack;
  Refuse(ack, code, reason, message);
  return ack;
}

std::string Printed(const AckSummary& summary) {
  std::ostringstream out;
  summary.Print(out, 2.0);
  return out.str();
}

TEST(AckSummary, TellsOfEachKindOnceAndCountsTheRest) {
  AckSummary summary;
  EXPECT_TRUE(summary.AddSkipped(NotFound("no 1_color.png").WithReason("MISSING_FILE")));
  EXPECT_FALSE(summary.AddSkipped(NotFound("no 2_color.png").WithReason("MISSING_FILE")));
  EXPECT_TRUE(summary.AddSkipped(NotFound("no 2_pose.txt").WithReason("MISSING_FILE"))) << "another kind of file";
  v1::IntegrateFramesResponse refused;
  Refuse(refused, 3, "BAD_POSE", "not rigid");
  EXPECT_TRUE(summary.AddAck(refused));
  EXPECT_FALSE(summary.AddAck(refused));
  v1::IntegrateFramesResponse fused;
  fused.set_revision(4);
  fused.set_num_created(2);
  EXPECT_FALSE(summary.AddAck(fused));
  EXPECT_EQ(summary.num_done(), 6u);
  const auto json = nlohmann::json::parse(summary.Json({}, 1.0));
  EXPECT_EQ(json["numFused"], 1);
  EXPECT_EQ(json["revision"], 4);
  EXPECT_EQ(json["skipped"][0]["count"], 2);
  EXPECT_EQ(json["refused"][0]["firstMessage"], "not rigid");
  std::ostringstream out;
  summary.Print(out, 1.0);
  EXPECT_NE(out.str().find("2 skipped, MISSING_FILE: no 1_color.png"), std::string::npos) << out.str();
}

TEST(AckSummary, NumbersInAMessageMakeNoNewKindButWordsAndReasonsDo) {
  AckSummary summary;
  EXPECT_TRUE(summary.AddAck(Refused(3, "BAD_FRAME", "depth_camera: 3 x 4")));
  EXPECT_FALSE(summary.AddAck(Refused(3, "BAD_FRAME", "depth_camera: 300 x 5")));
  EXPECT_TRUE(summary.AddAck(Refused(3, "BAD_FRAME", "lidar: 3 x 4")));
  EXPECT_TRUE(summary.AddAck(Refused(3, "BAD_IMAGE", "depth_camera: 3 x 4")));
  EXPECT_TRUE(summary.AddSkipped(InvalidArgument("depth_camera: 3 x 4").WithReason("BAD_FRAME")))
      << "skipping is not refusing";
  EXPECT_EQ(summary.num_refused(), 4u);
  EXPECT_EQ(summary.num_done(), 5u);
}

TEST(AckSummary, TellsOfEachFaultOfFusedFramesOnceAndCountsTheRest) {
  AckSummary summary;
  const auto with = [](v1::IntegrateFramesResponse::Outcome outcome, v1::FrameWarning::Fault fault,
                       const std::string& message) {
    v1::IntegrateFramesResponse ack;
    ack.set_outcome(outcome);
    ack.add_warnings()->set_fault(fault);
    ack.mutable_warnings(0)->set_message(message);
    return ack;
  };
  const auto inverted =
      with(v1::IntegrateFramesResponse::FUSED, v1::FrameWarning::POSE_INVERTED, "inverted; 12 % agree");
  EXPECT_EQ(summary.AddWarnings(inverted), (std::vector<std::string>{"inverted; 12 % agree"}));
  EXPECT_TRUE(
      summary
          .AddWarnings(with(v1::IntegrateFramesResponse::FUSED, v1::FrameWarning::POSE_INVERTED, "inverted; 3 % agree"))
          .empty());
  auto both = with(v1::IntegrateFramesResponse::FUSED, v1::FrameWarning::POSE_INVERTED, "inverted");
  both.add_warnings()->set_fault(v1::FrameWarning::STAMP_REPEATED);
  both.mutable_warnings(1)->set_message("again");
  EXPECT_EQ(summary.AddWarnings(both), (std::vector<std::string>{"again"}));
  EXPECT_TRUE(
      summary.AddWarnings(with(v1::IntegrateFramesResponse::REFUSED, v1::FrameWarning::BODY_AXES, "body")).empty())
      << "its refusal is told";
  EXPECT_TRUE(summary.AddWarnings(Fused(1, 1, 1)).empty());
  const std::string printed = Printed(summary);
  EXPECT_NE(printed.find("3 fused with a warning, POSE_INVERTED: inverted; 12 % agree, ...\n"), std::string::npos)
      << printed;
  EXPECT_NE(printed.find("1 fused with a warning, STAMP_REPEATED: again\n"), std::string::npos) << printed;
  const auto json = nlohmann::json::parse(summary.Json({}, 1.0));
  EXPECT_EQ(json["numDoubtful"], 3);
  EXPECT_EQ(json["doubtful"].size(), 2u);
  EXPECT_EQ(json["doubtful"][0]["reason"], "POSE_INVERTED");
}

TEST(AckSummary, WithoutAReasonTheCodeIsTheKind) {
  AckSummary summary;
  summary.AddAck(Refused(8, "", "full"));
  summary.AddSkipped(NotFound("gone"));
  const auto json = nlohmann::json::parse(summary.Json({}, 1.0));
  EXPECT_EQ(json["refused"][0]["reason"], StatusCodeName(StatusCode::kResourceExhausted));
  EXPECT_EQ(json["skipped"][0]["reason"], StatusCodeName(StatusCode::kNotFound));
}

TEST(AckSummary, AddsUpAndKeepsTheNewestRevision) {
  AckSummary summary;
  summary.AddAck(Fused(7, 300, 30));
  summary.AddAck(Fused(5, 100, 70));
  EXPECT_EQ(summary.num_fused(), 2u);
  v1::Map map;
  map.set_name("maps/home");
  map.set_revision(6);
  auto json = nlohmann::json::parse(summary.Json(map, 2.0));
  EXPECT_EQ(json["map"], "maps/home");
  EXPECT_EQ(json["revision"], 7);
  EXPECT_EQ(json["numPoints"], 400);
  map.set_revision(9);
  json = nlohmann::json::parse(summary.Json(map, 2.0));
  EXPECT_EQ(json["revision"], 9) << "FinishMapping made one more";
  EXPECT_NE(Printed(summary).find("400 points, 25.0 % of them of unknown objects"), std::string::npos);
}

TEST(AckSummary, OfNothingDividesByNothing) {
  const AckSummary summary;
  EXPECT_EQ(Printed(summary), "0 frames fused\n");
  EXPECT_EQ(nlohmann::json::parse(summary.Json({}, 0))["numFused"], 0);
}

TEST(AckSummary, AMessageThatIsNoUtf8IsStillJson) {
  AckSummary summary;
  summary.AddSkipped(NotFound("no \xFF.png"));
  EXPECT_TRUE(nlohmann::json::accept(summary.Json({}, 1.0)));
}

TEST(AckSummary, CountsWhatIsStored) {
  AckSummary summary;
  summary.SetStoredBefore(10);
  v1::IntegrateFramesResponse ack;
  ack.set_outcome(v1::IntegrateFramesResponse::FUSED);
  for (int i = 10; i < 16; ++i) {
    ack.set_sequence(i);
    if (i >= 14) ack.set_committed_sequence(12);
    (void)summary.AddAck(ack);
  }
  EXPECT_EQ(summary.num_fused(), 6u);
  EXPECT_EQ(summary.num_stored(), 13u);
  // The server comes back without the last three: what is sent again counts once.
  ack.set_sequence(13);
  (void)summary.AddAck(ack);
  ack.set_sequence(14);
  ack.set_outcome(v1::IntegrateFramesResponse::DUPLICATE);
  (void)summary.AddAck(ack);
  EXPECT_EQ(summary.num_fused(), 6u);
  EXPECT_EQ(summary.num_done(), 16u);
  v1::IntegrateFramesResponse last;
  last.set_committed_sequence(15);
  summary.AddProgress(last);
  EXPECT_EQ(summary.num_stored(), 16u);
  EXPECT_EQ(nlohmann::json::parse(summary.Json({}, 1.0))["numStored"], 16);
  std::ostringstream out;
  summary.Print(out, 1.0);
  EXPECT_NE(out.str().find("16 frames stored, 10 of them before"), std::string::npos) << out.str();
}

}  // namespace
}  // namespace dhpmap
