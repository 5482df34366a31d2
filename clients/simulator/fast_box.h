// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

/// Bounds in x, y, z, slightly enlarged. The fourth lane lets one operation test all lanes.
struct FastBox {
  Eigen::Array4f min, max;
  FastBox() = default;
  explicit FastBox(const Eigen::AlignedBox3d& box) {
    constexpr float kMargin_m = 1e-4f;  // covers rounding to float
    min << box.min().cast<float>().array() - kMargin_m, 0.0f;
    max << box.max().cast<float>().array() + kMargin_m, 1.0f;
  }
  /// Lower bound of the distance from p to the content; p's fourth lane is 0 or 1.
  [[nodiscard]] float Distance(const Eigen::Array4f& p) const {
    return (min - p).max(p - max).max(0.0f).matrix().norm();
  }
};

struct FastRay {
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  Eigen::Array4f origin, inverse;
  explicit FastRay(const Ray& ray) {
    origin << ray.origin_m.cast<float>().array(), 0.0f;
    // Finite, so that 0 * inverse is not NaN. The fourth lane, with bounds 0 and 1, is the interval [0, 2 kFar_m].
    const auto safe = [](double d) { return static_cast<float>(std::abs(d) > 1e-12 ? 1 / d : 1e12); };
    inverse << safe(ray.direction.x()), safe(ray.direction.y()), safe(ray.direction.z()),
        static_cast<float>(2 * kFar_m);
  }
  /// The distance at which the ray enters the box; infinity if not within max_m.
  [[nodiscard]] float Enter(const FastBox& box, float max_m) const {
    const Eigen::Array4f t0 = (box.min - origin) * inverse, t1 = (box.max - origin) * inverse;
    const float enter = t0.min(t1).maxCoeff(), leave = std::min(t0.max(t1).minCoeff(), max_m);
    return enter <= leave ? enter : kNever;
  }
};

}  // namespace dhpmap::simulator
