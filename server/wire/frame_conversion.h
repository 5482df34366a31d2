// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/result.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Decodes a received frame. INVALID_ARGUMENT, naming every bad field at once, for: a pose that is not rigid or not
/// finite, both or neither form of pose, no sensor, images of the wrong size or type or that cannot be decoded, lists
/// of the wrong length, a class id above 65534. ValidateFrame checks the rest, against the map's label set.
Result<PanopticFrame> FrameFromProto(const v1::Frame& frame);

/// Approximate memory of a decoded frame; 0 for sizes that will be refused.
std::size_t DecodedBytes(const v1::Frame& frame);

/// Translates field names in an error of a PanopticFrame to those of v1.Frame; translated names stay.
Status InWireTerms(const Status& status);

}  // namespace dhpmap
