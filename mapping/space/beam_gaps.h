// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace dhpmap {

/// Lines of bins in a grid, all along one of its directions.
struct BinLines {
  std::size_t first_line = 0;        ///< earlier ones are empty
  std::size_t num_lines, line_step;  ///< step: from a line to the next
  std::size_t num_bins, bin_step;    ///< step: from a bin of a line to the next
  bool go_around;                    ///< the first bin of a line follows the last
};

/// Fills the empty bins (kNoLimit) between two of a line with the lesser of both, where these lie no farther apart than
/// beams usually do: one and a half times what three quarters of all neighbours on these lines are, at least one bin
/// more, at most 40 bins.
/// A beam that is missing is farther.
void FillBetweenBeams(const BinLines& lines, std::vector<float>& bins);

}  // namespace dhpmap
