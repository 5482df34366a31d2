// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/sensor/frame.h"
#include "mapping/space/beam_gaps.h"
#include "mapping/space/look_options.h"

namespace dhpmap {

/// The bins of direction (see DirectionOf) that contain all points of a scan. Columns begin and end at cells of a
/// pyramid over all directions, so the pyramid bounds the same rectangles. If the points surround the scanner, all
/// columns.
struct LidarWindow {
  int first_row = 0, height = 0;
  int first_column = 0, width = 0;
};

/// How far a scan sees, by bins of direction: the minimum over the points of a bin; between two beams the smaller of
/// both. Keeps its buffers. Thread-compatible.
class LidarBins {
 public:
  void Build(const LidarData& data, const LookOptions& options);

  [[nodiscard]] const LidarWindow& window() const { return window_; }
  /// Row-major; kNoLimit where there is no beam.
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
