// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mapping/plausibility/frame_fault.h"

namespace dhpmap {

/// How a frame fits what is known, from a sample of its points.
struct FrameFit {
  /// Of points where the map knows the space, those that lie on a surface of it. Nothing: the frame meets so little
  /// that is known that nobody can tell.
  std::optional<double> agreeing_fraction;
  /// Of points within the truncation band of a surface, the distance to it. Nothing: there are too few.
  std::optional<double> median_residual_m;
  /// Of pixels or points with a return, those within the range that the map takes. Nothing: there is no return.
  std::optional<double> valid_depth_fraction;
};

struct FrameWarning {
  FrameFault fault;
  std::string message;  ///< for people: what speaks for it
};

/// What was found of one frame before it was fused.
struct FrameCheck {
  std::optional<FrameFit> fit;         ///< none: it was not looked at
  std::vector<FrameWarning> warnings;  ///< none: nothing speaks against it

  [[nodiscard]] bool IsPlausible() const { return warnings.empty(); }
};

}  // namespace dhpmap
