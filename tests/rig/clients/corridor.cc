// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/corridor.h"

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/scenes.h"
#include "tests/support/wire_frame.h"

namespace dhpmap::rig {
namespace {

using testing::Scene;
using testing::Solid;

constexpr int kNumVariants = 4, kNumViews = 3;
constexpr int kFramesAPlace = 5;
constexpr double kPlaceDistance_m = 3;
constexpr std::uint32_t kNumThings = 3, kFloor = kNumThings + 1;
constexpr std::uint32_t kFloorClass = kNumThingClasses + 1;

/// Well mixed bits of two numbers.
std::uint64_t Mix(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a * 0x9e3779b97f4a7c15 + b + 1;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Things in a row across the corridor, and its floor.
Scene SceneOf(int place, int variant) {
  Scene scene;
  for (std::uint32_t i = 0; i < kNumThings; ++i) {
    const std::uint64_t shape = Mix(static_cast<std::uint64_t>(place * kNumVariants + variant), i);
    const double size_m = 0.15 + 0.05 * static_cast<double>(shape % 3);
    const double shift_m = 0.3 * static_cast<double>(shape / 4 % 3) - 0.3;
    const bool is_ball = shape / 16 % 2 == 0;
    scene.solids.push_back({.shape = is_ball ? Solid::Shape::kSphere : Solid::Shape::kBox,
                            .center_m = {place * kPlaceDistance_m + shift_m, 0.8 * i - 0.8, size_m},
                            .size_m = Eigen::Vector3d::Constant(size_m),
                            .segment = i + 1,
                            .color = {static_cast<std::uint8_t>(80 + 40 * variant), 80, 80}});
  }
  scene.solids.push_back({.shape = Solid::Shape::kHalfSpace, .size_m = {0, 0, 1}, .segment = kFloor});
  return scene;
}

v1::Frame FrameOf(int place, int variant, int view) {
  const Eigen::Vector3d target(place * kPlaceDistance_m, 0, 0.2);
  const double angle = 2 * std::numbers::pi * view / kNumViews;
  const Eigen::Vector3d eye = target + Eigen::Vector3d(1.5 * std::cos(angle), 1.5 * std::sin(angle), 1.2);
  v1::Frame frame =
      testing::ToWire(Render(SceneOf(place, variant), testing::SmallCamera(), testing::LookAt(eye, target)));
  frame.set_allow_unlisted_ids(true);
  return frame;
}

}  // namespace

Corridor::Corridor(int num_places) : num_places_(num_places) {
  for (int place = 0; place < num_places; ++place) {
    for (int variant = 0; variant < kNumVariants; ++variant) {
      for (int view = 0; view < kNumViews; ++view) frames_.push_back(FrameOf(place, variant, view));
    }
  }
}

v1::Frame Corridor::Frame(int life, std::int64_t sequence) const {
  const auto step = static_cast<std::uint64_t>(sequence) / kFramesAPlace;
  const std::uint64_t chance = Mix(static_cast<std::uint64_t>(life), step);
  const std::uint64_t place = chance % static_cast<std::uint64_t>(num_places_);
  const std::uint64_t variant = chance / 64 % kNumVariants;
  const std::uint64_t view = static_cast<std::uint64_t>(sequence) % kNumViews;
  v1::Frame frame = frames_[(place * kNumVariants + variant) * kNumViews + view];
  frame.set_stamp_ns((life + 1) * 1'000'000'000'000 + sequence * 10'000'000);
  for (std::uint32_t id = 1; id <= kFloor; ++id) {
    v1::Segment* segment = frame.add_segments();
    segment->set_id(id);
    segment->set_class_id(id == kFloor ? kFloorClass : 1 + Mix(chance, id) % kNumThingClasses);
    segment->set_score(0.9f);
  }
  return frame;
}

v1::CreateMapRequest CorridorMap(const std::string& map_id, const std::string& display_name) {
  v1::CreateMapRequest request;
  request.set_map_id(map_id);
  request.set_display_name(display_name);
  v1::MapConfig* config = request.mutable_config();
  config->set_voxel_size_m(0.05);
  config->set_truncation_m(0.1);
  config->mutable_tracking()->set_min_points_medium(30);
  config->mutable_tracking()->set_min_points_stuff(100);
  config->mutable_activity()->set_required_reobservations(1);
  config->mutable_activity()->set_deactivate_after_missed(2);
  config->mutable_refinement()->set_every_frames(4);
  const std::array<const char*, kNumThingClasses + 1> names = {"chair", "sofa", "table", "lamp", "floor"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    v1::LabelClass* label = request.add_label_classes();
    label->set_id(static_cast<std::uint32_t>(i) + 1);
    label->set_name(names[i]);
    label->set_kind(i < kNumThingClasses ? v1::LabelClass::THING : v1::LabelClass::STUFF);
  }
  return request;
}

}  // namespace dhpmap::rig
