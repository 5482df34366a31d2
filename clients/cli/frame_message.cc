// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_message.h"

namespace dhpmap {
namespace {

void Fill(const ImageFile& file, v1::Image& out) {
  out.set_encoding(v1::Image::FILE);
  out.set_data(file.bytes.data(), file.bytes.size());
  out.set_scale_m(file.scale_m);
}

void Fill(const DatasetFrame::DepthCamera& in, v1::DepthCameraFrame& out) {
  v1::PinholeCamera& camera = *out.mutable_camera();
  camera.set_width_px(in.camera.width_px);
  camera.set_height_px(in.camera.height_px);
  camera.set_fx_px(in.camera.fx_px);
  camera.set_fy_px(in.camera.fy_px);
  camera.set_cx_px(in.camera.cx_px);
  camera.set_cy_px(in.camera.cy_px);
  Fill(in.depth, *out.mutable_depth());
  if (!in.color.bytes.empty()) Fill(in.color, *out.mutable_color());
  if (!in.segments.bytes.empty()) Fill(in.segments, *out.mutable_segments());
}

void Fill(const DatasetFrame::Lidar& in, v1::LidarFrame& out) {
  out.mutable_packed_points_m()->Reserve(static_cast<int>(3 * in.points_m.size()));
  for (const Eigen::Vector3f& point : in.points_m) {
    for (int axis = 0; axis < 3; ++axis) out.add_packed_points_m(point[axis]);
  }
  out.mutable_segment_ids()->Assign(in.segments.begin(), in.segments.end());
  if (in.image_width_px == 0) return;
  v1::LidarCamera& camera = *out.mutable_camera();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) camera.add_image_from_lidar(in.P_image_lidar(row, column));
  }
  camera.set_width_px(in.image_width_px);
  camera.set_height_px(in.image_height_px);
  if (!in.color.bytes.empty()) Fill(in.color, *camera.mutable_color());
  if (!in.segment_image.bytes.empty()) Fill(in.segment_image, *camera.mutable_segments());
}

}  // namespace

v1::Frame ToMessage(const DatasetFrame& frame, bool has_persistent_ids) {
  v1::Frame out;
  out.set_stamp_ns(frame.stamp_ns);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) out.add_map_from_sensor_matrix(frame.T_map_sensor(row, column));
  }
  if (frame.camera) Fill(*frame.camera, *out.mutable_depth_camera());
  if (frame.lidar) Fill(*frame.lidar, *out.mutable_lidar());
  for (const SegmentInfo& segment : frame.segments) {
    v1::Segment& row = *out.add_segments();
    row.set_id(segment.id.value);
    if (segment.class_id) row.set_class_id(segment.class_id->value);
    if (segment.score) row.set_score(*segment.score);
    for (const ClassScore& entry : segment.class_scores) {
      v1::ClassScore& score = *row.add_class_scores();
      score.set_class_id(entry.class_id.value);
      score.set_score(entry.score);
    }
  }
  out.set_persistent_ids(has_persistent_ids);
  out.set_allow_unlisted_ids(true);
  return out;
}

}  // namespace dhpmap
