// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "mapping/base/status.h"
#include "mapping/query/trajectory_query.h"
#include "server/app/body_check.h"
#include "server/app/map_view.h"

namespace dhpmap {

/// Can robots go along these motions (in the asker's frame; `motion_of` gives them by number)? Hands the answers, in
/// the asker's frame, to `take` in their order; what they refer to stays as long as the view. Surfaces that are not in
/// the cache are made meanwhile. RESOURCE_EXHAUSTED for something attached that no robot carries; CANCELLED soon after
/// `stop` is requested.
Status CheckTrajectories(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                         std::size_t num_motions, const std::function<RobotMotion(std::size_t)>& motion_of,
                         const std::stop_token& stop, const std::function<void(const TrajectoryAnswer&)>& take);

}  // namespace dhpmap
