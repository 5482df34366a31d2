// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"
#include "clients/evaluator/pictures.h"

namespace dhpmap::evaluator {

/// The pictures of a report, made while the maps exist: camera colours, ground truth, and for each system its labels
/// and errors.
class ReportPictures {
 public:
  void Add(const TruthPictures& truth, const Scores& scores, const std::vector<ElementLabel>& labels);

  struct OfSystem {
    std::string system;
    PicturePair labels, errors;
  };
  [[nodiscard]] const PicturePair& seen() const { return seen_; }
  [[nodiscard]] const PicturePair& truth() const { return truth_; }
  [[nodiscard]] const std::vector<OfSystem>& systems() const { return systems_; }

 private:
  PicturePair seen_, truth_;
  std::vector<OfSystem> systems_;
};

/// A self-contained HTML page: scores, pictures of truth, labels and errors side by side, scores by class, and the
/// tables of `dhpmap-evaluate run`. It loads nothing from a network and has no scripts.
std::string ReportPage(const Experiment& experiment, const ReportPictures& pictures);

}  // namespace dhpmap::evaluator
