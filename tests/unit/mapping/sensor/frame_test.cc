// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mapping/sensor/frame_reach.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PanopticFrame GoodCameraFrame() {
  PanopticFrame frame;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = {4, 3, 2.0, 2.0, 2.0, 1.5};
  data.depth_m.assign(12, 1.0f);
  data.color.assign(12, Color{1, 2, 3});
  data.segments = {0, 0, 1, 1, 1, 1, 70'000, 70'000, 0, 0, 0, 1};
  frame.segments = {{SegmentId(1), ClassId(1), 0.9f}, {SegmentId(70'000), std::nullopt, 0.0f}};
  return frame;
}

PanopticFrame GoodLidarFrame() {
  PanopticFrame frame;
  LidarData& data = frame.lidar.emplace();
  data.points_m = {{1, 2, 3}, {4, 5, 6}};
  data.segments = {0, 7};
  frame.segments = {{SegmentId(7), ClassId(2), 1.0f}};
  return frame;
}

Status Validate(const PanopticFrame& frame) { return ValidateFrame(frame, *testing::MakeLabelSet(2, 1)); }

std::vector<std::string> Fields(const Status& status) {
  std::vector<std::string> fields;
  for (const FieldViolation& violation : status.violations()) fields.push_back(violation.field);
  return fields;
}

TEST(ValidateFrame, AcceptsGoodFramesWithAndWithoutOptionalParts) {
  EXPECT_TRUE(Validate(GoodCameraFrame()).ok()) << Validate(GoodCameraFrame()).ToString();
  EXPECT_TRUE(Validate(GoodLidarFrame()).ok()) << Validate(GoodLidarFrame()).ToString();
  PanopticFrame frame = GoodCameraFrame();
  frame.camera->color.clear();
  frame.camera->segments.clear();
  frame.camera->depth_m[3] = std::numeric_limits<float>::quiet_NaN();  // no return, which is not an error
  EXPECT_TRUE(Validate(frame).ok());
}

TEST(ValidateFrame, TakesStampsThatCanBeSubtracted) {
  constexpr std::int64_t kBeyond_ns = std::int64_t{1} << 62;
  for (const std::int64_t stamp_ns : {kBeyond_ns - 1, 1 - kBeyond_ns, std::int64_t{0}}) {
    PanopticFrame frame = GoodCameraFrame();
    frame.stamp_ns = stamp_ns;
    EXPECT_TRUE(Validate(frame).ok()) << stamp_ns;
  }
  for (const std::int64_t stamp_ns : {kBeyond_ns, -kBeyond_ns, std::numeric_limits<std::int64_t>::min()}) {
    PanopticFrame frame = GoodCameraFrame();
    frame.stamp_ns = stamp_ns;
    EXPECT_EQ(Fields(Validate(frame)), std::vector<std::string>{"stamp_ns"}) << stamp_ns;
  }
}

struct BadFrame {
  const char* name;
  std::function<void(PanopticFrame&)> spoil;
  const char* field;
};

class ValidateFrameRefuses : public ::testing::TestWithParam<BadFrame> {};

TEST_P(ValidateFrameRefuses, AndNamesTheField) {
  PanopticFrame frame = GoodCameraFrame();
  GetParam().spoil(frame);
  const Status status = Validate(frame);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(status.reason(), Reason("BAD_FRAME"));
  EXPECT_EQ(Fields(status), std::vector<std::string>{GetParam().field}) << status.ToString();
}

INSTANTIATE_TEST_SUITE_P(
    Frames, ValidateFrameRefuses,
    ::testing::Values(
        BadFrame{"NanPose", [](auto& f) { f.T_map_sensor.translation().y() = kNan; }, "T_map_sensor"},
        BadFrame{"NoSensor", [](auto& f) { f.camera.reset(); }, "sensor"},
        BadFrame{"BothSensors", [](auto& f) { f.lidar.emplace(); }, "sensor"},
        BadFrame{"ZeroWidth", [](auto& f) { f.camera->camera.width_px = 0; }, "camera.camera.width_px"},
        BadFrame{"HugeHeight", [](auto& f) { f.camera->camera.height_px = 16385; }, "camera.camera.height_px"},
        BadFrame{"NegativeFocal", [](auto& f) { f.camera->camera.fx_px = -1; }, "camera.camera.fx_px"},
        BadFrame{"NanCentre", [](auto& f) { f.camera->camera.cy_px = kNan; }, "camera.camera.cy_px"},
        BadFrame{"DepthSize", [](auto& f) { f.camera->depth_m.pop_back(); }, "camera.depth_m"},
        BadFrame{"NoDepth", [](auto& f) { f.camera->depth_m.clear(); }, "camera.depth_m"},
        BadFrame{"ColorSize", [](auto& f) { f.camera->color.pop_back(); }, "camera.color"},
        BadFrame{"SegmentsSize", [](auto& f) { f.camera->segments.push_back(0); }, "camera.segments"},
        BadFrame{"IdWithoutRow", [](auto& f) { f.camera->segments[5] = 9; }, "camera.segments"},
        BadFrame{"LargeIdWithoutRow", [](auto& f) { f.camera->segments[5] = 70'001; }, "camera.segments"},
        BadFrame{"ZeroId",
                 [](auto& f) {
                   f.segments.push_back({SegmentId(0), ClassId(1), 0.0f});
                 },
                 "segments[2].id"},
        BadFrame{"IdTwice", [](auto& f) { f.segments.push_back(f.segments[0]); }, "segments"},
        BadFrame{"UnknownClass", [](auto& f) { f.segments[1].class_id = ClassId(4); }, "segments[1].class_id"},
        BadFrame{"ScoreAboveOne", [](auto& f) { f.segments[0].score = 1.5f; }, "segments[0].score"},
        BadFrame{"ScoresOfNoClass",
                 [](auto& f) {
                   f.segments[0].class_scores = {{ClassId(99), 0.5f}};
                 },
                 "segments[0].class_scores"},
        BadFrame{"ScoresOfAClassTwice",
                 [](auto& f) {
                   f.segments[0].class_scores = {{ClassId(1), 0.5f}, {ClassId(1), 0.1f}};
                 },
                 "segments[0].class_scores"},
        BadFrame{"ScoresAboveOneInSum",
                 [](auto& f) {
                   f.segments[1].class_scores = {{ClassId(1), 0.6f}, {ClassId(2), 0.5f}};
                 },
                 "segments[1].class_scores"},
        BadFrame{"NanClassScore",
                 [](auto& f) {
                   f.segments[1].class_scores = {{ClassId(1), std::nanf("")}};
                 },
                 "segments[1].class_scores"},
        BadFrame{"TooManyClassScores", [](auto& f) { f.segments[1].class_scores.resize(kMostClassScores + 1); },
                 "segments[1].class_scores"},
        BadFrame{"NanScore", [](auto& f) { f.segments[0].score = std::nanf(""); }, "segments[0].score"}),
    [](const auto& frame) { return frame.param.name; });

TEST(SegmentInfo, IsAsSureAsItsScoreOrElseItsClassScoresSay) {
  SegmentInfo segment{.id = SegmentId(1), .class_id = ClassId(2)};
  EXPECT_EQ(segment.Sureness(), std::nullopt);
  EXPECT_FALSE(segment.IsDoubtful(1)) << "the network says nothing";
  segment.class_scores = {{ClassId(1), 0.75f}, {ClassId(2), 0.25f}};
  EXPECT_EQ(segment.Sureness(), 0.25f);
  EXPECT_TRUE(segment.IsDoubtful(0.6));
  segment.class_id = ClassId(3);
  EXPECT_EQ(segment.Sureness(), 0.0f) << "anything but that";
  EXPECT_TRUE(segment.IsDoubtful(0.6));
  EXPECT_FALSE(segment.IsDoubtful(0));
  segment.score = 0.9f;
  EXPECT_FALSE(segment.IsDoubtful(0.6));
  segment.score = 0.0f;
  EXPECT_EQ(segment.Sureness(), 0.0f) << "the worst score, not none";
  EXPECT_TRUE(segment.IsDoubtful(0.6));
  const std::vector<ClassScore> tie{{ClassId(5), 0.5f}, {ClassId(4), 0.5f}};
  EXPECT_EQ(LikeliestClass(tie), ClassId(4));
  EXPECT_EQ(LikeliestClass({}), std::nullopt);
}

TEST(ValidateFrame, RefusesLidarScansThatDoNotFit) {
  PanopticFrame frame = GoodLidarFrame();
  frame.lidar->points_m[1].z() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(Fields(Validate(frame)), std::vector<std::string>{"lidar.points_m"});
  frame = GoodLidarFrame();
  frame.lidar->color.assign(3, Color{});
  EXPECT_EQ(Fields(Validate(frame)), std::vector<std::string>{"lidar.color"});
  frame = GoodLidarFrame();
  frame.lidar->segments.resize(1);
  EXPECT_EQ(Fields(Validate(frame)), std::vector<std::string>{"lidar.segments"});
  frame = GoodLidarFrame();
  frame.lidar->segments[0] = 3;
  EXPECT_EQ(Fields(Validate(frame)), std::vector<std::string>{"lidar.segments"});
  frame = GoodLidarFrame();
  frame.lidar->is_hidden = {0, 1};
  EXPECT_TRUE(Validate(frame).ok());
  frame.lidar->is_hidden = {1};
  EXPECT_EQ(Fields(Validate(frame)), std::vector<std::string>{"lidar.is_hidden"});
}

TEST(ValidateFrame, NamesEveryViolationAtOnce) {
  PanopticFrame frame = GoodCameraFrame();
  frame.T_map_sensor.translation().x() = kNan;
  frame.segments[0].class_id = ClassId(99);
  frame.segments[1].score = -1.0f;
  frame.camera->depth_m.pop_back();
  frame.camera->segments[0] = 5;
  frame.camera->segments[1] = 6;
  EXPECT_EQ(Fields(Validate(frame)),
            (std::vector<std::string>{"T_map_sensor", "segments[0].class_id", "segments[1].score", "camera.depth_m",
                                      "camera.segments", "camera.segments"}));
}

TEST(ValidateFrame, AllowsIdsWithoutARowIfTheFrameSaysSo) {
  PanopticFrame frame = GoodCameraFrame();
  frame.segments.clear();
  EXPECT_FALSE(Validate(frame).ok());
  frame.unlisted_ids_are_unknown = true;
  EXPECT_TRUE(Validate(frame).ok());
}

TEST(ValidateFrame, DoesNotListThousandsOfMissingRows) {
  PanopticFrame frame = GoodCameraFrame();
  frame.camera->camera = {100, 100, 50, 50, 50, 50};
  frame.camera->depth_m.assign(10'000, 1.0f);
  frame.camera->color.clear();
  frame.camera->segments.clear();
  for (std::uint32_t i = 0; i < 10'000; ++i) frame.camera->segments.push_back(100 + i);
  const Status status = Validate(frame);
  EXPECT_FALSE(status.ok());
  EXPECT_LT(status.violations().size(), 30u);
}

TEST(ValidateFrame, AcceptsAVgaFrameOfAHundredSegmentsInShortRuns) {
  PanopticFrame frame = GoodCameraFrame();
  frame.camera->camera = {640, 480, 320, 320, 320, 240};
  frame.camera->depth_m.assign(307'200, 1.0f);
  frame.camera->color.clear();
  frame.camera->segments.resize(307'200);
  frame.segments.clear();
  for (std::uint32_t id = 1; id <= 100; ++id) frame.segments.push_back({SegmentId(id), ClassId(1), 0.0f});
  for (std::uint32_t i = 0; i < 307'200; ++i) frame.camera->segments[i] = i / 3 * 7 % 101;
  EXPECT_TRUE(Validate(frame).ok());
}

TEST(PinholeCamera, NamesEveryBadField) {
  const PinholeCamera camera{0, 20'000, 0.0, std::numeric_limits<double>::infinity(), kNan, kNan};
  EXPECT_EQ(Fields(camera.Validate()),
            (std::vector<std::string>{"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}));
  EXPECT_TRUE((PinholeCamera{640, 480, 320, 320, 320, 240}).Validate().ok());
}

TEST(PinholeCamera, RefusesPixelsThatLookAsideWithoutEnd) {
  const auto fields = [](double focal_px, double centre_px) {
    return Fields(PinholeCamera{640, 480, focal_px, focal_px, centre_px, 240}.Validate());
  };
  using List = std::vector<std::string>;
  EXPECT_EQ(fields(1e-300, 320), (List{"fx_px", "fy_px"}));
  EXPECT_EQ(fields(5e-324, 320), (List{"fx_px", "fy_px"}));
  EXPECT_EQ(fields(320, 1e300), (List{"fx_px"}));
  EXPECT_EQ(fields(320, -1e300), (List{"fx_px"}));
  EXPECT_EQ(fields(3.3e-4, 320), List{}) << "320 px / 3.3e-4 px is less than 1e6";
  EXPECT_EQ(fields(3.1e-4, 320), (List{"fx_px"}));
}

TEST(CheckFrameIsOnGrid, NamesTheFieldTheLimitAndWhatToDo) {
  PanopticFrame frame = GoodCameraFrame();
  EXPECT_TRUE(CheckFrameIsOnGrid(frame, 0.002).ok());
  frame.T_map_sensor.translation() = Eigen::Vector3d(6.9e5, 5.4e6, 0);
  EXPECT_TRUE(CheckFrameIsOnGrid(frame, 0.04).ok());
  const Status status = CheckFrameIsOnGrid(frame, 0.002);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(status.reason(), Reason("BAD_FRAME"));
  ASSERT_EQ(Fields(status), std::vector<std::string>{"map_from_sensor"});
  const std::string& description = status.violations()[0].description;
  EXPECT_NE(description.find("y = 5400000 m"), std::string::npos) << description;
  EXPECT_NE(description.find("1073741.824 m"), std::string::npos) << description;
  EXPECT_NE(description.find("local frame"), std::string::npos) << description;
}

}  // namespace
}  // namespace dhpmap
