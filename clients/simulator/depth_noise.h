// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "clients/simulator/renderer.h"

namespace dhpmap::simulator {

/// Standard deviation of a depth camera like the Kinect along its axis at depth z.
inline double DepthSigma_m(double z_m) { return 0.0012 + 0.0019 * (z_m - 0.4) * (z_m - 0.4); }

/// No return from farther away.
inline constexpr float kMaxNoisyDepth_m = 8.0f;

/// The frame's depth with Gaussian noise of `level` times that size, and without most returns at depth edges and all
/// beyond 8 m (0). Frames of a recording have independent noise.
std::vector<float> NoisyDepth(const RenderedFrame& frame, double level, std::uint64_t seed, std::uint64_t frame_number);

}  // namespace dhpmap::simulator
