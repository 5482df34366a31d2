// SPDX-License-Identifier: BSD-3-Clause
// A frame is taken whole or not at all, wherever memory ends while it is fused.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>
#include <random>
#include <stop_token>
#include <string>

#include "mapping/fusion/band_size.h"
#include "mapping/fusion/bundler.h"
#include "mapping/pipeline/map_builder.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/pipeline/ball_scene.h"

namespace {

/// Allocations left before one fails, on whatever thread; negative: none fails.
std::atomic<std::int64_t> allocations_left{-1};

/// While it is on: bytes handed out and not yet freed, and how many these were at most.
std::atomic<bool> is_heap_counted{false};
std::atomic<std::int64_t> live_bytes{0}, peak_bytes{0};

std::int64_t UsableBytes(void* memory) { return static_cast<std::int64_t>(malloc_usable_size(memory)); }

void CountBytes(std::int64_t num_bytes) {
  const std::int64_t live = live_bytes.fetch_add(num_bytes) + num_bytes;
  std::int64_t peak = peak_bytes.load();
  while (live > peak && !peak_bytes.compare_exchange_weak(peak, live)) {
  }
}

/// Allocations so far, and the number of one at which somebody asks `asked_to_stop` to.
std::atomic<std::int64_t> num_allocations{0}, stop_at{-1};
std::stop_source* asked_to_stop = nullptr;

void* Allocate(std::size_t size, std::size_t alignment) {
  if (num_allocations.fetch_add(1, std::memory_order_relaxed) == stop_at.load()) asked_to_stop->request_stop();
  if (allocations_left.load(std::memory_order_relaxed) >= 0 && allocations_left.fetch_sub(1) == 0) {
    throw std::bad_alloc();
  }
  void* memory = alignment <= alignof(std::max_align_t)
                     ? std::malloc(size == 0 ? 1 : size)
                     : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  if (is_heap_counted) CountBytes(UsableBytes(memory));
  return memory;
}

/// Not inlined: GCC would warn of memory from `operator new` that std::free takes.
[[gnu::noinline]] void Free(void* memory) {
  if (is_heap_counted && memory != nullptr) CountBytes(-UsableBytes(memory));
  std::free(memory);
}

}  // namespace

