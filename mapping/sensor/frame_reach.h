// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// INVALID_ARGUMENT, reason BAD_FRAME, naming the field, if the sensor is outside the map's grid. Checking the sensor
/// suffices for its points: those beyond the range limit are dropped.
Status CheckFrameIsOnGrid(const PanopticFrame& frame, double voxel_size_m);

}  // namespace dhpmap
