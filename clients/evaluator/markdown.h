// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"

namespace dhpmap::evaluator {

/// A Markdown table: the first columns to the left, the others to the right, padded so that it reads as plain text too.
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

/// With so many decimals; "-" for what is not finite.
std::string Decimals(double value, int decimals);

/// What was compared and how: data set, thresholds, class map.
std::string ProtocolText(const Experiment& experiment);
/// One row a system, all scores against the map of the ground truth's labels.
std::string ScoreTable(const Experiment& experiment);
/// The same against the ground truth's own points.
std::string PointsTable(const Experiment& experiment);
/// Labels alone, of the systems that were asked at these points.
std::string AskedTable(const Experiment& experiment);
/// One row a class: IoU and PQ of each system.
std::string ClassTable(const Experiment& experiment);

}  // namespace dhpmap::evaluator
