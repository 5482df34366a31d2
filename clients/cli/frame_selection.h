// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace dhpmap {

/// Selects the frames of a data set to map.
struct FrameSelection {
  std::size_t start = 0;       ///< index of the first frame
  std::size_t frames = 0;      ///< number of frames from there; 0: all
  std::size_t every = 1;       ///< take the first of them, then every n-th
  std::size_t skip_every = 0;  ///< hold out frames whose index + 1 is a multiple of this; 0: none

  /// Indices below `num_frames`, ascending.
  [[nodiscard]] std::vector<std::size_t> Indices(std::size_t num_frames) const;
};

}  // namespace dhpmap
