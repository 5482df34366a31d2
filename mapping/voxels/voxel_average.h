// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "mapping/voxels/tsdf_block.h"

// The weighted average of the observations of a TSDF voxel, sum(w x) / sum(w) of distances and colours (Curless and
// Levoy 1996; paper II-C and II-D), in two forms: incremental, and over several holders.

namespace dhpmap {

/// Incremental: from the average so far to the next. One division for all values of a voxel, because fusion does this
/// for every voxel on every ray.
class RunningAverage {
 public:
  /// The sum of both weights must be above 0.
  RunningAverage(float weight_so_far, float weight)
      : weight_so_far_(weight_so_far), weight_(weight), inverse_sum_(1.0f / (weight_so_far + weight)) {}

  [[nodiscard]] float operator()(float so_far, float observed) const {
    return (so_far * weight_so_far_ + observed * weight_) * inverse_sum_;
  }
  /// The same for a colour channel, rounded.
  [[nodiscard]] std::uint8_t Channel(std::uint8_t so_far, float observed) const {
    return static_cast<std::uint8_t>((*this)(static_cast<float>(so_far), observed) + 0.5f);
  }

 private:
  float weight_so_far_;
  float weight_;
  float inverse_sum_;
};

/// Merges the voxels of several submaps at one position. Keeps the sum of weights and, with Real = double, the average
/// up to one rounding, independent of the order.
template <typename Real>
class MergedAverage {
 public:
  /// Adds voxel `i` of `block`; it must be observed or have weight 0.
  void Add(const TsdfBlock& block, std::size_t i) {
    const Real weight = block.weight[i];
    const Color color = block.color[i];
    weight_ += weight;
    distance_m_ += weight * block.distance_m[i];
    r_ += weight * color.r;
    g_ += weight * color.g;
    b_ += weight * color.b;
  }

  /// Writes the average and the sum of weights to voxel `i` of `block`. The sum must be positive.
  void Store(TsdfBlock& block, std::size_t i) const {
    block.distance_m[i] = static_cast<float>(distance_m_ / weight_);
    block.weight[i] = static_cast<float>(weight_);
    block.color[i] = {Channel(r_), Channel(g_), Channel(b_)};
  }

 private:
  [[nodiscard]] std::uint8_t Channel(Real sum) const {
    return static_cast<std::uint8_t>(std::min(sum / weight_ + Real(0.5), Real(255)));
  }

  Real weight_ = 0, distance_m_ = 0, r_ = 0, g_ = 0, b_ = 0;
};

}  // namespace dhpmap
