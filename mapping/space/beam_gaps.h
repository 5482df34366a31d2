// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dhpmap {

/// Fills the empty bins (kNoLimit) of a row-major grid between two of a line with the lesser of both, where these lie
/// no farther apart than beams usually do: one and a half times what three quarters of all neighbours on the lines are,
/// at least one bin more, at most kMostBins. A beam that is missing is farther. Keeps its buffers. Thread-compatible.
class BeamGaps {
 public:
  static constexpr std::size_t kMostBins = 40;

  /// Along columns.
  void FillColumns(std::size_t width, std::size_t height, std::vector<float>& bins);
  /// Along rows, which go around: from a bin of a row it is `num_around` bins to itself. Those beyond `width` are
  /// empty; if there are any, more than kMostBins of a row are, at its ends and beyond.
  void FillRows(std::size_t width, std::size_t height, std::size_t num_around, std::vector<float>& bins);

 private:
  struct Gap {
    std::uint32_t first, num_bins;  ///< the bin before it, and how many later the next one is
  };

  void Clear();
  void Note(std::size_t first, std::size_t num_bins) {
    ++counts_[num_bins < kMostBins ? num_bins : kMostBins];
    if (num_bins < 2 || num_bins > kMostBins) return;
    gaps_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(num_bins)});
  }
  /// How far apart beams may be.
  [[nodiscard]] std::size_t Widest() const;

  std::vector<Gap> gaps_;
  std::array<std::size_t, kMostBins + 1> counts_{};  ///< of neighbours, by how many bins they are apart
  std::vector<std::size_t> last_;                    ///< of each column, the last bin with something so far
};

}  // namespace dhpmap
