// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/status.h"
#include "mapping/query/body_query.h"
#include "server/app/map_view.h"

namespace dhpmap {

/// Something that the robot carries.
struct CarriedSubmap {
  SubmapId submap;
  Transform T_robot_submap = Transform::Identity();
  std::vector<SubmapId> may_touch;
};

/// What is asked of each body, or motion.
struct CheckQuestion {
  BodyOptions options;
  Transform T_map_query = Transform::Identity();  ///< from the asker's frame
  std::vector<CarriedSubmap> attached;
  std::size_t max_contacts = 1;  ///< of each; 0: whether there is one is all that is asked
};

/// A contact, from the map's frame to that of the asker.
void MoveContact(const Transform& T_query_map, BodyContact& contact);

/// Do these bodies (in the asker's frame) touch anything? Hands the answers, in the asker's frame, to `take` in their
/// order; what they refer to stays as long as the view. Surfaces that are not in the cache are made meanwhile.
/// CANCELLED soon after `stop` is requested.
Status CheckBodies(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                   std::span<const Body> bodies, const std::stop_token& stop,
                   const std::function<void(const BodyAnswer&)>& take);

}  // namespace dhpmap
