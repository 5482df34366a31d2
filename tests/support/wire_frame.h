// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::testing {

/// A rendered depth camera frame as a client would send it: raw images and the pose, without stamp and segment table.
v1::Frame ToWire(const PanopticFrame& rendered);

}  // namespace dhpmap::testing
