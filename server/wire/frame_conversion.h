// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/result.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// A frame as it came over the wire, decoded. INVALID_ARGUMENT, naming every bad field at once, for: a pose that is not
/// rigid or not finite, both or neither form of pose, no sensor, images of the wrong size or type or that cannot be
/// decoded, lists of the wrong length, a class id above 65534. What needs the map's label set is left to ValidateFrame.
Result<PanopticFrame> FrameFromProto(const v1::Frame& frame);

/// What a frame takes of memory once it is decoded, more or less; 0 if its sizes are such that it will be refused.
std::size_t DecodedBytes(const v1::Frame& frame);

/// An error of a PanopticFrame with its fields called as in v1.Frame; fields that are called so already stay.
Status InWireTerms(const Status& status);

}  // namespace dhpmap
