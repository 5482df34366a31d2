// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/base/transform.h"
#include "mapping/map/map.h"

namespace dhpmap {

// Where an edit in the map's frame brings an object: a motion T_map_map, from where it is to where it is to be. z is
// up. FAILED_PRECONDITION, with a violation, for what is turned or placed and has no surface. Throws StatusError if
// voxels cannot be read.

/// Counterclockwise from above, about the vertical through the middle of its box (OutlineInMap).
Result<Transform> TurnOf(const Submap& submap, double angle_rad);

/// The middle of the object's box over a point, x and y; its lower side on the surface of the support there. Without a
/// point: over the middle of the support's upper side. FAILED_PRECONDITION if the support has
/// no surface there that faces up.
Result<Transform> PlacingOf(const Submap& submap, const Submap& support, const std::optional<Eigen::Vector2d>& point_m);

/// The things that stand or lie on an object (RelationKind::kOn, by its default rules), and on these, by ascending id.
/// Never itself. Makes the surfaces of the things around.
std::vector<SubmapId> SupportedBy(SubmapId id, Map& map);

}  // namespace dhpmap
