// SPDX-License-Identifier: BSD-3-Clause
// A frame is taken whole or not at all, wherever memory ends while it is fused.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <random>
#include <stop_token>
#include <thread>

#include "mapping/fusion/band_size.h"
#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/support/scenes.h"

namespace {

/// Allocations left before one fails, on whatever thread; negative: none fails.
std::atomic<std::int64_t> allocations_left{-1};

void* Allocate(std::size_t size, std::size_t alignment) {
  if (allocations_left.load(std::memory_order_relaxed) >= 0 && allocations_left.fetch_sub(1) == 0) {
    throw std::bad_alloc();
  }
  void* memory = alignment <= alignof(std::max_align_t)
                     ? std::malloc(size == 0 ? 1 : size)
                     : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// Not inlined: GCC would warn of memory from `operator new` that std::free takes.
[[gnu::noinline]] void Free(void* memory) { std::free(memory); }

}  // namespace

// All of this test binary's allocations go through here.
void* operator new(std::size_t size) { return Allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size == 0 ? 1 : size); }
void operator delete(void* memory) noexcept { Free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { Free(memory); }
void operator delete(void* memory, std::size_t) noexcept { Free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { Free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { Free(memory); }

namespace dhpmap {
namespace {

using testing::MapsAreEqual;

constexpr std::uint32_t kBallSegment = 1, kFloorSegment = 2;

PanopticFrame Frame(int i) {
  const testing::Scene scene{{{.shape = testing::Solid::Shape::kSphere,
                               .center_m = {2, 0.05 * i, 0.4},
                               .size_m = {0.4, 0, 0},
                               .segment = kBallSegment,
                               .color = {200, 0, 0}},
                              {.shape = testing::Solid::Shape::kHalfSpace,
                               .center_m = {0, 0, 0},
                               .size_m = {0, 0, 1},
                               .segment = kFloorSegment,
                               .color = {90, 90, 90}}}};
  PinholeCamera camera{40, 30, 20, 20, 20, 15};
  PanopticFrame frame = testing::Render(scene, camera, testing::LookAt({0.03 * i, 0, 1.2}, {2, 0, 0.3}));
  frame.segments = {{.id = SegmentId(kBallSegment), .class_id = ClassId(1)},
                    {.id = SegmentId(kFloorSegment), .class_id = ClassId(2)}};
  return frame;
}

MapInfo Info() {
  MapInfo info;
  info.name = "m";
  info.label_set = testing::MakeLabelSet(1, 1);
  info.config.tracking.min_points_stuff = 20;
  info.config.tracking.min_points_medium = 10;
  info.config.refinement.every_frames = 0;
  return info;
}

/// Fuses three frames, of which the second is tried over and over with the n-th allocation failing, `step` apart, until
/// it succeeds. Returns how often it failed.
int FailEveryStep(int num_threads, std::int64_t first, std::int64_t step, bool publishes) {
  MapBuilder builder(Info(), num_threads), untroubled(Info(), num_threads);
  for (MapBuilder* b : {&builder, &untroubled}) {
    EXPECT_TRUE(b->Integrate(Frame(0)).ok());
    if (publishes) b->map().Publish(0);
  }
  int num_failed = 0;
  const PanopticFrame second = Frame(1);
  const std::shared_ptr<const MapSnapshot> state = builder.map().Freeze();
  for (std::int64_t n = first;; n += step) {
    allocations_left = n;
    const auto report = builder.Integrate(second);
    allocations_left = -1;
    if (report.ok()) break;
    EXPECT_EQ(report.status().code(), StatusCode::kResourceExhausted) << report.status().ToString();
    ++num_failed;
    const ::testing::AssertionResult is_as_before = MapsAreEqual(*builder.map().Freeze(), *state);
    EXPECT_TRUE(is_as_before) << "allocation " << n;
    if (!is_as_before) break;
  }
  EXPECT_TRUE(untroubled.Integrate(second).ok());
  for (MapBuilder* b : {&builder, &untroubled}) EXPECT_TRUE(b->Integrate(Frame(2)).ok());
  EXPECT_TRUE(MapsAreEqual(*builder.map().Publish(1), *untroubled.map().Publish(1)));
  EXPECT_EQ(builder.map().info().num_frames, 3);
  EXPECT_EQ(builder.map().info().next_submap_id, untroubled.map().info().next_submap_id);
  return num_failed;
}

TEST(WholeFrame, LeavesTheMapAsItWasWhicheverAllocationFails) {
  EXPECT_GT(FailEveryStep(1, 0, 23, true), 5);
  EXPECT_GT(FailEveryStep(1, 3, 23, false), 5);
}

TEST(WholeFrame, LeavesTheMapAsItWasWhenAWorkerOfThePoolFails) {
  EXPECT_GT(FailEveryStep(3, 0, 29, true), 5);
  EXPECT_GT(FailEveryStep(3, 5, 29, false), 5);
}

TEST(WholeFrame, ToldToStopLeavesTheMapAsItWas) {
  MapBuilder builder(Info(), 2);
  ASSERT_TRUE(builder.Integrate(Frame(0)).ok());
  const auto state = builder.map().Freeze();
  std::stop_source stopped;
  stopped.request_stop();
  const auto report = builder.Integrate(Frame(1), stopped.get_token());
  EXPECT_EQ(report.status().code(), StatusCode::kCancelled) << report.status().ToString();
  EXPECT_TRUE(MapsAreEqual(*builder.map().Freeze(), *state));
  EXPECT_TRUE(builder.Integrate(Frame(1)).ok());
}

TEST(WholeFrame, AHugeFrameStopsSoonAfterItIsToldTo) {
  using Clock = std::chrono::steady_clock;
  MapInfo info = Info();
  info.config.voxel_size_m = 0.002;
  info.config.truncation_m = 0.1;
  info.config.integration.max_range_m = 1.2;
  PanopticFrame frame;
  frame.camera.emplace().camera = {160, 120, 160, 160, 80, 60};
  frame.camera->depth_m.assign(std::size_t{160} * 120, 1.0f);
  MapBuilder builder(info, 2), untroubled(info, 2);
  const auto begin = Clock::now();
  ASSERT_TRUE(untroubled.Integrate(frame).ok());
  const Clock::duration whole = Clock::now() - begin;
  const auto state = builder.map().Freeze();
  int num_stopped = 0;
  for (const int percent : {3, 6, 12, 25, 50}) {
    std::stop_source stop;
    Clock::time_point told;
    std::jthread teller([&] {
      std::this_thread::sleep_for(whole * percent / 100);
      told = Clock::now();
      stop.request_stop();
    });
    const auto report = builder.Integrate(frame, stop.get_token());
    const auto ended = Clock::now();
    teller.join();
    if (report.ok()) {  // the machine has become faster meanwhile
      builder.map() = Map(state);
      continue;
    }
    ++num_stopped;
    EXPECT_EQ(report.status().code(), StatusCode::kCancelled) << report.status().ToString();
    EXPECT_LT(ended - told, whole / 2) << "told after " << percent << " %";
    EXPECT_TRUE(MapsAreEqual(*builder.map().Freeze(), *state));
  }
  EXPECT_GT(num_stopped, 0);
}

TEST(WholeFrame, AFinishThatFailsLeavesTheMapAsItWas) {
  MapBuilder builder(Info(), 2);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(builder.Integrate(Frame(i)).ok());
  const auto state = builder.map().Freeze();
  int num_failed = 0;
  for (std::int64_t n = 0;; n += 307) {
    allocations_left = n;
    try {
      builder.Finish();
      allocations_left = -1;
      break;
    } catch (const std::bad_alloc&) {
      allocations_left = -1;
      ++num_failed;
      ASSERT_TRUE(MapsAreEqual(*builder.map().Freeze(), *state)) << "allocation " << n;
    }
  }
  EXPECT_GT(num_failed, 5);
}

TEST(WholeFrame, IsRefusedBeforehandIfItTouchesTooManyBlocks) {
  MapInfo info = Info();
  info.config.voxel_size_m = 0.004;
  info.config.truncation_m = 0.032;
  MapBuilder builder(info, 1);
  ASSERT_TRUE(builder.Integrate(Frame(0)).ok());
  const auto before = builder.map().Publish(0);
  PanopticFrame noise;
  DepthCameraData& data = noise.camera.emplace();
  data.camera = {320, 240, 160, 160, 160, 120};
  std::mt19937 random(1);
  std::uniform_real_distribution<float> depth_m(0.5f, 5.0f);
  for (int i = 0; i < data.camera.num_pixels(); ++i) data.depth_m.push_back(depth_m(random));
  const auto report = builder.Integrate(noise);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.status().code(), StatusCode::kResourceExhausted);
  EXPECT_NE(report.status().message().find(std::to_string(kMaxBlocksAFrame)), std::string::npos);
  EXPECT_EQ(report.status().reason(), Reason("FRAME_TOO_LARGE"));
  EXPECT_EQ(builder.map().Publish(1), before);
  EXPECT_TRUE(builder.Integrate(Frame(1)).ok());
}

}  // namespace
}  // namespace dhpmap
