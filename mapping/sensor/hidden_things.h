// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/labels/label_set.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The frame without the segments of LiDAR points that the camera does not see (LidarData::is_hidden) and that have a
/// thing's, as it is that of the thing before them: they become points of no segment where they are. Those with a
/// segment of stuff keep it, which is right for about every second. Nothing if there are no such points. Takes a frame
/// that ValidateFrame takes.
std::optional<PanopticFrame> WithoutHiddenThings(const PanopticFrame& frame, const LabelSet& label_set);

}  // namespace dhpmap
