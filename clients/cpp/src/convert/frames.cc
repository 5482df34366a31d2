// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/frames.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/src/convert/geometry.h"

namespace dhpmap::client {
namespace {

static_assert(std::endian::native == std::endian::little, "images are sent as they are in memory");

constexpr double kMostMetres = 200;     // a median depth above it is probably in millimetres
constexpr double kLeastOffEdge = 0.15;  // of the image size: a principal point nearer to an edge is for another size
constexpr std::size_t kSampleStep = 61;

template <typename T>
std::string Octets(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

Status CheckPose(const char* name, const Pose& pose) {
  double norm = 0;
  for (const double value : pose.rotation_xyzw) norm += value * value;
  const Vector3& t = pose.translation_m;
  if (!std::isfinite(norm + t.x + t.y + t.z)) return BadArgument(name, "is not finite");
  if (norm < 1e-12) return BadArgument(name, "its quaternion is 0");
  return {};
}

Status CheckStamp(std::int64_t stamp_ns, std::optional<std::int64_t> last_ns) {
  if (!last_ns || stamp_ns > *last_ns) return {};
  return BadArgument("stamp_ns", std::to_string(stamp_ns) + " is not after that of the frame before, " +
                                     std::to_string(*last_ns) + "; stamps go up, in nanoseconds");
}

Status CheckSize(const char* name, std::size_t size, std::size_t wanted, bool may_be_empty = true) {
  if (size == wanted || (may_be_empty && size == 0)) return {};
  return BadArgument(name, "has " + std::to_string(size) + " values, wanted " + std::to_string(wanted));
}

Status CheckDepth(std::span<const float> depth_m) {
  std::vector<float> sample;
  for (std::size_t i = 0; i < depth_m.size(); i += kSampleStep) {
    if (std::isfinite(depth_m[i]) && depth_m[i] > 0) sample.push_back(depth_m[i]);
  }
  if (sample.empty()) return {};
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  if (*middle <= kMostMetres) return {};
  return BadArgument("depth_m", "has a median of " + std::to_string(*middle) + " m: divide millimetres by 1000");
}

Status FirstError(std::initializer_list<Status> statuses) {
  for (const Status& status : statuses) {
    if (!status.ok()) return status;
  }
  return {};
}

v1::Frame Head(const Pose& T_map_sensor, std::int64_t stamp_ns, std::span<const Segment> segments) {
  v1::Frame out;
  out.set_stamp_ns(stamp_ns);
  *out.mutable_map_from_sensor() = ToProto(T_map_sensor);
  out.set_allow_unlisted_ids(true);
  for (const Segment& segment : segments) {
    v1::Segment& its = *out.add_segments();
    its.set_id(segment.id);
    if (segment.class_id) its.set_class_id(*segment.class_id);
    if (segment.score) its.set_score(static_cast<float>(*segment.score));
  }
  return out;
}

void SetImage(v1::Image::Encoding encoding, std::string data, v1::Image& out) {
  out.set_encoding(encoding);
  out.set_data(std::move(data));
}

}  // namespace

Status CheckCamera(const Camera& camera) {
  if (camera.width_px <= 0 || camera.height_px <= 0) return BadArgument("camera", "has no size");
  if (!(camera.fx_px > 0 && camera.fy_px > 0)) return BadArgument("camera", "fx_px and fy_px must be above 0");
  for (const double share : {camera.cx_px / camera.width_px, camera.cy_px / camera.height_px}) {
    if (!(share >= kLeastOffEdge && share <= 1 - kLeastOffEdge)) {
      return BadArgument("camera", "the principal point is far from the middle: are the intrinsics of another size?");
    }
  }
  return {};
}

Result<v1::Frame> ToProto(const RgbdFrame& frame, const Camera& camera, std::optional<std::int64_t> last_stamp_ns) {
  const std::size_t num_pixels = static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  Status status =
      FirstError({CheckSize("depth_m", frame.depth_m.size(), num_pixels, false),
                  CheckSize("rgb", frame.rgb.size(), 3 * num_pixels),
                  CheckSize("labels", frame.labels.size(), num_pixels), CheckPose("T_map_camera", frame.T_map_camera),
                  CheckStamp(frame.stamp_ns, last_stamp_ns), CheckDepth(frame.depth_m)});
  if (!status.ok()) return status;
  v1::Frame out = Head(frame.T_map_camera, frame.stamp_ns, frame.segments);
  v1::DepthCameraFrame& images = *out.mutable_depth_camera();
  v1::PinholeCamera& pinhole = *images.mutable_camera();
  pinhole.set_width_px(camera.width_px);
  pinhole.set_height_px(camera.height_px);
  pinhole.set_fx_px(camera.fx_px);
  pinhole.set_fy_px(camera.fy_px);
  pinhole.set_cx_px(camera.cx_px);
  pinhole.set_cy_px(camera.cy_px);
  SetImage(v1::Image::RAW_F32, Octets(frame.depth_m), *images.mutable_depth());
  if (!frame.rgb.empty()) SetImage(v1::Image::RAW_RGB8, Octets(frame.rgb), *images.mutable_color());
  if (!frame.labels.empty()) SetImage(v1::Image::RAW_U16, Octets(frame.labels), *images.mutable_segments());
  return out;
}

Result<v1::Frame> ToProto(const LidarFrame& frame, std::optional<std::int64_t> last_stamp_ns) {
  const std::size_t num_points = frame.points_m.size() / 3;
  Status status = FirstError({CheckSize("points_m", frame.points_m.size(), 3 * num_points),
                              CheckSize("segment_ids", frame.segment_ids.size(), num_points),
                              CheckSize("rgb", frame.rgb.size(), 3 * num_points),
                              CheckPose("T_map_lidar", frame.T_map_lidar), CheckStamp(frame.stamp_ns, last_stamp_ns)});
  if (!status.ok()) return status;
  v1::Frame out = Head(frame.T_map_lidar, frame.stamp_ns, frame.segments);
  v1::LidarFrame& scan = *out.mutable_lidar();
  scan.mutable_packed_points_m()->Add(frame.points_m.begin(), frame.points_m.end());
  scan.mutable_segment_ids()->Add(frame.segment_ids.begin(), frame.segment_ids.end());
  scan.set_rgb(Octets(frame.rgb));
  return out;
}

}  // namespace dhpmap::client
