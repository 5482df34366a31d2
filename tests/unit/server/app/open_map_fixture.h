// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <string>
#include <utility>

#include "server/app/maps/map_registry.h"
#include "server/app/open_map/open_map.h"
#include "storage/store.h"
#include "tests/support/scenes.h"

namespace dhpmap {

inline PanopticFrame FrameOf(int i) {
  const testing::Scene scene{
      .solids = {{.shape = testing::Solid::Shape::kSphere, .center_m = {0, 0, 0.4}, .size_m = {0.4, 0, 0}},
                 {.shape = testing::Solid::Shape::kHalfSpace, .size_m = {0, 0, 1}, .segment = 2}}};
  PanopticFrame frame =
      testing::Render(scene, {.width_px = 40, .height_px = 30, .fx_px = 20, .fy_px = 20, .cx_px = 20, .cy_px = 15},
                      testing::LookAt({2, 0.1 * i, 1}, {0, 0, 0.2}));
  frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)}, {.id = SegmentId(2), .class_id = ClassId(2)}};
  return frame;
}

inline MapInfo RoomInfo(const std::string& name) {
  MapInfo info;
  info.name = name;
  info.label_set = testing::MakeLabelSet(1, 1);
  info.config.voxel_size_m = 0.1;
  info.config.truncation_m = 0.2;
  info.config.tracking.min_points_medium = info.config.tracking.min_points_stuff = 5;
  return info;
}

/// The answer of a call that takes a callback.
template <typename Answer, typename Call>
Answer Wait(Call&& call) {
  auto promise = std::make_shared<std::promise<Answer>>();
  call([promise](const Answer& answer) { promise->set_value(answer); });
  return promise->get_future().get();
}

/// A map 'room' in a store, and its session.
class OpenMapTest : public ::testing::Test {
 protected:
  void Open(OpenMapOptions options) {
    options.mapping.num_threads = 2;
    registry = std::move(MapRegistry::Open(*store, std::move(options))).value();
    ASSERT_TRUE(registry->Create(RoomInfo("room")).ok());
    session = *registry->GetOpen("room");
  }
  FrameOutcome Integrate(int i) {
    return Wait<FrameOutcome>([&](auto done) { session->Integrate(FrameOf(i), done); });
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  std::unique_ptr<MapRegistry> registry;
  std::shared_ptr<OpenMap> session;
};

}  // namespace dhpmap
