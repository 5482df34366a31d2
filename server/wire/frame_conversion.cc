// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/frame_conversion.h"

#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "mapping/sensor/lidar_projection.h"
#include "proto/types/label_conversion.h"
#include "proto/types/pose_conversion.h"
#include "server/wire/image_conversion.h"

namespace dhpmap {
namespace {

constexpr int kMaxSide_px = 16384;
/// Depth, colour and segment, plus an image under conversion.
constexpr std::size_t kBytesAPixel = 16, kBytesAPoint = 24;

/// The wire name of a field in mapping and of all fields below it.
struct Term {
  std::string_view domain, wire;
};

/// Fields of PanopticFrame; names that are not listed are equal.
constexpr Term kFrameTerms[] = {
    {"T_map_sensor", "map_from_sensor"},
    {"camera.camera", "depth_camera.camera"},
    {"camera.depth_m", "depth_camera.depth"},
    {"camera.color", "depth_camera.color"},
    {"camera.segments", "depth_camera.segments"},
    {"lidar.points_m", "lidar.packed_points_m"},
    {"lidar.color", "lidar.rgb"},
    {"lidar.segments", "lidar.segment_ids"},
};

/// Arguments of ProjectImagesOntoScan.
constexpr Term kLidarCameraTerms[] = {
    {"camera.P_image_lidar", "lidar.camera.image_from_lidar"},
    {"camera", "lidar.camera"},
    {"color", "lidar.camera.color"},
    {"segments", "lidar.camera.segments"},
    {"scan.color", "lidar.rgb"},
    {"scan.segments", "lidar.segment_ids"},
};

std::string Rename(const std::string& field, std::span<const Term> terms) {
  for (const Term& term : terms) {
    if (!field.starts_with(term.domain)) continue;
    const std::string rest = field.substr(term.domain.size());
    if (rest.empty() || rest[0] == '.' || rest[0] == '[') return std::string(term.wire) + rest;
  }
  return field;
}

Status Renamed(const Status& status, std::span<const Term> terms) {
  Status renamed = Status(status.code(), status.message()).WithReason(status.reason());
  for (const FieldViolation& violation : status.violations()) {
    renamed.AddViolation(Rename(violation.field, terms), violation.description);
  }
  for (const auto& [key, value] : status.metadata()) renamed = Status(renamed).WithMetadata(key, value);
  return renamed;
}

/// Adds the violations of `status` to `bad`; if it has none, adds its message for `field`.
void Collect(const Status& status, const std::string& field, Status& bad) {
  for (const FieldViolation& violation : status.violations()) bad.AddViolation(violation.field, violation.description);
  if (!status.ok() && status.violations().empty()) bad.AddViolation(field, status.message());
}

/// Returns the value, or an empty one after adding the error to `bad`.
template <typename T>
T Take(Result<T> result, const std::string& field, Status& bad) {
  if (result.ok()) return std::move(*result);
  Collect(result.status(), field, bad);
  return {};
}

Transform PoseOf(const v1::Frame& frame, Status& bad) {
  const auto& values = frame.map_from_sensor_matrix();
  Result<Transform> T = Transform(Transform::Identity());
  if (values.empty() == !frame.has_map_from_sensor()) {
    bad.AddViolation("map_from_sensor", "exactly one of map_from_sensor and map_from_sensor_matrix must be set");
  } else if (frame.has_map_from_sensor()) {
    T = TransformFromProto(frame.map_from_sensor(), "map_from_sensor");
  } else if (values.size() != 16) {
    bad.AddViolation("map_from_sensor_matrix", "has " + std::to_string(values.size()) + " values, not 16");
  } else {
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(values.data());
    T = TransformFromMatrix(matrix, "map_from_sensor_matrix");
  }
  if (T.ok()) return *T;
  Collect(T.status(), "map_from_sensor", bad);
  return Transform::Identity();
}

constexpr int kMaxSegments = 1 << 16;
constexpr std::size_t kMaxScoresAFrame = std::size_t{1} << 18;

std::size_t NumClassScores(const v1::Frame& frame) {
  std::size_t num_scores = 0;
  for (const v1::Segment& segment : frame.segments())
    num_scores += static_cast<std::size_t>(segment.class_scores_size());
  return num_scores;
}

std::vector<ClassScore> ClassScoresOf(const v1::Segment& segment, const std::string& field, Status& bad) {
  std::vector<ClassScore> scores;
  const auto num_scores = static_cast<std::size_t>(segment.class_scores_size());
  if (num_scores > kMostClassScores) {
    bad.AddViolation(field,
                     "has " + std::to_string(num_scores) + " classes, more than " + std::to_string(kMostClassScores));
    return scores;
  }
  scores.reserve(num_scores);
  for (const v1::ClassScore& entry : segment.class_scores()) {
    if (const auto class_id = ClassIdFromProto(entry.class_id())) scores.push_back({*class_id, entry.score()});
    else bad.AddViolation(field, "class " + std::to_string(entry.class_id()) + " is not within 0 and 65534");
  }
  return scores;
}

std::vector<SegmentInfo> SegmentTableOf(const v1::Frame& frame, Status& bad) {
  std::vector<SegmentInfo> table;
  if (frame.segments_size() > kMaxSegments) {
    bad.AddViolation("segments", "has " + std::to_string(frame.segments_size()) + " rows, more than " +
                                     std::to_string(kMaxSegments));
    return table;
  }
  if (NumClassScores(frame) > kMaxScoresAFrame) {
    bad.AddViolation("segments", "have more than " + std::to_string(kMaxScoresAFrame) + " class_scores");
    return table;
  }
  table.reserve(static_cast<std::size_t>(frame.segments_size()));
  for (int i = 0; i < frame.segments_size(); ++i) {
    const v1::Segment& segment = frame.segments(i);
    const std::string field = "segments[" + std::to_string(i) + "]";
    SegmentInfo info{.id = SegmentId(segment.id()),
                     .score = segment.has_score() ? std::optional(segment.score()) : std::nullopt,
                     .class_scores = ClassScoresOf(segment, field + ".class_scores", bad)};
    if (segment.has_class_id() && !ClassIdFromProto(segment.class_id())) {
      bad.AddViolation(field + ".class_id", std::to_string(segment.class_id()) + " is not within 0 and 65534");
    } else {
      info.class_id = segment.has_class_id() ? ClassIdFromProto(segment.class_id()) : LikeliestClass(info.class_scores);
    }
    table.push_back(std::move(info));
  }
  return table;
}

DepthCameraData CameraDataOf(const v1::DepthCameraFrame& frame, Status& bad) {
  const v1::PinholeCamera& camera = frame.camera();
  DepthCameraData data;
  data.camera = {.width_px = camera.width_px(),
                 .height_px = camera.height_px(),
                 .fx_px = camera.fx_px(),
                 .fy_px = camera.fy_px(),
                 .cx_px = camera.cx_px(),
                 .cy_px = camera.cy_px()};
  const Status usable = data.camera.Validate();
  for (const FieldViolation& violation : usable.violations()) {
    bad.AddViolation("depth_camera.camera." + violation.field, violation.description);
  }
  if (!usable.ok()) return data;  // sizes of images would be checked against invalid ones
  const int width_px = camera.width_px(), height_px = camera.height_px();
  data.depth_m = Take(DepthFromProto(frame.depth(), width_px, height_px, "depth_camera.depth"), "depth", bad);
  if (frame.has_color()) {
    data.color = Take(ColorFromProto(frame.color(), width_px, height_px, "depth_camera.color"), "color", bad).pixels;
  }
  if (frame.has_segments()) {
    data.segments =
        Take(SegmentsFromProto(frame.segments(), width_px, height_px, "depth_camera.segments"), "segments", bad).pixels;
  }
  return data;
}

/// Sets colour and ids of the points from the images of the camera next to the LiDAR.
void UseLidarCamera(const v1::LidarFrame& frame, LidarData& data, Status& bad) {
  const v1::LidarCamera& camera = frame.camera();
  if (camera.image_from_lidar_size() != 12) {
    bad.AddViolation("lidar.camera.image_from_lidar",
                     "has " + std::to_string(camera.image_from_lidar_size()) + " values, not 12");
  }
  const int width_px = camera.width_px(), height_px = camera.height_px();
  if (width_px < 1 || width_px > kMaxSide_px || height_px < 1 || height_px > kMaxSide_px) {
    bad.AddViolation("lidar.camera", "width_px or height_px is not within 1 and 16384");
  }
  if (camera.has_segments() && frame.segment_ids_size() > 0) {
    bad.AddViolation("lidar.segment_ids", "must be empty where lidar.camera.segments is set");
  }
  if (!bad.violations().empty()) return;
  Image<Color> color;
  Image<std::uint32_t> segments;
  if (camera.has_color()) {
    color = Take(ColorFromProto(camera.color(), width_px, height_px, "lidar.camera.color"), "color", bad);
  }
  if (camera.has_segments()) {
    segments =
        Take(SegmentsFromProto(camera.segments(), width_px, height_px, "lidar.camera.segments"), "segments", bad);
  }
  if (!bad.violations().empty()) return;
  const LidarCamera projection{
      .P_image_lidar = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(camera.image_from_lidar().data()),
      .width_px = width_px,
      .height_px = height_px};
  Collect(Renamed(ProjectImagesOntoScan(projection, color, segments, data), kLidarCameraTerms), "lidar.camera", bad);
}

LidarData LidarDataOf(const v1::LidarFrame& frame, Status& bad) {
  LidarData data;
  const auto num_values = static_cast<std::size_t>(frame.packed_points_m_size());
  const std::size_t num_points = num_values / 3;
  if (num_values == 0 || num_values % 3 != 0) {
    bad.AddViolation("lidar.packed_points_m", "has " + std::to_string(num_values) + " values, not three a point");
  }
  if (frame.segment_ids_size() > 0 && static_cast<std::size_t>(frame.segment_ids_size()) != num_points) {
    bad.AddViolation("lidar.segment_ids", "has " + std::to_string(frame.segment_ids_size()) + " values for " +
                                              std::to_string(num_points) + " points");
  }
  if (!frame.rgb().empty() && frame.rgb().size() != 3 * num_points) {
    bad.AddViolation("lidar.rgb", "has " + std::to_string(frame.rgb().size()) + " bytes for " +
                                      std::to_string(num_points) + " points");
  }
  if (!bad.violations().empty()) return data;
  data.points_m.resize(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    const float* xyz = frame.packed_points_m().data() + 3 * i;
    data.points_m[i] = {xyz[0], xyz[1], xyz[2]};
  }
  data.segments.assign(frame.segment_ids().begin(), frame.segment_ids().end());
  data.color.resize(frame.rgb().size() / 3);
  if (!data.color.empty()) std::memcpy(static_cast<void*>(data.color.data()), frame.rgb().data(), frame.rgb().size());
  if (frame.has_camera()) UseLidarCamera(frame, data, bad);
  return data;
}

}  // namespace

Status InWireTerms(const Status& status) { return Renamed(status, kFrameTerms); }

std::size_t DecodedBytes(const v1::Frame& frame) {
  const v1::LidarFrame& lidar = frame.lidar();
  const std::size_t points = kBytesAPoint * static_cast<std::size_t>(lidar.packed_points_m_size()) / 3;
  const auto pixels = [](const auto& camera) -> std::size_t {
    const std::int64_t width_px = camera.width_px(), height_px = camera.height_px();
    if (width_px < 1 || width_px > kMaxSide_px || height_px < 1 || height_px > kMaxSide_px) return 0;
    return kBytesAPixel * static_cast<std::size_t>(width_px * height_px);
  };
  const std::size_t scores = sizeof(ClassScore) * NumClassScores(frame);
  return points + pixels(frame.depth_camera().camera()) + pixels(lidar.camera()) + scores;
}

Result<PanopticFrame> FrameFromProto(const v1::Frame& frame) {
  Status bad = InvalidArgument("the frame is not usable").WithReason("BAD_FRAME");
  PanopticFrame result;
  result.stamp_ns = frame.stamp_ns();
  result.T_map_sensor = PoseOf(frame, bad);
  result.segments = SegmentTableOf(frame, bad);
  result.has_persistent_ids = frame.persistent_ids();
  result.unlisted_ids_are_unknown = frame.allow_unlisted_ids();
  switch (frame.sensor_case()) {
    case v1::Frame::kDepthCamera: result.camera = CameraDataOf(frame.depth_camera(), bad); break;
    case v1::Frame::kLidar: result.lidar = LidarDataOf(frame.lidar(), bad); break;
    case v1::Frame::SENSOR_NOT_SET: bad.AddViolation("sensor", "has neither depth_camera nor lidar"); break;
  }
  if (!bad.violations().empty()) return bad;
  return result;
}

}  // namespace dhpmap
