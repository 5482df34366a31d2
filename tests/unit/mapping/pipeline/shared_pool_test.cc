// SPDX-License-Identifier: BSD-3-Clause
// One pool for many maps: the number of threads does not go with the number of maps.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"
#include "tests/support/thread_ids.h"

namespace dhpmap {
namespace {

MapInfo Info(int refine_every_frames) {
  MapInfo info = testing::NamedMap("m", 1, 1);
  info.config.tracking.min_points_stuff = 20;
  info.config.tracking.min_points_medium = 10;
  info.config.refinement.every_frames = refine_every_frames;
  return info;
}

PanopticFrame Frame(int i) {
  const testing::Scene scene{{{.shape = testing::Solid::Shape::kSphere,
                               .center_m = {2, 0.05 * i, 0.4},
                               .size_m = {0.4, 0, 0},
                               .segment = 1,
                               .color = {200, 0, 0}},
                              {.shape = testing::Solid::Shape::kHalfSpace,
                               .center_m = {0, 0, 0},
                               .size_m = {0, 0, 1},
                               .segment = 2,
                               .color = {90, 90, 90}}}};
  const PinholeCamera camera{40, 30, 20, 20, 20, 15};
  PanopticFrame frame = testing::Render(scene, camera, testing::LookAt({0.03 * i, 0, 1.2}, {2, 0, 0.3}));
  frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)}, {.id = SegmentId(2), .class_id = ClassId(2)}};
  return frame;
}

TEST(SharedPool, ThreadsDoNotGoWithTheNumberOfMaps) {
  constexpr int kThreads = 3, kMaps = 40;
  std::thread([] {}).join();  // with the first of all, a sanitizer starts a thread of its own
  const auto before = testing::ThreadIds();
  const auto pool = std::make_shared<ThreadPool>(kThreads);
  std::vector<std::unique_ptr<MapBuilder>> builders;
  builders.reserve(kMaps);
  for (int m = 0; m < kMaps; ++m) builders.push_back(std::make_unique<MapBuilder>(Info(0), pool));
  for (const auto& builder : builders) ASSERT_TRUE(builder->Integrate(Frame(0)).ok());
  EXPECT_EQ(testing::NumThreadsSince(before), std::size_t{kThreads} - 1);
}

TEST(SharedPool, MapsBuiltAtOnceAreThoseBuiltAlone) {
  constexpr int kMaps = 4, kFrames = 7;
  MapBuilder alone(Info(2), 1);
  for (int i = 0; i < kFrames; ++i) ASSERT_TRUE(alone.Integrate(Frame(i)).ok());
  alone.Finish();
  const auto expected = alone.map().Publish(0);

  const auto pool = std::make_shared<ThreadPool>(3);
  std::vector<std::shared_ptr<const MapSnapshot>> maps(kMaps);
  std::vector<std::thread> writers;
  writers.reserve(maps.size());
  for (auto& map : maps) {
    writers.emplace_back([&map, &pool] {
      MapBuilder builder(Info(2), pool);
      for (int i = 0; i < kFrames; ++i) EXPECT_TRUE(builder.Integrate(Frame(i)).ok());
      builder.Finish();
      map = builder.map().Publish(0);
    });
  }
  for (std::thread& writer : writers) writer.join();
  for (const auto& map : maps) EXPECT_TRUE(testing::MapsAreEqual(*map, *expected));
}

}  // namespace
}  // namespace dhpmap
