// SPDX-License-Identifier: BSD-3-Clause
// One pool for many maps: the number of threads does not go with the number of maps.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/support/thread_ids.h"
#include "tests/unit/mapping/pipeline/ball_scene.h"

namespace dhpmap {
namespace {

using testing::BallFrame;
using testing::BallInfo;

TEST(SharedPool, ThreadsDoNotGoWithTheNumberOfMaps) {
  constexpr int kThreads = 3, kMaps = 40;
  std::thread([] {}).join();  // with the first of all, a sanitizer starts a thread of its own
  const auto before = testing::ThreadIds();
  const auto pool = std::make_shared<ThreadPool>(kThreads);
  std::vector<std::unique_ptr<MapBuilder>> builders;
  builders.reserve(kMaps);
  for (int m = 0; m < kMaps; ++m) builders.push_back(std::make_unique<MapBuilder>(BallInfo(0), pool));
  for (const auto& builder : builders) ASSERT_TRUE(builder->Integrate(BallFrame(0)).ok());
  EXPECT_EQ(testing::NumThreadsSince(before), std::size_t{kThreads} - 1);
}

TEST(SharedPool, MapsBuiltAtOnceAreThoseBuiltAlone) {
  constexpr int kMaps = 4, kFrames = 7;
  MapBuilder alone(BallInfo(2), 1);
  for (int i = 0; i < kFrames; ++i) ASSERT_TRUE(alone.Integrate(BallFrame(i)).ok());
  alone.Finish();
  const auto expected = alone.map().Publish(0);

  const auto pool = std::make_shared<ThreadPool>(3);
  std::vector<std::shared_ptr<const MapSnapshot>> maps(kMaps);
  std::vector<std::thread> writers;
  writers.reserve(maps.size());
  for (auto& map : maps) {
    writers.emplace_back([&map, &pool] {
      MapBuilder builder(BallInfo(2), pool);
      for (int i = 0; i < kFrames; ++i) EXPECT_TRUE(builder.Integrate(BallFrame(i)).ok());
      builder.Finish();
      map = builder.map().Publish(0);
    });
  }
  for (std::thread& writer : writers) writer.join();
  for (const auto& map : maps) EXPECT_TRUE(testing::MapsAreEqual(*map, *expected));
}

}  // namespace
}  // namespace dhpmap
