// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// Parts of a submap that can change, as watchers see them. Stored, so numbers are never reused.
enum class SubmapPart : std::uint8_t {
  kPose = 0,
  kLabels = 1,       ///< its class, and whether an edit has set it
  kName = 2,         ///< its given display name
  kActivity = 3,     ///< whether it is active, confirmed, present
  kGeometry = 4,     ///< blocks of its surface, or of the gone layer
  kVoxelLabels = 5,  ///< blocks of labels
  kObservation = 6,  ///< counts, times and ids of its observations
  kLock = 7,         ///< whether it is locked
};

}  // namespace dhpmap
