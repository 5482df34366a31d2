// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/base/status.h"
#include "mapping/fusion/bundler.h"

namespace dhpmap::evaluator {

/// RESOURCE_EXHAUSTED, FRAME_TOO_LARGE, if the bundler gave up the frame, so that its segments are empty. Pure,
/// thread-safe.
inline Status CheckIsWhole(const std::vector<SegmentBundles>& segments) {
  if (segments.empty() || !segments.front().is_cut_short) return Status::Ok();
  return ResourceExhausted("the frame has points in more blocks than one frame may touch")
      .WithReason("FRAME_TOO_LARGE");
}

}  // namespace dhpmap::evaluator
