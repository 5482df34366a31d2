// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <memory>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/map/map.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

// Work of which somebody has enough while it goes on, and a map that is large enough for it.

namespace dhpmap::testing {

/// What the threads of this process have computed so far. Waiting for a disk or for a core that others have does not
/// count.
inline std::chrono::nanoseconds ComputedSoFar() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Runs `work(stop)`, which says whether it was cancelled, to its end, which takes it T of computing; then again with a
/// stop that another thread requests once T / 5, or a fifth of its duration, has gone by. In one of many tries at least
/// it computes less than T / 2, and says that it was cancelled: work that does not look never does, while on a busy
/// machine the other thread may well wake up milliseconds late, several times in turn. For suites named ...Clock.
template <typename Work>
void ExpectEndsSoonAfterAStop(const Work& work) {
  using Clock = std::chrono::steady_clock;
  constexpr int kTries = 50;
  bool is_cancelled = false;
  std::chrono::nanoseconds after = std::chrono::nanoseconds::max();
  const auto run = [&](const std::stop_token& stop) {
    const Clock::time_point start = Clock::now();
    const std::chrono::nanoseconds computed = ComputedSoFar();
    is_cancelled = work(stop);
    const std::chrono::nanoseconds took = ComputedSoFar() - computed;
    if (!is_cancelled) after = std::min({after, took / 5, std::chrono::nanoseconds(Clock::now() - start) / 5});
    return took;
  };
  std::chrono::nanoseconds whole = run({});
  ASSERT_FALSE(is_cancelled) << "nobody has asked for it";
  std::chrono::nanoseconds stopped = std::chrono::nanoseconds::max();
  for (int i = 0; i < kTries; ++i) {
    std::stop_source caller;
    std::jthread hanging_up([&caller, after] {
      std::this_thread::sleep_for(after);
      caller.request_stop();
    });
    const std::chrono::nanoseconds took = run(caller.get_token());
    if (!is_cancelled) whole = std::min(whole, took);  // the first time it was slower
    else stopped = std::min(stopped, took);
    if (is_cancelled && took < whole / 2) return;
  }
  const auto in_ms = [](std::chrono::nanoseconds time) {
    return std::chrono::duration<double, std::milli>(time).count();
  };
  ADD_FAILURE() << "of " << in_ms(whole) << " ms of computing it did " << in_ms(stopped) << " ms, with the stop after "
                << in_ms(after) << " ms";
}

constexpr double kBlock_m = kBlockSide * kVoxel_m;

/// Height of the sheet, within a block's side.
inline double SheetHeight_m(double x_m, double y_m) { return 0.15 * std::sin(2 * x_m) * std::cos(1.5 * y_m); }

/// One wavy sheet from the origin on, seen from above, as num_x x num_y things of so many blocks a side, two blocks
/// high: voxels are all observed. Ids are from 1 on.
inline std::shared_ptr<const MapSnapshot> SheetMap(int num_x, int num_y, int side_blocks) {
  const auto distance = [](const Eigen::Vector3d& p) { return 0.9 * (p.z() - SheetHeight_m(p.x(), p.y())); };
  std::vector<std::shared_ptr<const Submap>> things;
  for (int y = 0; y < num_y; ++y) {
    for (int x = 0; x < num_x; ++x) {
      const BlockIndex low{x * side_blocks, y * side_blocks, -1};
      const BlockIndex high{low.x + side_blocks - 1, low.y + side_blocks - 1, 0};
      Submap thing = SolidSubmap(distance, low, high);
      thing.mutable_info().id = SubmapId(static_cast<std::uint32_t>(things.size()) + 1);
      thing.UpdateBoundingSphere();
      things.push_back(std::make_shared<const Submap>(std::move(thing)));
    }
  }
  MapInfo info;
  info.name = "sheet";
  info.config.voxel_size_m = kVoxel_m;
  info.config.truncation_m = 3 * kVoxel_m;
  return std::make_shared<const MapSnapshot>(info, std::move(things));
}

}  // namespace dhpmap::testing
