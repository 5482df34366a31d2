// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <span>

#include "mapping/map/map.h"
#include "mapping/plausibility/earlier_view.h"
#include "mapping/plausibility/frame_check.h"
#include "mapping/plausibility/frame_sample.h"
#include "mapping/plausibility/map_fit.h"

namespace dhpmap {

/// What there is to judge a frame by.
struct FrameEvidence {
  const FrameSample& sample;
  const SensorClaim& claim;
  std::span<const Eigen::Vector3f> points_m;  ///< of the sample, as they are claimed to be, in the sensor's frame
  const std::deque<EarlierView>& views;       ///< of frames of its session before it
  const Map& map;
  const MapFit& fit;  ///< of these points
};

/// The mistake that explains why a frame does not fit: the evidence speaks against the frame as it is, and for it if
/// that mistake is corrected, clearly more than for any other. Either the frame and those before it share the mistake,
/// or it is the frame's alone and the map was made without. kDisagrees: none of them explains it, but the frame
/// contradicts much of what it meets and looks through surfaces. Nothing: it fits, or nobody can tell.
std::optional<FrameWarning> FindFault(const FrameEvidence& evidence);

}  // namespace dhpmap
