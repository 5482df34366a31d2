// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/base/transform.h"
#include "mapping/map/map.h"

namespace dhpmap {

// Motions T_map_map of objects for edits in the map's frame, from the present to the new place. z is up.
// FAILED_PRECONDITION, with a violation, for turning or placing an object without a surface. Throws StatusError if
// voxels cannot be read.

/// Counterclockwise from above, about the vertical through the centre of its box (OutlineInMap).
Result<Transform> TurnOf(const Submap& submap, double angle_rad);

/// Moves the centre of the object's box over a point (x, y), and its lower side onto the surface of the support there.
/// Without a point: over the middle of the support's upper side. FAILED_PRECONDITION if the support has no upward
/// surface there.
Result<Transform> PlacingOf(const Submap& submap, const Submap& support, const std::optional<Eigen::Vector2d>& point_m);

/// The things that rest on an object (RelationKind::kOn, by its default rules), and in turn on these, by ascending id.
/// Never the object itself. Computes the surfaces of nearby things.
std::vector<SubmapId> SupportedBy(SubmapId id, Map& map);

}  // namespace dhpmap
