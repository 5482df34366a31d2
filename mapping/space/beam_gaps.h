// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dhpmap {

/// Fills the empty bins (kNoLimit) between two filled ones of a line of a row-major grid with the smaller of both, if
/// these are no farther apart than beams usually are: 1.5 times the third quartile of all distances on the lines, at
/// least one bin more, at most kMostBins. A wider gap is a missing beam. Keeps its buffers. Thread-compatible.
class BeamGaps {
 public:
  static constexpr std::size_t kMostBins = 40;

  /// Along columns.
  void FillColumns(std::size_t width, std::size_t height, std::vector<float>& bins);
  /// Along rows, which wrap around after `num_around` bins. Bins beyond `width` are empty; if there are any, the empty
  /// ones of a row, at its ends and beyond, are more than kMostBins.
  void FillRows(std::size_t width, std::size_t height, std::size_t num_around, std::vector<float>& bins);

 private:
  struct Gap {
    std::uint32_t first, num_bins;  ///< the bin before the gap, and the distance to the next filled one
  };

  void Clear();
  void Note(std::size_t first, std::size_t num_bins) {
    ++counts_[num_bins < kMostBins ? num_bins : kMostBins];
    if (num_bins < 2 || num_bins > kMostBins) return;
    gaps_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(num_bins)});
  }
  /// The largest distance between neighbouring beams.
  [[nodiscard]] std::size_t Widest() const;

  std::vector<Gap> gaps_;
  std::array<std::size_t, kMostBins + 1> counts_{};  ///< of neighbours, by their distance in bins
  std::vector<std::size_t> last_;                    ///< the last filled bin of each column so far
};

}  // namespace dhpmap
