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

/// Options of a distance query.
struct DistanceQuestion {
  DistanceOptions options;
  Transform T_map_query = Transform::Identity();  ///< transform of the query's frame
};

/// Distances of `points_m` (finite, query's frame) to the nearest surface, in parallel by `spread`. Passes the answers,
/// in the query's frame and in order, to `take` on this thread; references are valid as long as the view. Computes
/// missing surfaces. CANCELLED soon after a `stop` request.
Status LookUpDistances(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question,
                       std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop, const Spread& spread,
                       const std::function<void(const SurfaceDistance&)>& take);

}  // namespace dhpmap
