// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/frame_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "proto/types/pose_conversion.h"

namespace dhpmap {
namespace {

constexpr int kWidth = 4, kHeight = 3;
constexpr std::size_t kNumPixels = std::size_t{kWidth} * kHeight;

template <typename T>
void SetRaw(const std::vector<T>& values, v1::Image::Encoding encoding, v1::Image* image) {
  image->set_encoding(encoding);
  image->set_data(values.data(), values.size() * sizeof(T));
}

v1::Frame CameraFrame() {
  v1::Frame frame;
  frame.set_stamp_ns(7);
  frame.mutable_map_from_sensor()->mutable_translation_m()->set_x(2);
  auto* camera = frame.mutable_depth_camera()->mutable_camera();
  camera->set_width_px(kWidth);
  camera->set_height_px(kHeight);
  camera->set_fx_px(4);
  camera->set_fy_px(4);
  SetRaw(std::vector<float>(kNumPixels, 1.5f), v1::Image::RAW_F32, frame.mutable_depth_camera()->mutable_depth());
  v1::Segment* segment = frame.add_segments();
  segment->set_id(5);
  segment->set_class_id(0);
  frame.add_segments()->set_id(6);
  return frame;
}

v1::Frame LidarFrame() {
  v1::Frame frame;
  frame.mutable_map_from_sensor();
  for (int i = 0; i < 6; ++i) frame.mutable_lidar()->add_packed_points_m(static_cast<float>(i));
  return frame;
}

std::set<std::string> BadFields(const v1::Frame& frame) {
  const auto result = FrameFromProto(frame);
  std::set<std::string> fields;
  for (const FieldViolation& violation : result.status().violations()) fields.insert(violation.field);
  EXPECT_EQ(result.ok(), fields.empty());
  EXPECT_TRUE(result.ok() || result.status().code() == StatusCode::kInvalidArgument);
  return fields;
}

using Change = std::function<void(v1::Frame&)>;
std::set<std::string> BadFieldsAfter(v1::Frame frame, const Change& change) {
  change(frame);
  return BadFields(frame);
}
using Set = std::set<std::string>;

TEST(FrameFromProto, TakesACameraFrame) {
  const auto frame = FrameFromProto(CameraFrame());
  ASSERT_TRUE(frame.ok()) << frame.status().ToString();
  EXPECT_EQ(frame->stamp_ns, 7);
  EXPECT_EQ(frame->T_map_sensor.translation().x(), 2);
  ASSERT_TRUE(frame->camera.has_value());
  EXPECT_EQ(frame->camera->depth_m, std::vector<float>(kNumPixels, 1.5f));
  ASSERT_EQ(frame->segments.size(), 2u);
  EXPECT_EQ(frame->segments[0].class_id, ClassId(0));  // 0 is a class; not set is not
  EXPECT_FALSE(frame->segments[1].class_id.has_value());
}

TEST(FrameFromProto, AScoreOfZeroIsAScore) {
  v1::Frame frame = CameraFrame();
  frame.mutable_segments(0)->set_score(0);
  const auto taken = FrameFromProto(frame);
  ASSERT_TRUE(taken.ok()) << taken.status().ToString();
  EXPECT_EQ(taken->segments[0].score, 0.0f);
  EXPECT_FALSE(taken->segments[1].score.has_value());
}

TEST(FrameFromProto, ScalesIntegerDepthAndKeepsMissingReturns) {
  v1::Frame frame = CameraFrame();
  std::vector<std::uint16_t> depth(kNumPixels, 2000);
  depth[0] = 0;
  depth[1] = 65535;
  SetRaw(depth, v1::Image::RAW_U16, frame.mutable_depth_camera()->mutable_depth());
  EXPECT_EQ(BadFields(frame), Set{"depth_camera.depth"});  // without a scale
  frame.mutable_depth_camera()->mutable_depth()->set_scale_m(0.001);
  const auto result = FrameFromProto(frame);
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(result->camera->depth_m[0], 0.0f);
  EXPECT_EQ(result->camera->depth_m[1], 0.0f);
  EXPECT_FLOAT_EQ(result->camera->depth_m[2], 2.0f);
}

TEST(FrameFromProto, AcceptsSegmentIdsOfEveryWidth) {
  v1::Frame frame = CameraFrame();
  auto* segments = frame.mutable_depth_camera()->mutable_segments();
  SetRaw(std::vector<std::uint8_t>(12, 5), v1::Image::RAW_U8, segments);
  EXPECT_EQ(FrameFromProto(frame)->camera->segments, std::vector<std::uint32_t>(12, 5));
  SetRaw(std::vector<std::uint16_t>(12, 600), v1::Image::RAW_U16, segments);
  EXPECT_EQ(FrameFromProto(frame)->camera->segments, std::vector<std::uint32_t>(12, 600));
  SetRaw(std::vector<std::uint32_t>(12, 70000), v1::Image::RAW_U32, segments);
  EXPECT_EQ(FrameFromProto(frame)->camera->segments, std::vector<std::uint32_t>(12, 70000));
}

TEST(FrameFromProto, ImagesOfTheWrongSizeOrTypeAreNamed) {
  const auto depth = [](v1::Frame& f) { return f.mutable_depth_camera()->mutable_depth(); };
  const auto color = [](v1::Frame& f) { return f.mutable_depth_camera()->mutable_color(); };
  const auto segments = [](v1::Frame& f) { return f.mutable_depth_camera()->mutable_segments(); };
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { depth(f)->mutable_data()->pop_back(); }),
            Set{"depth_camera.depth"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { depth(f)->mutable_data()->push_back(0); }),
            Set{"depth_camera.depth"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { f.mutable_depth_camera()->clear_depth(); }),
            Set{"depth_camera.depth"});
  for (const auto encoding :
       {v1::Image::RAW_U32, v1::Image::RAW_RGB8, v1::Image::RAW_U8, v1::Image::IMAGE_ENCODING_UNSPECIFIED}) {
    EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { depth(f)->set_encoding(encoding); }),
              Set{"depth_camera.depth"});
  }
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { depth(f)->set_encoding(v1::Image::FILE); }),
            Set{"depth_camera.depth"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { color(f)->set_encoding(v1::Image::RAW_RGB8); }),
            Set{"depth_camera.color"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { color(f)->set_encoding(v1::Image::RAW_F32); }),
            Set{"depth_camera.color"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { segments(f)->set_encoding(v1::Image::RAW_F32); }),
            Set{"depth_camera.segments"});
  EXPECT_EQ(
      BadFieldsAfter(CameraFrame(), [&](auto& f) { segments(f)->set_encoding(static_cast<v1::Image::Encoding>(99)); }),
      Set{"depth_camera.segments"});
}

