// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_selection.h"

#include <algorithm>

namespace dhpmap {

std::vector<std::size_t> FrameSelection::Indices(std::size_t num_frames) const {
  std::vector<std::size_t> indices;
  const std::size_t left = num_frames - std::min(start, num_frames);
  const std::size_t end = start + (frames == 0 ? left : std::min(frames, left));
  for (std::size_t i = start; i < end; i += std::max<std::size_t>(every, 1)) {
    if (skip_every == 0 || (i + 1) % skip_every != 0) indices.push_back(i);
  }
  return indices;
}

}  // namespace dhpmap
