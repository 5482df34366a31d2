// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/sensor/frame.h"
#include "mapping/space/beam_gaps.h"
#include "mapping/space/look_options.h"

namespace dhpmap {

/// The bins of direction (see DirectionOf) around all points of a scan. Columns begin and end where cells of a pyramid
/// over all around would, so that it bounds the same rectangles; if the points reach nearly around, they are all.
struct LidarWindow {
  int first_row = 0, height = 0;
  int first_column = 0, width = 0;
};

/// How far a scan saw through, by bins of direction: the least of the points of each, and between two beams the lesser
/// of both. Keeps its buffers. Thread-compatible.
class LidarBins {
 public:
  void Build(const LidarData& data, const LookOptions& options);

  [[nodiscard]] const LidarWindow& window() const { return window_; }
  /// Row-major; kNoLimit where no beam is.
  [[nodiscard]] const std::vector<float>& limits_vox() const { return limits_vox_; }

 private:
  void ChooseWindow();

  LidarWindow window_;
  std::vector<float> limits_vox_;
  std::vector<std::int32_t> columns_, rows_;  ///< of the points
  std::vector<float> of_points_vox_;
  BeamGaps gaps_;
};

}  // namespace dhpmap
