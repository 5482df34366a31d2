// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/beam_gaps.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "mapping/space/camera_kernel.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMaxGap = 40;

/// Calls visit(line, first, second) for each two bins of a line that have something and have nothing between them. The
/// second may be beyond the end of a line that goes around.
template <typename Visitor>
void ForEachGap(const BinLines& lines, const std::vector<float>& bins, Visitor&& visit) {
  for (std::size_t line = lines.first_line; line < lines.first_line + lines.num_lines; ++line) {
    const float* values = bins.data() + line * lines.line_step;
    std::size_t begin = lines.num_bins, last = lines.num_bins;  // none yet
    for (std::size_t i = 0; i < lines.num_bins; ++i) {
      if (values[i * lines.bin_step] == kNoLimit) continue;
      if (last != lines.num_bins) visit(line, last, i);
      else begin = i;
      last = i;
    }
    if (lines.go_around && begin != last) visit(line, last, begin + lines.num_bins);
  }
}

}  // namespace

void FillBetweenBeams(const BinLines& lines, std::vector<float>& bins) {
  std::array<std::uint64_t, kMaxGap + 1> counts{};
  std::uint64_t total = 0;
  ForEachGap(lines, bins, [&](std::size_t, std::size_t first, std::size_t second) {
    ++counts[std::min(second - first, kMaxGap)];
    ++total;
  });
  std::size_t usual = 0;
  for (std::uint64_t up_to = 0; usual < kMaxGap && (up_to += counts[usual]) * 4 < total * 3;) ++usual;
  // Beams as far apart as bins fall into them unevenly: one bin more is no missing beam.
  const std::size_t widest = std::min(kMaxGap, std::max(usual + 1, usual * 3 / 2));
  ForEachGap(lines, bins, [&](std::size_t line, std::size_t first, std::size_t second) {
    if (second - first < 2 || second - first > widest) return;
    float* values = bins.data() + line * lines.line_step;
    const auto at = [&](std::size_t i) -> float& { return values[i % lines.num_bins * lines.bin_step]; };
    const float least = std::min(at(first), at(second));
    for (std::size_t i = first + 1; i < second; ++i) at(i) = least;
  });
}

}  // namespace dhpmap
