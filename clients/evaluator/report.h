// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"
#include "clients/evaluator/pictures.h"

namespace dhpmap::evaluator {

/// The pictures of a report, taken while the maps are there: what the camera saw, the truth, and of each system its map
/// and its errors.
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

/// One page of HTML with all in it: scores, pictures of truth, map and errors side by side, scores by class, and the
/// tables as `dhpmap-evaluate run` prints them. It asks nothing of a network, and runs no script.
std::string ReportPage(const Experiment& experiment, const ReportPictures& pictures);

}  // namespace dhpmap::evaluator
