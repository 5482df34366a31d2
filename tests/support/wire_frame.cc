// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/wire_frame.h"

namespace dhpmap::testing {
namespace {

template <typename Values>
void SetRaw(const Values& values, v1::Image::Encoding encoding, v1::Image* image) {
  image->set_encoding(encoding);
  image->set_data(values.data(), values.size() * sizeof(values[0]));
}

}  // namespace

v1::Frame ToWire(const PanopticFrame& rendered) {
  const DepthCameraData& data = *rendered.camera;
  v1::Frame frame;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) frame.add_map_from_sensor_matrix(rendered.T_map_sensor.matrix()(row, col));
  }
  v1::PinholeCamera* camera = frame.mutable_depth_camera()->mutable_camera();
  camera->set_width_px(data.camera.width_px);
  camera->set_height_px(data.camera.height_px);
  camera->set_fx_px(data.camera.fx_px);
  camera->set_fy_px(data.camera.fy_px);
  camera->set_cx_px(data.camera.cx_px);
  camera->set_cy_px(data.camera.cy_px);
  SetRaw(data.depth_m, v1::Image::RAW_F32, frame.mutable_depth_camera()->mutable_depth());
  SetRaw(data.color, v1::Image::RAW_RGB8, frame.mutable_depth_camera()->mutable_color());
  SetRaw(data.segments, v1::Image::RAW_U32, frame.mutable_depth_camera()->mutable_segments());
  return frame;
}

}  // namespace dhpmap::testing
