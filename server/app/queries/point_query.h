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

/// What is at `points_m` (map frame, finite)? Looks for many at once with `spread`; hands the answers to `take` in
/// their order, from this thread. CANCELLED soon after `stop` is requested.
Status LookUpPoints(const MapView& view, std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop,
                    const Spread& spread, const std::function<void(const PointInfo&)>& take);

}  // namespace dhpmap
