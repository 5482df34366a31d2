// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "mapping/base/status.h"
#include "mapping/query/ray_query.h"
#include "server/app/queries/distance_lookup.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// First hits of rays in the query's frame. Passes the answers, in the query's frame and in order, to `take`;
/// references are valid as long as the view. Computes missing surfaces. CANCELLED soon after a `stop` request.
Status CastRays(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question, std::span<const Ray> rays,
                const std::stop_token& stop, const std::function<void(const RayHit&)>& take);

}  // namespace dhpmap
