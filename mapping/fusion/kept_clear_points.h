// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/map/kept_clear.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The frame, which is valid, without the points that lie in a region that is kept clear: pixels without a return, and
/// a scan without these points. Nothing if there are none. Costs what the regions cover of the frame.
std::optional<PanopticFrame> WithoutKeptClear(const PanopticFrame& frame, const KeptClear& kept_clear);

}  // namespace dhpmap
