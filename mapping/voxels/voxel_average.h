// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "mapping/voxels/tsdf_block.h"

// The weighted average of what was observed at a TSDF voxel, sum(w x) / sum(w) of distances and colours (Curless and
// Levoy 1996; paper II-C and II-D), in the two forms there are: one observation more, and several holders merged.

namespace dhpmap {

/// One observation more: from the average so far to the next one. One division for all values of a voxel, since fusion
/// does this for every voxel that a ray crosses.
class RunningAverage {
 public:
  /// The sum of both weights must be above 0.
  RunningAverage(float weight_so_far, float weight)
      : weight_so_far_(weight_so_far), weight_(weight), inverse_sum_(1.0f / (weight_so_far + weight)) {}

  [[nodiscard]] float operator()(float so_far, float observed) const {
    return (so_far * weight_so_far_ + observed * weight_) * inverse_sum_;
  }
  /// The same for a channel of a colour, rounded.
  [[nodiscard]] std::uint8_t Channel(std::uint8_t so_far, float observed) const {
    return static_cast<std::uint8_t>((*this)(static_cast<float>(so_far), observed) + 0.5f);
  }

 private:
  float weight_so_far_;
  float weight_;
  float inverse_sum_;
};

/// What several submaps hold at a position, as one voxel. The sum of the weights is kept; with a Real of double, so is
/// the average, but for one rounding, in whatever order they are added.
template <typename Real>
class MergedAverage {
 public:
  /// Adds voxel `i` of `block`, which is observed or weighs nothing.
  void Add(const TsdfBlock& block, std::size_t i) {
    const Real weight = block.weight[i];
    const Color color = block.color[i];
    weight_ += weight;
    distance_m_ += weight * block.distance_m[i];
    r_ += weight * color.r;
    g_ += weight * color.g;
    b_ += weight * color.b;
  }

  /// Writes the average and the sum of the weights to voxel `i` of `block`. Something of weight must have been added.
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