// All of this test binary's allocations go through here.
void* operator new(std::size_t size) { return Allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (is_heap_counted && memory != nullptr) CountBytes(UsableBytes(memory));
  return memory;
}
void operator delete(void* memory) noexcept { Free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { Free(memory); }
void operator delete(void* memory, std::size_t) noexcept { Free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { Free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { Free(memory); }

namespace dhpmap {
namespace {

using testing::BallFrame;
using testing::BallInfo;
using testing::MapsAreEqual;

/// Fuses three frames, of which the second is tried over and over with the n-th allocation failing, `step` apart, until
/// it succeeds. Returns how often it failed.
int FailEveryStep(int num_threads, std::int64_t first, std::int64_t step, bool publishes) {
  MapBuilder builder(BallInfo(), num_threads), untroubled(BallInfo(), num_threads);
  for (MapBuilder* b : {&builder, &untroubled}) {
    EXPECT_TRUE(b->Integrate(BallFrame(0)).ok());
    if (publishes) b->map().Publish(0);
  }
  int num_failed = 0;
  const PanopticFrame second = BallFrame(1);
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
  for (MapBuilder* b : {&builder, &untroubled}) EXPECT_TRUE(b->Integrate(BallFrame(2)).ok());
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

/// Nobody else holds the state, so blocks are written in place: what a failed frame wrote must be taken back, or the
/// frame would be in the map twice.
TEST(WholeFrame, TakesBackWhatItWroteInPlaceWhicheverAllocationFails) {
  for (const int num_threads : {1, 3}) {
    MapBuilder builder(BallInfo(), num_threads), untroubled(BallInfo(), num_threads);
    for (MapBuilder* b : {&builder, &untroubled}) ASSERT_TRUE(b->Integrate(BallFrame(0)).ok());
    const PanopticFrame second = BallFrame(1);
    int num_failed = 0;
    for (std::int64_t n = 1;; n += 37, ++num_failed) {
      allocations_left = n;
      const auto report = builder.Integrate(second);
      allocations_left = -1;
      if (report.ok()) break;
    }
    EXPECT_GT(num_failed, 5);
    ASSERT_TRUE(untroubled.Integrate(second).ok());
    EXPECT_TRUE(MapsAreEqual(*builder.map().Freeze(), *untroubled.map().Freeze()));
  }
}

TEST(WholeFrame, ToldToStopLeavesTheMapAsItWas) {
  MapBuilder builder(BallInfo(), 2);
  ASSERT_TRUE(builder.Integrate(BallFrame(0)).ok());
  const auto state = builder.map().Freeze();
  std::stop_source stopped;
  stopped.request_stop();
  const auto report = builder.Integrate(BallFrame(1), stopped.get_token());
  EXPECT_EQ(report.status().code(), StatusCode::kCancelled) << report.status().ToString();
  EXPECT_TRUE(MapsAreEqual(*builder.map().Freeze(), *state));
  EXPECT_TRUE(builder.Integrate(BallFrame(1)).ok());
}

/// How far it has got is told by what it has allocated.
TEST(WholeFrame, AHugeFrameStopsSoonAfterItIsToldTo) {
  MapInfo info = BallInfo();
  info.config.voxel_size_m = 0.002;
  info.config.truncation_m = 0.016;
  info.config.integration.max_range_m = 1.2;
  PanopticFrame frame;
  frame.camera.emplace().camera = {640, 480, 640, 640, 320, 240};
  frame.camera->depth_m.assign(std::size_t{640} * 480, 1.0f);
  MapBuilder builder(info, 2), untroubled(info, 2);
  num_allocations = 0;
  ASSERT_TRUE(untroubled.Integrate(frame).ok());
  const std::int64_t whole = num_allocations;
  ASSERT_GT(whole, 1000);
  const auto state = builder.map().Freeze();
  for (const int percent : {3, 6, 12, 25, 50}) {
    SCOPED_TRACE(percent);
    std::stop_source stop;
    asked_to_stop = &stop;
    num_allocations = 0;
    stop_at = whole * percent / 100;
    const auto report = builder.Integrate(frame, stop.get_token());
    const std::int64_t num_after = num_allocations - stop_at.exchange(-1);
    ASSERT_TRUE(stop.stop_requested());
    EXPECT_EQ(report.status().code(), StatusCode::kCancelled) << report.status().ToString();
    EXPECT_LT(num_after, whole / 10) << "of " << whole;
    EXPECT_TRUE(MapsAreEqual(*builder.map().Freeze(), *state));
  }
}

TEST(WholeFrame, AFinishThatFailsLeavesTheMapAsItWas) {
  MapBuilder builder(BallInfo(), 2);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(builder.Integrate(BallFrame(i)).ok());
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

/// Every pixel at a depth of its own.
PanopticFrame Noise(const PinholeCamera& camera, float nearest_m, float farthest_m) {
  PanopticFrame noise;
  DepthCameraData& data = noise.camera.emplace();
  data.camera = camera;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> depth_m(nearest_m, farthest_m);
  data.depth_m.reserve(static_cast<std::size_t>(camera.num_pixels()));
  for (int i = 0; i < camera.num_pixels(); ++i) data.depth_m.push_back(depth_m(random));
  return noise;
}

TEST(WholeFrame, IsRefusedBeforehandIfItTouchesTooManyBlocks) {
  MapInfo info = BallInfo();
  info.config.voxel_size_m = 0.004;
  info.config.truncation_m = 0.032;
  MapBuilder builder(info, 1);
  ASSERT_TRUE(builder.Integrate(BallFrame(0)).ok());
  const auto before = builder.map().Publish(0);
  const auto report = builder.Integrate(Noise({320, 240, 160, 160, 160, 120}, 0.5f, 5.0f));
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.status().code(), StatusCode::kResourceExhausted);
  EXPECT_NE(report.status().message().find(std::to_string(kMaxBlocksAFrame)), std::string::npos);
  EXPECT_EQ(report.status().reason(), Reason("FRAME_TOO_LARGE"));
  EXPECT_EQ(builder.map().Publish(1), before);
  EXPECT_TRUE(builder.Integrate(BallFrame(1)).ok());
}

constexpr std::int64_t kMiB = std::int64_t{1} << 20;
/// That a frame which is refused may take meanwhile, and leave behind.
constexpr std::int64_t kMostTaken_bytes = 300'000'000, kMostLeft_bytes = 4 * kMiB;

/// What is handed out since it was made.
class HeapGrowth {
 public:
  HeapGrowth() {
    live_bytes = peak_bytes = 0;
    is_heap_counted = true;
  }
  ~HeapGrowth() { is_heap_counted = false; }
  HeapGrowth(const HeapGrowth&) = delete;
  HeapGrowth& operator=(const HeapGrowth&) = delete;
  [[nodiscard]] std::int64_t now_bytes() const { return live_bytes; }
  [[nodiscard]] std::int64_t most_bytes() const { return peak_bytes; }
};

/// The most memory that the process ever had, as the kernel counts it.
std::int64_t HighWater_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "VmHWM:") {
  }
  std::int64_t high_kib = 0;
  status >> high_kib;
  return high_kib * 1024;
}

/// On a map of 2 mm voxels: refused within the bounds of memory, all of it given back, and the map and what is fused
/// next as if it had never come.
void ExpectIsRefusedWithoutATrace(const PanopticFrame& huge, int num_threads) {
  MapInfo info = BallInfo();
  info.config.voxel_size_m = 0.002;
  info.config.truncation_m = 0.016;
  info.config.space.free = info.config.space.gone = false;  // a long way in such steps
  MapBuilder builder(info, num_threads), untroubled(info, num_threads);
  for (MapBuilder* b : {&builder, &untroubled}) ASSERT_TRUE(b->Integrate(BallFrame(0)).ok());
  const auto before = builder.map().Publish(0);
  {
    const HeapGrowth growth;
    const auto report = builder.Integrate(huge);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.status().code(), StatusCode::kResourceExhausted);
    EXPECT_EQ(report.status().reason(), Reason("FRAME_TOO_LARGE"));
    EXPECT_LT(growth.most_bytes(), kMostTaken_bytes);
    EXPECT_LT(growth.now_bytes(), kMostLeft_bytes);
  }
  EXPECT_EQ(builder.map().Publish(1), before);
  untroubled.map().Publish(0);
  for (MapBuilder* b : {&builder, &untroubled}) ASSERT_TRUE(b->Integrate(BallFrame(1)).ok());
  EXPECT_TRUE(MapsAreEqual(*builder.map().Publish(2), *untroubled.map().Publish(2)));
}

TEST(WholeFrame, OfNoiseIsRefusedBeforeItTakesTheMemoryThatItAsksFor) {
  // Four million pixels, nearly each in a block of its own: 4 GB.
  const PanopticFrame noise = Noise({2000, 2000, 1000, 1000, 1000, 1000}, 0.5f, 4.0f);
  const std::int64_t before_bytes = HighWater_bytes();
  ASSERT_GT(before_bytes, 0);
  for (const int num_threads : {1, 3}) ExpectIsRefusedWithoutATrace(noise, num_threads);
  EXPECT_LT(HighWater_bytes() - before_bytes, kMostTaken_bytes);
}

TEST(WholeFrame, OfManyObjectsInTheSameFewBlocksIsRefusedBeforeItTakesTheMemoryThatItAsksFor) {
  // Some 3,500 blocks, each of which nearly all of 100 objects share.
  constexpr std::uint32_t kNumObjects = 100;
  PanopticFrame frame = Noise({1000, 800, 4600, 4600, 500, 400}, 1.0f, 1.25f);
  frame.segments.reserve(kNumObjects);
  for (std::uint32_t i = 1; i <= kNumObjects; ++i) {
    frame.segments.push_back({.id = SegmentId(i), .class_id = ClassId(2)});
  }
  std::mt19937 random(2);
  std::vector<std::uint32_t>& segments = frame.camera->segments;
  segments.reserve(frame.camera->depth_m.size());
  for (std::size_t i = 0; i < frame.camera->depth_m.size(); ++i) {
    segments.push_back(1 + static_cast<std::uint32_t>(random() % kNumObjects));
  }
  for (const int num_threads : {1, 3}) ExpectIsRefusedWithoutATrace(frame, num_threads);
}

TEST(WholeFrame, WhoseRaysTouchTooManyBlocksLeavesNoTraceEither) {
  ExpectIsRefusedWithoutATrace(Noise({320, 240, 160, 160, 160, 120}, 0.5f, 4.0f), 1);
}

TEST(WholeFrame, ThatFailsWhileItIsBundledGivesTheBuffersBack) {
  const MapInfo info = BallInfo();
  ThreadPool pool(2);
  Bundler bundler(info.config.integration, pool);
  const PanopticFrame noise = Noise({640, 480, 320, 320, 320, 240}, 1.0f, 1.5f);
  const HeapGrowth growth;
  (void)bundler.BundleFrame(noise, noise.T_map_sensor, 0.02);
  ASSERT_GT(growth.now_bytes(), 8 * kMiB) << "kept for the next frame";
  allocations_left = 2;
  EXPECT_THROW((void)bundler.BundleFrame(noise, noise.T_map_sensor, 0.02), std::bad_alloc);
  allocations_left = -1;
  EXPECT_LT(growth.now_bytes(), kMiB / 4);
}

}  // namespace
}  // namespace dhpmap
