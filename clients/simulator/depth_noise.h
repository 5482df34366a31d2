// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "clients/simulator/renderer.h"

namespace dhpmap::simulator {

/// Standard deviation along the axis at depth z, similar to a Kinect.
inline double DepthSigma_m(double z_m) { return 0.0012 + 0.0019 * (z_m - 0.4) * (z_m - 0.4); }

/// Farther points give no return.
inline constexpr float kMaxNoisyDepth_m = 8.0f;

/// The frame's depth with Gaussian noise of `level` times DepthSigma_m, without most returns at depth edges and without
/// those beyond kMaxNoisyDepth_m (0). Noise is independent between frames.
std::vector<float> NoisyDepth(const RenderedFrame& frame, double level, std::uint64_t seed, std::uint64_t frame_number);

}  // namespace dhpmap::simulator
