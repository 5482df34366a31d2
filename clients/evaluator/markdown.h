// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"

namespace dhpmap::evaluator {

/// A Markdown table, readable as plain text: the first `num_left` columns are left-aligned, the others right-aligned.
class MarkdownTable {
 public:
  explicit MarkdownTable(std::vector<std::string> header, std::size_t num_left = 1)
      : rows_{std::move(header)}, num_left_(num_left) {}
  void Add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] std::string Text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
  std::size_t num_left_;
};

/// With this number of decimals; "-" for NaN and infinity.
std::string Decimals(double value, int decimals);

/// Describes the comparison: data set, thresholds, class map.
std::string ProtocolText(const Experiment& experiment);
/// One row per system; scores against the map of the ground truth's labels.
std::string ScoreTable(const Experiment& experiment);
/// The same against the ground truth's own points.
std::string PointsTable(const Experiment& experiment);
/// Labels only, of the systems queried at these points.
std::string AskedTable(const Experiment& experiment);
/// One row per class: IoU and PQ of each system.
std::string ClassTable(const Experiment& experiment);

}  // namespace dhpmap::evaluator