/// The header chunks of a PNG, without pixels.
std::string HeadOfAPng(std::uint8_t width_of_256_px, std::uint8_t height_of_256_px) {
  const std::string width = {0, 0, static_cast<char>(width_of_256_px), 0};
  const std::string height = {0, 0, static_cast<char>(height_of_256_px), 0};
  const std::string no_crc(4, '\0');
  const std::string grey_8_bit("\x08\0\0\0\0", 5);
  return std::string("\x89PNG\r\n\x1a\n") + std::string("\0\0\0\rIHDR", 8) + width + height + grey_8_bit + no_crc +
         std::string("\0\0\0\0IEND", 8) + no_crc;
}

TEST(FrameFromProto, AFilesSizeIsComparedWithTheCameraBeforeDecoding) {
  v1::Frame frame = CameraFrame();
  v1::Image& segments = *frame.mutable_depth_camera()->mutable_segments();
  segments.set_encoding(v1::Image::FILE);
  segments.set_data(HeadOfAPng(32, 16));
  const Status status = FrameFromProto(frame).status();
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "depth_camera.segments");
  EXPECT_NE(status.violations()[0].description.find("is 8192 x 4096 pixels, the camera "), std::string::npos)
      << "by its head, which is all there is: " << status.violations()[0].description;
}

TEST(FrameFromProto, AnInvalidCameraIsReportedBeforeItsImages) {
  const auto camera = [](v1::Frame& f) { return f.mutable_depth_camera()->mutable_camera(); };
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { camera(f)->set_width_px(0); }),
            Set{"depth_camera.camera.width_px"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { camera(f)->set_height_px(1 << 30); }),
            Set{"depth_camera.camera.height_px"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { camera(f)->set_fx_px(-1); }),
            Set{"depth_camera.camera.fx_px"});
}

