// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dhpmap::evaluator {

/// One class: a value of each system for each measure, 0..1; none where it has none.
struct ChartRow {
  std::string name;
  std::vector<std::vector<std::optional<double>>> values;  ///< [measure][system]
};

struct ClassChart {
  std::vector<std::string> measures;  ///< "PQ", "IoU": a panel each, side by side
  std::vector<std::string> systems;   ///< the last lies on top of the others
  std::vector<std::string> colors;    ///< of the systems, as CSS has them
  std::vector<ChartRow> rows;         ///< from the top
};

/// An <svg>: a line a class, a dot a system; dots say what they are when one points at them.
std::string SvgOf(const ClassChart& chart);

}  // namespace dhpmap::evaluator
