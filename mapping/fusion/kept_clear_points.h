// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/map/kept_clear.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The (valid) frame without the points in ignored regions: their pixels have no return, a scan omits them. Nothing if
/// there are none. Time is linear in the part of the frame that the regions cover.
std::optional<PanopticFrame> WithoutKeptClear(const PanopticFrame& frame, const KeptClear& kept_clear);

}  // namespace dhpmap
