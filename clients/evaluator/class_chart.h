// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dhpmap::evaluator {

/// One class: for each measure the value of each system, 0..1; empty if it has none.
struct ChartRow {
  std::string name;
  std::vector<std::vector<std::optional<double>>> values;  ///< [measure][system]
};

struct ClassChart {
  std::vector<std::string> measures;  ///< "PQ", "IoU": one panel each, side by side
  std::vector<std::string> systems;   ///< the last is drawn on top
  std::vector<std::string> colors;    ///< of the systems, in CSS syntax
  std::vector<ChartRow> rows;         ///< from top to bottom
};

/// An <svg>: a line for each class, a dot for each system; dots have tooltips.
std::string SvgOf(const ClassChart& chart);

}  // namespace dhpmap::evaluator
