// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/beam_gaps.h"

#include <algorithm>
#include <numeric>

#include "mapping/space/camera_kernel.h"

namespace dhpmap {
namespace {

constexpr auto kNoneYet = static_cast<std::size_t>(-1);

}  // namespace

void BeamGaps::Clear() {
  gaps_.clear();
  counts_.fill(0);
}

std::size_t BeamGaps::Widest() const {
  const std::size_t total = std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
  std::size_t usual = 0;
  for (std::size_t up_to = 0; usual < kMostBins && (up_to += counts_[usual]) * 4 < total * 3;) ++usual;
  // Beams as far apart as bins are fill them unevenly: a gap of one bin is not a missing beam.
  return std::min(kMostBins, std::max(usual + 1, usual * 3 / 2));
}

/// Row by row, as the bins lie in memory.
void BeamGaps::FillColumns(std::size_t width, std::size_t height, std::vector<float>& bins) {
  Clear();
  last_.assign(width, kNoneYet);
  for (std::size_t begin = 0; begin < width * height; begin += width) {
    for (std::size_t u = 0; u < width; ++u) {
      if (bins[begin + u] == kNoLimit) continue;
      if (last_[u] != kNoneYet) Note(last_[u], (begin + u - last_[u]) / width);
      last_[u] = begin + u;
    }
  }
  const std::size_t widest = Widest();
  for (const Gap& gap : gaps_) {
    if (gap.num_bins > widest) continue;
    const float least = std::min(bins[gap.first], bins[gap.first + gap.num_bins * width]);
    for (std::size_t i = 1; i < gap.num_bins; ++i) bins[gap.first + i * width] = least;
  }
}

void BeamGaps::FillRows(std::size_t width, std::size_t height, std::size_t num_around, std::vector<float>& bins) {
  Clear();
  for (std::size_t begin = 0; begin < width * height; begin += width) {
    std::size_t first = kNoneYet, last = kNoneYet;
    for (std::size_t u = 0; u < width; ++u) {
      if (bins[begin + u] == kNoLimit) continue;
      if (last != kNoneYet) Note(begin + last, u - last);
      else first = u;
      last = u;
    }
    if (first != last) Note(begin + last, first + num_around - last);
  }
  const std::size_t widest = Widest();
  for (const Gap& gap : gaps_) {
    if (gap.num_bins > widest) continue;
    const std::size_t u = gap.first % width, begin = gap.first - u;
    const float least = std::min(bins[gap.first], bins[begin + (u + gap.num_bins) % width]);
    for (std::size_t i = 1; i < gap.num_bins; ++i) bins[begin + (u + i) % width] = least;
  }
}

}  // namespace dhpmap
