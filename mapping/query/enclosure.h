// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "mapping/query/one_surface.h"
#include "mapping/query/query_world.h"
#include "mapping/query/related_body.h"

namespace dhpmap {

/// How far a body is around a thing, from 0 to 1. That it is below counts a quarter, without which it is 0: so a wall
/// encloses nothing that stands in the room. It `is_below` as who asks knows, since it touches, or is met below half of
/// the points. What is met above counts a quarter, too, and half what is around: the share of 8 horizontal directions
/// from points of the thing's surface in which the body is met or, if there is something above, nothing is seen to be
/// free up to where the body's box ends. 0, too, unless most of the thing is in the body's box. After `stop` it ends
/// soon, and what it says means nothing.
double EnclosureOf(const RelatedThing& thing, const RelatedBody& body, bool is_below, const QueryWorld& world,
                   const OneSurface& surface, const std::stop_token& stop);

}  // namespace dhpmap
