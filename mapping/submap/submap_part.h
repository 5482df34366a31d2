// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// What can change of a submap, as those hear of it who follow a map. Kept by the store, so numbers are never reused.
enum class SubmapPart : std::uint8_t {
  kPose = 0,
  kLabels = 1,       ///< its class, and whether somebody has set it
  kName = 2,         ///< its display name, as somebody has set it
  kActivity = 3,     ///< whether it is active, confirmed, present
  kGeometry = 4,     ///< blocks of its surface, or of what was looked through
  kVoxelLabels = 5,  ///< blocks of labels
  kObservation = 6,  ///< how often and when it was seen, as what
  kLock = 7,         ///< whether somebody has locked it
};

}  // namespace dhpmap
