// SPDX-License-Identifier: BSD-3-Clause
// A message of IntegrateFrames, from its bytes up to fusion: refused, or fused into a map that can be published.
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/grid_reach.h"
#include "mapping/pipeline/map_builder.h"
#include "server/wire/frame_conversion.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMaxDecodedBytes = 16u << 20;  // larger ones are right, but slow

MapInfo Info() {
  const std::vector<LabelClass> classes = {{.id = ClassId(1), .name = "chair", .panoptic = Panoptic::kThing},
                                           {.id = ClassId(2), .name = "floor", .panoptic = Panoptic::kStuff}};
  MapInfo info;
  info.name = "fuzz";
  info.label_set = std::make_shared<const LabelSet>(LabelSet::Create(classes).value());
  info.config.tracking.min_points_medium = info.config.tracking.min_points_stuff = 1;
  return info;
}

void SetPose(v1::Frame& frame, double x_m = 0) {
  for (int i = 0; i < 16; ++i) frame.add_map_from_sensor_matrix(i % 5 == 0 ? 1 : 0);
  frame.set_map_from_sensor_matrix(3, x_m);
}

void AddSegments(v1::Frame& frame) {
  for (const std::uint32_t id : {1u, 2u}) {
    v1::Segment& segment = *frame.add_segments();
    segment.set_id(id);
    segment.set_class_id(id);
    segment.set_score(0.5f);
  }
}

std::string LidarSeed(double x_m) {
  v1::IntegrateFramesRequest request;
  v1::Frame& frame = *request.mutable_frame();
  SetPose(frame, x_m);
  AddSegments(frame);
  for (const float value : {1.0f, 0.2f, 0.1f, 1.5f, 0.3f, -0.1f, 2.0f, 0.0f, 0.0f})
    frame.mutable_lidar()->add_packed_points_m(value);
  for (const std::uint32_t id : {1u, 2u, 0u}) frame.mutable_lidar()->add_segment_ids(id);
  frame.mutable_lidar()->set_rgb("abcdefghi");
  return request.SerializeAsString();
}

/// What a seed has as its images, all of kWidth_px x kHeight_px.
struct Images {
  v1::Image depth, color, segments;
};

constexpr int kWidth_px = 3, kHeight_px = 2;

v1::Image ImageOf(v1::Image::Encoding encoding, std::string data) {
  v1::Image image;
  image.set_encoding(encoding);
  image.set_data(std::move(data));
  return image;
}

v1::Image FileOf(const char* extension, const cv::Mat& pixels) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, pixels, bytes);
  return ImageOf(v1::Image::FILE, {bytes.begin(), bytes.end()});
}

Images RawImages() {
  return {.depth = ImageOf(v1::Image::RAW_U16, std::string("\xe8\3\xe8\3\xd0\7\0\0\xff\xff\xb8\x0b", 12)),
          .color = ImageOf(v1::Image::RAW_RGB8, "abcdefghijklmnopqr"),
          .segments = ImageOf(v1::Image::RAW_U8, std::string("\1\1\2\2\0\1", 6))};
}

/// Files, so that what decodes them is reached too.
Images FileImages(const char* depth, const char* color, const char* segments) {
  const cv::Mat millimetres(kHeight_px, kWidth_px, CV_16UC1, cv::Scalar(1500));
  const cv::Mat green(kHeight_px, kWidth_px, CV_8UC3, cv::Scalar(10, 200, 30));
  cv::Mat ids(kHeight_px, kWidth_px, CV_8UC1, cv::Scalar(1));
  ids.row(1) = 2;
  return {.depth = FileOf(depth, millimetres), .color = FileOf(color, green), .segments = FileOf(segments, ids)};
}

std::string CameraSeed(Images images) {
  v1::IntegrateFramesRequest request;
  request.set_map("maps/a");
  v1::Frame& frame = *request.mutable_frame();
  SetPose(frame);
  AddSegments(frame);
  v1::DepthCameraFrame& camera = *frame.mutable_depth_camera();
  camera.mutable_camera()->set_width_px(kWidth_px);
  camera.mutable_camera()->set_height_px(kHeight_px);
  camera.mutable_camera()->set_fx_px(2);
  camera.mutable_camera()->set_fy_px(2);
  camera.mutable_camera()->set_cx_px(1);
  camera.mutable_camera()->set_cy_px(0.5);
  *camera.mutable_depth() = std::move(images.depth);
  camera.mutable_depth()->set_scale_m(0.001);
  *camera.mutable_color() = std::move(images.color);
  *camera.mutable_segments() = std::move(images.segments);
  fuzz::Require(FrameFromProto(frame).ok());  // or nothing behind its images would be reached
  return request.SerializeAsString();
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  std::vector<std::string> seeds = {CameraSeed(RawImages()), CameraSeed(FileImages(".png", ".jpg", ".png")),
                                    CameraSeed(FileImages(".tiff", ".png", ".tiff"))};
  // Where the map begins, at both sides of the reach of its grid, at the end of its indices, and beyond all of them.
  const double reach_m = GridReach_m(MapConfig().voxel_size_m);
  for (const double x_m : {0.0, 0.999 * reach_m, -0.999 * reach_m, 1.001 * reach_m, -4.0 * reach_m, 1e300}) {
    seeds.push_back(LidarSeed(x_m));
  }
  return seeds;
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  v1::IntegrateFramesRequest request;
  if (!request.ParseFromArray(data, static_cast<int>(size))) return 0;
  if (DecodedBytes(request.frame()) > kMaxDecodedBytes) return 0;
  const Result<PanopticFrame> frame = FrameFromProto(request.frame());
  if (!frame.ok()) return 0;
  MapBuilder builder(Info(), 1);
  const Result<FrameReport> report = builder.Integrate(*frame);
  if (!report.ok()) return 0;
  fuzz::Require(report->num_unknown_points <= report->num_points);
  (void)builder.Finish();
  fuzz::Require(builder.map().Publish(1) != nullptr);
  return 0;
}
