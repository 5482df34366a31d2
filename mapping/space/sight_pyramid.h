// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace dhpmap {

/// How far a sensor saw through, by direction: row-major, `width` x `height`. A voxel centre in the direction of a
/// pixel is free if it lies nearer than the pixel's limit; 0 where nothing is known.
struct SightImage {
  int width = 0;
  int height = 0;
  std::vector<float> limit_vox;
};

/// Least and greatest limit of the pixels of any rectangle, in four look-ups: at each level, cells of 2^level pixels
/// squared, each taken together with its right and lower neighbours. Thread-compatible.
class SightPyramid {
 public:
  struct Span {
    float least, most;
  };

  void Build(const SightImage& image);

  /// Bounds over the pixels u0..u1, v0..v1, inclusive, which lie in the image; those of some pixels around may be in
  /// it.
  [[nodiscard]] Span Over(int u0, int v0, int u1, int v1) const;
  /// Over the whole image; 0 if it has no pixels.
  [[nodiscard]] float most() const { return most_; }

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<float> least, most;            ///< of a cell
    std::vector<float> least_slid, most_slid;  ///< of a cell and its three neighbours
  };
  std::vector<Level> levels_;  ///< the first has cells of 2 pixels; beyond num_levels_ they are kept for their memory
  std::size_t num_levels_ = 0;
  float most_ = 0;
};

}  // namespace dhpmap
