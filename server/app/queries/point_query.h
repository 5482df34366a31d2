// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <stop_token>

#include "mapping/base/spread.h"
#include "mapping/base/status.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Point queries at `points_m` (map frame, finite), in parallel by `spread`. Passes the answers in order to `take` on
/// this thread. CANCELLED soon after a `stop` request.
Status LookUpPoints(const MapView& view, std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop,
                    const Spread& spread, const std::function<void(const PointInfo&)>& take);

}  // namespace dhpmap
