// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/labels/label_set.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The frame without wrong labels of LiDAR points that the camera does not see (LidarData::is_hidden): if such a point
/// has the segment of a thing, which is that of an occluder, it loses its segment. A stuff segment stays, because it is
/// right for about half of these points. Nothing if there are no such points. The frame must be valid (ValidateFrame).
std::optional<PanopticFrame> WithoutHiddenThings(const PanopticFrame& frame, const LabelSet& label_set);

}  // namespace dhpmap
