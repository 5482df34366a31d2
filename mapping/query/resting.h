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

/// The share of a thing that a body supports.
struct SupportShare {
  std::size_t body = 0;  ///< position in `bodies`
  double share = 0;      ///< of the supported columns of the thing
  double gap_m = 0;      ///< between the supporting surface and the height of the thing's lowest points
};

/// Each body that supports at least `least_share` of the supported columns of a thing. Columns are one voxel wide;
/// those count in which the thing has a surface. The foot of a column is at the height of the thing's lowest points.
/// The column is supported by the body with the nearest surface to the foot, at most 3 voxels aside, half a voxel above
/// and two voxels below, that faces up; or whose border is there, if no sensor has seen its upper side. Empty if no
/// body is nearer than a voxel and the thing is seen to hang: over free space, and at stuff beside or above it. Ends
/// soon after a `stop` request; the result is then invalid. Both also apply to WhatIsBelow.
std::vector<SupportShare> WhatTouches(const RelatedThing& thing, std::span<const RelatedBody* const> bodies,
                                      double least_share, const QueryWorld& world, OneSurface& surface,
                                      const std::stop_token& stop);

/// The same for surfaces up to 0.5 m below, for a thing that no body touches. The thing is assumed to stand there on
/// feet that no sensor has seen. Empty if the thing is seen to hang, if only free space is below it, or if the map has
/// no free-space layer.
std::vector<SupportShare> WhatIsBelow(const RelatedThing& thing, std::span<const RelatedBody* const> bodies,
                                      double least_share, const QueryWorld& world, OneSurface& surface,
                                      const std::stop_token& stop);

}  // namespace dhpmap
