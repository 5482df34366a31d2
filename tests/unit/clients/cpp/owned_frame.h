// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "dhpmap/client.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {

/// Frame i of a walk around TestScene, with the memory that it needs.
struct OwnedFrame {
  explicit OwnedFrame(int i) {
    const v1::Frame wire = TestFrame(i);
    const v1::DepthCameraFrame& images = wire.depth_camera();
    const auto& pinhole = images.camera();
    camera = {pinhole.width_px(), pinhole.height_px(), pinhole.fx_px(),
              pinhole.fy_px(),    pinhole.cx_px(),     pinhole.cy_px()};
    const auto num_pixels = static_cast<std::size_t>(camera.width_px * camera.height_px);
    depth_m.resize(num_pixels);
    std::memcpy(depth_m.data(), images.depth().data().data(), num_pixels * sizeof(float));
    std::vector<std::uint32_t> ids(num_pixels);
    std::memcpy(ids.data(), images.segments().data().data(), num_pixels * sizeof(std::uint32_t));
    labels.assign(ids.begin(), ids.end());
    rgb.assign(images.color().data().begin(), images.color().data().end());
    for (const v1::Segment& its : wire.segments()) segments.push_back({its.id(), its.class_id(), its.score()});
    Eigen::Matrix4d T;
    for (int k = 0; k < 16; ++k) T(k / 4, k % 4) = wire.map_from_sensor_matrix(k);
    const Eigen::Quaterniond q(Eigen::Matrix3d(T.topLeftCorner<3, 3>()));
    frame = {depth_m,        rgb, labels, segments, {{T(0, 3), T(1, 3), T(2, 3)}, {q.x(), q.y(), q.z(), q.w()}},
             wire.stamp_ns()};
  }
  OwnedFrame(const OwnedFrame&) = delete;
  OwnedFrame& operator=(const OwnedFrame&) = delete;

  client::Camera camera;
  std::vector<float> depth_m;
  std::vector<std::uint16_t> labels;
  std::vector<std::uint8_t> rgb;
  std::vector<client::Segment> segments;
  client::RgbdFrame frame;
};

/// "maps/fed", empty, over the classes of TestScene.
inline client::Map CreateFedRoom(const client::Client& connection) {
  client::NewMap map{.title = "Room", .voxel_size_m = 0.05, .truncation_m = 0.1};
  for (const int id : {1, 2, 3}) {
    map.classes.push_back({id, "class " + std::to_string(id), id < 3 ? client::Kind::kThing : client::Kind::kStuff,
                           client::Label::Size::kSmall});
  }
  auto created = connection.CreateMap("fed", map);
  EXPECT_OK(created);
  return *std::move(created);
}

}  // namespace dhpmap::testing
