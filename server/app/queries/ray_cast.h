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

/// What do these rays (in the asker's frame) meet first? Hands the answers, in the asker's frame, to `take` in their
/// order; what they refer to stays as long as the view. Surfaces that are not in the cache are made meanwhile.
/// CANCELLED soon after `stop` is requested.
Status CastRays(const MapView& view, SurfaceCache& cache, const DistanceQuestion& question, std::span<const Ray> rays,
                const std::stop_token& stop, const std::function<void(const RayHit&)>& take);

}  // namespace dhpmap
