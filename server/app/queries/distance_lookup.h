// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <stop_token>

#include "mapping/base/spread.h"
#include "mapping/base/status.h"
#include "mapping/query/distance_query.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// What is asked of each point.
struct DistanceQuestion {
  DistanceOptions options;
  Transform T_map_query = Transform::Identity();  ///< from the asker's frame
};

/// How far are `points_m` (finite, in the asker's frame) from the nearest surface? Looks for many at once with
/// `spread`; hands the answers, in the asker's frame, to `take` in their order, from this thread; what they refer to
/// stays as long as the view. Surfaces that are not in the cache are made meanwhile. CANCELLED soon after `stop` is
/// requested.
Status LookUpDistances(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question,
                       std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop, const Spread& spread,
                       const std::function<void(const SurfaceDistance&)>& take);

}  // namespace dhpmap