TEST(FrameFromProto, ThePoseMustBeGivenOnceAndBeRigid) {
  const auto matrix = [](v1::Frame& f, std::vector<double> values) {
    f.clear_map_from_sensor();
    f.mutable_map_from_sensor_matrix()->Assign(values.begin(), values.end());
  };
  const std::vector<double> good = {1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1};
  v1::Frame frame = CameraFrame();
  matrix(frame, good);
  const auto result = FrameFromProto(frame);
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(result->T_map_sensor.translation(), Eigen::Vector3d(4, 5, 6));

  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { f.clear_map_from_sensor(); }), Set{"map_from_sensor"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(),
                           [&](auto& f) {
                             for (const double v : good) f.add_map_from_sensor_matrix(v);
                           }),
            Set{"map_from_sensor"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { matrix(f, {1, 2, 3}); }), Set{"map_from_sensor_matrix"});
  for (const double entry : {std::nan(""), std::numeric_limits<double>::infinity(), 2.0, -1.0}) {
    std::vector<double> values = good;
    values[0] = entry;
    EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { matrix(f, values); }), Set{"map_from_sensor_matrix"})
        << entry;
  }
  EXPECT_EQ(BadFieldsAfter(CameraFrame(), [&](auto& f) { f.mutable_map_from_sensor()->mutable_rotation(); }),
            Set{"map_from_sensor"});
  EXPECT_EQ(BadFieldsAfter(CameraFrame(),
                           [&](auto& f) { f.mutable_map_from_sensor()->mutable_translation_m()->set_y(std::nan("")); }),
            Set{"map_from_sensor"});
}

TEST(FrameFromProto, EveryBadFieldIsNamedAtOnce) {
  v1::Frame frame = CameraFrame();
  frame.clear_map_from_sensor();
  frame.mutable_segments(1)->set_class_id(65535);
  frame.mutable_depth_camera()->mutable_depth()->set_encoding(v1::Image::RAW_U8);
  frame.mutable_depth_camera()->mutable_color()->set_encoding(v1::Image::RAW_U8);
  EXPECT_EQ(BadFields(frame),
            (Set{"map_from_sensor", "segments[1].class_id", "depth_camera.depth", "depth_camera.color"}));
  frame.clear_depth_camera();
  EXPECT_EQ(BadFields(frame), (Set{"map_from_sensor", "segments[1].class_id", "sensor"}));
}

