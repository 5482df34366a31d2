// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/support/wire_frame.h"

// A room through which a depth camera walks to and fro, and from which a chair is removed. The scene is that of the
// tests of gone surfaces (tests/unit/mapping/pipeline/gone_scene.h), as a client would send it.

namespace dhpmap::testing {

inline constexpr int kChairClass = 1, kCrateClass = 2;
inline const Eigen::Vector3d kChairMiddle_m(1.7, 0.2, 0.4), kCrateMiddle_m(1.2, 1.3, 0.3);

/// Open towards -x, with walls at x = 3 and y = 2. The chair is 0.5 x 0.5 x 0.8 m, the crate 0.5 x 0.5 x 0.6 m. Neither
/// ever hides the middle of the other, which would split it into two objects.
inline Scene WalkedRoom(bool has_chair, bool has_crate = false) {
  using Shape = Solid::Shape;
  Scene room{{{.shape = Shape::kHalfSpace, .center_m = {0, 0, 0}, .size_m = {0, 0, 1}, .segment = 4},
              {.shape = Shape::kHalfSpace, .center_m = {3, 0, 0}, .size_m = {-1, 0, 0}, .segment = 3},
              {.shape = Shape::kHalfSpace, .center_m = {0, 2, 0}, .size_m = {0, -1, 0}, .segment = 3}}};
  if (has_chair) {
    room.solids.push_back(
        {.shape = Shape::kBox, .center_m = kChairMiddle_m, .size_m = {0.25, 0.25, 0.4}, .segment = kChairClass});
  }
  if (has_crate) {
    room.solids.push_back(
        {.shape = Shape::kBox, .center_m = kCrateMiddle_m, .size_m = {0.25, 0.25, 0.3}, .segment = kCrateClass});
  }
  return room;
}

inline std::int64_t WalkStamp_ns(int i) { return 1'000'000'000LL + 100'000'000LL * i; }

/// Frame `i` of the walk.
inline v1::Frame WalkFrame(const Scene& scene, int i) {
  const double angle = 0.8 * std::sin(0.3 * i);
  const Eigen::Vector3d eye_m(1.7 - 2.0 * std::cos(angle), 0.2 - 2.0 * std::sin(angle), 1.3);
  v1::Frame frame = ToWire(Render(scene, {200, 150, 130, 130, 100, 75}, LookAt(eye_m, {1.8, 0.2, 0.5})));
  frame.set_stamp_ns(WalkStamp_ns(i));
  for (std::uint32_t id = 1; id <= 5; ++id) {
    v1::Segment* segment = frame.add_segments();
    segment->set_id(id);
    segment->set_class_id(id);
  }
  return frame;
}

inline void CreateWalkedMap(TestServer& server, const std::string& map_id) {
  v1::CreateMapRequest request;
  request.set_map_id(map_id);
  request.mutable_config()->mutable_tracking()->set_min_points_medium(50);
  request.mutable_config()->mutable_tracking()->set_min_points_stuff(100);
  request.mutable_config()->mutable_refinement()->set_every_frames(0);
  const std::shared_ptr<const LabelSet> label_set = MakeLabelSet(2, 3);
  for (const LabelClass& c : label_set->classes()) {
    v1::LabelClass* label = request.add_label_classes();
    label->set_id(c.id.value);
    label->set_name(c.name);
    label->set_kind(c.panoptic == Panoptic::kThing ? v1::LabelClass::THING : v1::LabelClass::STUFF);
  }
  ASSERT_OK(server.Call(&MapStub::CreateMap, request));
}

/// Sends frames [begin, end) of the walk through the present scene; returns once they are stored.
inline void Walk(TestServer& server, const std::string& map_id, const Scene& scene, int begin, int end) {
  const FeedResult fed = Feed(*server.mapping, map_id, begin, end, [&scene](int i) { return WalkFrame(scene, i); });
  for (const auto& ack : fed.acks) EXPECT_EQ(ack.error().code(), 0) << ack.error().message();
  ASSERT_OK(fed);
}

/// The only object of a class; an empty one if there is not exactly one.
inline v1::Submap ListedOfClass(TestServer& server, const std::string& map_id, int class_id) {
  v1::ListSubmapsRequest request;
  request.set_parent("maps/" + map_id);
  request.add_class_ids(class_id);
  const auto response = server.Call(&SubmapStub::ListSubmaps, request).value();
  EXPECT_EQ(response.submaps_size(), 1) << response.DebugString();
  return response.submaps_size() == 1 ? response.submaps(0) : v1::Submap();
}

/// The vertices of the mesh of a map or an object.
inline std::vector<Eigen::Vector3f> MeshVerticesOf(TestServer& server, const std::string& name) {
  std::string file;
  for (const auto& part : server.Call(&SubmapStub::GetSubmapMesh, name).value()) file += part.data();
  const std::string count = "element vertex ", end = "end_header\n";
  const std::size_t head = file.find(count), body = file.find(end);
  if (head == std::string::npos || body == std::string::npos) {
    ADD_FAILURE() << "no PLY file";
    return {};
  }
  constexpr std::size_t kVertexBytes = 6 * 4 + 3 + 2 + 4;  // position, normal, colour, class, instance
  std::vector<Eigen::Vector3f> vertices_m(std::stoul(file.substr(head + count.size())));
  EXPECT_GE(file.size(), body + end.size() + kVertexBytes * vertices_m.size());
  for (std::size_t i = 0; i < vertices_m.size(); ++i) {
    std::memcpy(vertices_m[i].data(), file.data() + body + end.size() + kVertexBytes * i, 3 * sizeof(float));
  }
  return vertices_m;
}

}  // namespace dhpmap::testing
