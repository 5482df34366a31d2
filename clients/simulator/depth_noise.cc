// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/depth_noise.h"

#include <algorithm>
#include <cmath>

#include "clients/simulator/random.h"

namespace dhpmap::simulator {
namespace {

constexpr double kEdgeDropOut = 0.7;
constexpr float kEdgeFixed_m = 0.02f;
constexpr float kEdgeSlope_px = 16.0f;  ///< an edge is steeper than this many pixel sizes at that depth

bool IsAtEdge(const RenderedFrame& frame, int u, int v) {
  const int width = frame.camera.width_px, height = frame.camera.height_px;
  const auto depth = [&](int x, int y) {
    return frame.depth_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  };
  const float here = depth(u, v);
  const float step_m = kEdgeFixed_m + kEdgeSlope_px * here / static_cast<float>(frame.camera.fx_px);
  const auto jumps = [&](int x, int y) {
    return x >= 0 && x < width && y >= 0 && y < height && std::abs(depth(x, y) - here) > step_m;
  };
  return jumps(u - 1, v) || jumps(u + 1, v) || jumps(u, v - 1) || jumps(u, v + 1);
}

}  // namespace

std::vector<float> NoisyDepth(const RenderedFrame& frame, double level, std::uint64_t seed,
                              std::uint64_t frame_number) {
  Random random(seed, frame_number, kDepthStream);
  std::vector<float> noisy(frame.depth_m.size(), 0.0f);
  std::size_t i = 0;
  for (int v = 0; v < frame.camera.height_px; ++v) {
    for (int u = 0; u < frame.camera.width_px; ++u, ++i) {
      const float z = frame.depth_m[i];
      if (z <= 0 || z > kMaxNoisyDepth_m) continue;
      if (IsAtEdge(frame, u, v) && random.Chance(kEdgeDropOut)) continue;
      noisy[i] = std::max(0.0f, z + static_cast<float>(level * DepthSigma_m(z) * random.Gaussian()));
    }
  }
  return noisy;
}

}  // namespace dhpmap::simulator