TEST(FrameFromProto, UsesTheLikeliestClassScoreIfNoClassIsGiven) {
  v1::Frame frame = CameraFrame();
  for (v1::Segment& segment : *frame.mutable_segments()) {
    for (const auto& [class_id, score] : {std::pair(3u, 0.25f), std::pair(7u, 0.5f)}) {
      segment.add_class_scores()->set_class_id(class_id);
      segment.mutable_class_scores()->rbegin()->set_score(score);
    }
  }
  const auto taken = FrameFromProto(frame);
  ASSERT_TRUE(taken.ok()) << taken.status().ToString();
  EXPECT_EQ(taken->segments[0].class_id, ClassId(0)) << "it is said";
  EXPECT_EQ(taken->segments[1].class_id, ClassId(7));
  const std::vector<ClassScore> scores{{ClassId(3), 0.25f}, {ClassId(7), 0.5f}};
  EXPECT_EQ(taken->segments[0].class_scores, scores);
  frame.mutable_segments(1)->mutable_class_scores(0)->set_class_id(65'535);
  EXPECT_EQ(BadFields(frame), Set{"segments[1].class_scores"});
  for (int i = 0; i < 64; ++i) frame.mutable_segments(0)->add_class_scores();
  EXPECT_EQ(BadFields(frame), (Set{"segments[0].class_scores", "segments[1].class_scores"}));
}

TEST(FrameFromProto, ATooLongSegmentTableIsOneViolation) {
  v1::Frame frame = CameraFrame();
  for (int i = 0; i < 70'000; ++i) frame.add_segments()->set_class_id(70'000);
  const auto result = FrameFromProto(frame);
  ASSERT_EQ(result.status().violations().size(), 1u);
  EXPECT_EQ(result.status().violations()[0].field, "segments");
}

TEST(FrameFromProto, TakesALidarFrame) {
  v1::Frame frame = LidarFrame();
  frame.mutable_lidar()->add_segment_ids(1);
  frame.mutable_lidar()->add_segment_ids(2);
  frame.mutable_lidar()->set_rgb("abcdef");
  const auto result = FrameFromProto(frame);
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  ASSERT_EQ(result->lidar->points_m.size(), 2u);
  EXPECT_EQ(result->lidar->points_m[1], Eigen::Vector3f(3, 4, 5));
  EXPECT_EQ(result->lidar->segments, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(result->lidar->color[1], (Color{'d', 'e', 'f'}));
}

TEST(FrameFromProto, ListsOfALidarFrameMustFit) {
  EXPECT_EQ(BadFieldsAfter(LidarFrame(), [](auto& f) { f.mutable_lidar()->add_packed_points_m(1); }),
            Set{"lidar.packed_points_m"});
  EXPECT_EQ(BadFieldsAfter(LidarFrame(), [](auto& f) { f.mutable_lidar()->clear_packed_points_m(); }),
            Set{"lidar.packed_points_m"});
  EXPECT_EQ(BadFieldsAfter(LidarFrame(), [](auto& f) { f.mutable_lidar()->add_segment_ids(1); }),
            Set{"lidar.segment_ids"});
  EXPECT_EQ(BadFieldsAfter(LidarFrame(), [](auto& f) { f.mutable_lidar()->set_rgb("abc"); }), Set{"lidar.rgb"});
  EXPECT_EQ(BadFieldsAfter(LidarFrame(), [](auto& f) { f.mutable_lidar()->mutable_camera(); }),
            (Set{"lidar.camera.image_from_lidar", "lidar.camera"}));
}

TEST(FrameFromProto, LidarPointsTakeIdsFromTheFramesCamera) {
  v1::Frame frame = LidarFrame();  // points (0, 1, 2) and (3, 4, 5)
  auto* camera = frame.mutable_lidar()->mutable_camera();
  for (const double value : {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}) camera->add_image_from_lidar(value);
  camera->set_width_px(2);
  camera->set_height_px(2);
  SetRaw(std::vector<std::uint8_t>{9, 9, 9, 9}, v1::Image::RAW_U8, camera->mutable_segments());
  const auto result = FrameFromProto(frame);
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(result->lidar->segments, std::vector<std::uint32_t>(result->lidar->points_m.size(), 9));
  EXPECT_FALSE(result->lidar->points_m.empty());
  frame.mutable_lidar()->add_segment_ids(1);
  frame.mutable_lidar()->add_segment_ids(2);
  EXPECT_EQ(BadFields(frame), Set{"lidar.segment_ids"});
  frame.mutable_lidar()->clear_segment_ids();
  camera->mutable_segments()->set_data("x");
  EXPECT_EQ(BadFields(frame), Set{"lidar.camera.segments"});
}

TEST(PoseConversion, IsItsOwnInverse) {
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(1, -2, 3);
  T.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto back = TransformFromProto(ToProto(T), "pose");
  ASSERT_TRUE(back.ok());
  EXPECT_TRUE(IsIdentity(T.inverse() * *back, 1e-12));
  EXPECT_TRUE(IsIdentity(*TransformFromProto({}, "pose")));
}

TEST(DecodedBytes, FollowTheDeclaredSizesOfAFrame) {
  EXPECT_GE(DecodedBytes(CameraFrame()), kNumPixels * (sizeof(float) + sizeof(Color) + sizeof(std::uint32_t)));
  EXPECT_GE(DecodedBytes(LidarFrame()), 2 * (sizeof(Eigen::Vector3f) + sizeof(std::uint32_t)));
  v1::Frame large = CameraFrame();
  large.mutable_depth_camera()->mutable_camera()->set_width_px(4000);
  large.mutable_depth_camera()->mutable_camera()->set_height_px(3000);
  EXPECT_GE(DecodedBytes(large), 11u * 4000 * 3000);
  large.mutable_depth_camera()->mutable_camera()->set_width_px(-1);
  EXPECT_EQ(DecodedBytes(large), 0u) << "refused for its size, not for want of room";
  large.mutable_depth_camera()->mutable_camera()->set_width_px(std::numeric_limits<int>::max());
  EXPECT_EQ(DecodedBytes(large), 0u);
  for (int i = 0; i < 64; ++i) large.mutable_segments(0)->add_class_scores();
  EXPECT_GE(DecodedBytes(large), 64 * sizeof(ClassScore));
  EXPECT_EQ(DecodedBytes({}), 0u);
}

}  // namespace
}  // namespace dhpmap
