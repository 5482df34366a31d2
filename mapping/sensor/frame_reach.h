// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// INVALID_ARGUMENT, reason BAD_FRAME, naming the field, if the sensor is beyond the reach of the map's grid. Its
/// points cannot be then: those beyond the range limit are dropped.
Status CheckFrameIsOnGrid(const PanopticFrame& frame, double voxel_size_m);

}  // namespace dhpmap
