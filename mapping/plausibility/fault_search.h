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

/// The evidence by which a frame is judged.
struct FrameEvidence {
  const FrameSample& sample;
  const SensorClaim& claim;
  std::span<const Eigen::Vector3f> points_m;  ///< of the sample, as claimed, in the sensor's frame
  const std::deque<EarlierView>& views;       ///< of frames of its session before it
  const Map& map;
  const MapFit& fit;  ///< of these points
};

/// The mistake that explains why a frame does not fit: the evidence contradicts the frame as sent, and supports the
/// frame with this mistake corrected, clearly more than with any other correction. Either the frame shares the mistake
/// with the earlier frames, or only this frame has it and the map was made without. kDisagrees: no mistake explains it,
/// but the frame contradicts much of the map and sees through surfaces. Nothing: the frame fits, or there is too little
/// evidence.
std::optional<FrameWarning> FindFault(const FrameEvidence& evidence);

}  // namespace dhpmap
