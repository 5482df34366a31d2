// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <stop_token>

#include "mapping/query/one_surface.h"
#include "mapping/query/query_world.h"
#include "mapping/query/related_body.h"

namespace dhpmap {

/// The length of the shortest straight way of at most `most_m` from a point of the thing's surface to what of the body
/// is nearest to it that goes through nothing: it meets the surface of no other and, where the map knows what is free,
/// no stretch of it is unseen in which a wall would have room. Nothing: there is none. After `stop` it ends soon, and
/// what it says means nothing.
std::optional<double> FreeWay(const RelatedThing& thing, const RelatedBody& body,
                              std::span<const RelatedBody* const> others, double most_m, const QueryWorld& world,
                              OneSurface& surface, const std::stop_token& stop);

}  // namespace dhpmap
