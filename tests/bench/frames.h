// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clients/datasets/dataset.h"

namespace dhpmap::bench {

struct LoadedFrames {
  std::unique_ptr<Dataset> dataset;
  std::vector<PanopticFrame> frames;  ///< decoded, so that decoding is not measured
  std::size_t num_skipped = 0;
};

/// The first `num_frames` (0 = all) frames of a data set.
Result<LoadedFrames> LoadFrames(const std::string& directory, LabelSource labels, std::size_t num_frames);

struct Summary {
  double mean = 0, median = 0, p95 = 0;
};
Summary Summarize(std::vector<double> values);

}  // namespace dhpmap::bench
