// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/query/one_surface.h"
#include "mapping/query/query_world.h"
#include "mapping/query/related_body.h"

namespace dhpmap {

/// How much of a thing a body holds up.
struct SupportShare {
  std::size_t body = 0;  ///< position among those that were asked about
  double share = 0;      ///< of the columns of the thing that anything holds
  double gap_m = 0;      ///< between the surface that holds it and the height of the thing's lowest points
};

/// Each body that holds at least `least_share` of the columns of a thing, one voxel wide, that anything holds. A column
/// in which the thing has a surface is held by the body that has, nearest to its foot at the height of the thing's
/// lowest points and no more than 3 voxels aside, a surface that faces up, no more than half a voxel above and two
/// below; or any surface, if it ends there and nobody has seen its upper side. Nothing, if none is nearer than a voxel
/// and the thing is seen to hang, over free space and at stuff beside or above it. After `stop` it ends soon, and what
/// it says means nothing. WhatIsBelow, too.
std::vector<SupportShare> WhatTouches(const RelatedThing& thing, std::span<const RelatedBody* const> bodies,
                                      double least_share, const QueryWorld& world, OneSurface& surface,
                                      const std::stop_token& stop);

/// The same of what is up to 0.5 m below, for what nothing touches: it is taken to stand there on feet that nobody has
/// seen, unless it is seen to hang, or nothing but free space is below it, or the map does not know what is free.
std::vector<SupportShare> WhatIsBelow(const RelatedThing& thing, std::span<const RelatedBody* const> bodies,
                                      double least_share, const QueryWorld& world, OneSurface& surface,
                                      const std::stop_token& stop);

}  // namespace dhpmap
