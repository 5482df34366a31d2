// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/map/map.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

// Work of which somebody has enough while it goes on, and a map that is large enough for it.

namespace dhpmap::testing {

/// Runs `work(stop)`, which says whether it was cancelled, for the whole time T that it takes; then again with a stop
/// that another thread requests after T / 5. In one of a few tries at least it ends within T / 2, and says that it was
/// cancelled. Relative, as machines are slow, and busy.
template <typename Work>
void ExpectEndsSoonAfterAStop(const Work& work) {
  using Clock = std::chrono::steady_clock;
  constexpr int kTries = 5;
  bool is_cancelled = false;
  const auto run = [&](const std::stop_token& stop) -> Clock::duration {
    const Clock::time_point start = Clock::now();
    is_cancelled = work(stop);
    return Clock::now() - start;
  };
  Clock::duration whole = run({});
  ASSERT_FALSE(is_cancelled) << "nobody has asked for it";
  Clock::duration stopped = Clock::duration::max();
  for (int i = 0; i < kTries; ++i) {
    std::stop_source caller;
    std::jthread hanging_up([&caller, after = whole / 5] {
      std::this_thread::sleep_for(after);
      caller.request_stop();
    });
    const Clock::duration took = run(caller.get_token());
    if (!is_cancelled) whole = std::min(whole, took);  // the first time it was slower
    else stopped = std::min(stopped, took);
    if (is_cancelled && took < whole / 2) return;
  }
  const auto in_ms = [](Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); };
  ADD_FAILURE() << "of " << in_ms(whole) << " ms it did " << in_ms(stopped) << " ms, of which " << in_ms(whole / 5)
                << " ms before the stop";
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
