// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <stop_token>

#include "mapping/query/one_surface.h"
#include "mapping/query/query_world.h"
#include "mapping/query/related_body.h"

namespace dhpmap {

/// The length of the shortest unobstructed segment between a thing and a body: from a point of the thing's surface to
/// the nearest point of the body, at most `most_m` long. The segment meets no surface of `others`. If the map has a
/// free-space layer, no unseen part of the segment is as long as a wall is thick. Nothing: there is no such segment.
/// Ends soon after a `stop` request; the result is then invalid.
std::optional<double> FreeWay(const RelatedThing& thing, const RelatedBody& body,
                              std::span<const RelatedBody* const> others, double most_m, const QueryWorld& world,
                              OneSurface& surface, const std::stop_token& stop);

}  // namespace dhpmap
