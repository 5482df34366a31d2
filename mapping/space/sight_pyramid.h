// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace dhpmap {

/// How far a sensor sees, by direction: row-major, `width` x `height`. A voxel centre in the direction of a pixel is
/// free if it is nearer than the pixel's limit; 0 where nothing is known.
struct SightImage {
  int width = 0;
  int height = 0;
  std::vector<float> limit_vox;
};

/// Minimum and maximum limit of the pixels of any rectangle, in four look-ups. Each level has cells of 2^level pixels a
/// side, each combined with its right and lower neighbours. Thread-compatible.
class SightPyramid {
 public:
  struct Span {
    float least, most;
  };

  void Build(const SightImage& image);

  /// Bounds over the pixels u0..u1, v0..v1, inclusive, which lie in the image. May include some pixels around them.
  [[nodiscard]] Span Over(int u0, int v0, int u1, int v1) const;
  /// Over the whole image; 0 if it has no pixels.
  [[nodiscard]] float most() const { return most_; }

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<float> least, most;  ///< of a cell
    std::vector<Span> slid;          ///< of a cell and its three neighbours
  };
  std::vector<Level> levels_;  ///< the first has cells of 2 pixels; levels beyond num_levels_ are kept for their memory
  std::size_t num_levels_ = 0;
  float most_ = 0;
};

inline SightPyramid::Span SightPyramid::Over(int u0, int v0, int u1, int v1) const {
  const auto side = static_cast<unsigned>(std::max(u1 - u0, v1 - v0));
  int shift = std::max(1, static_cast<int>(std::bit_width(side)) - 2);  // the smallest sufficient level
  while ((u1 >> shift) - (u0 >> shift) > 3 || (v1 >> shift) - (v0 >> shift) > 3) ++shift;
  const Level& level = levels_[static_cast<std::size_t>(shift - 1)];
  const auto width = static_cast<std::size_t>(level.width);
  const auto left = static_cast<std::size_t>(u0 >> shift), upper = static_cast<std::size_t>(v0 >> shift) * width;
  const auto right = static_cast<std::size_t>(std::max(u0 >> shift, (u1 >> shift) - 1));
  const auto lower = static_cast<std::size_t>(std::max(v0 >> shift, (v1 >> shift) - 1)) * width;
  const Span *above = level.slid.data() + upper, *below = level.slid.data() + lower;
  const Span a = above[left], b = above[right], c = below[left], d = below[right];
  return {std::min(std::min(a.least, b.least), std::min(c.least, d.least)),
          std::max(std::max(a.most, b.most), std::max(c.most, d.most))};
}

}  // namespace dhpmap
