// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mapping/plausibility/frame_fault.h"

namespace dhpmap {

/// Agreement of a frame with the map, from a sample of its points.
struct FrameFit {
  /// Share of points on known surfaces, among points in known space. Nothing if too little of the frame is in known
  /// space.
  std::optional<double> agreeing_fraction;
  /// Median distance to the surface, of points within a truncation band. Nothing if there are too few.
  std::optional<double> median_residual_m;
  /// Share of returns within the map's range limits. Nothing without any return.
  std::optional<double> valid_depth_fraction;
};

struct FrameWarning {
  FrameFault fault;
  std::string message;  ///< for people: the evidence
};

/// Result of checking a frame before fusion.
struct FrameCheck {
  std::optional<FrameFit> fit;         ///< none: it was not compared
  std::vector<FrameWarning> warnings;  ///< none: it is plausible

  [[nodiscard]] bool IsPlausible() const { return warnings.empty(); }
};

}  // namespace dhpmap
