// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "dhpmap/feed.h"
#include "dhpmap/result.h"
#include "dhpmap/v1/mapping_service.pb.h"

namespace dhpmap::client {

/// InvalidArgument for intrinsics that do not fit the image size.
Status CheckCamera(const Camera& camera);

/// Converts a frame. InvalidArgument for mismatched sizes, an invalid pose, a depth in millimetres, and a stamp that is
/// not after that of the previous frame.
Result<v1::Frame> ToProto(const RgbdFrame& frame, const Camera& camera, std::optional<std::int64_t> last_stamp_ns);
Result<v1::Frame> ToProto(const LidarFrame& frame, std::optional<std::int64_t> last_stamp_ns);

}  // namespace dhpmap::client
