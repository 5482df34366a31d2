// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "mapping/query/one_surface.h"
#include "mapping/query/query_world.h"
#include "mapping/query/related_body.h"

namespace dhpmap {

/// How far a body encloses a thing, from 0 to 1: a quarter for the body below the thing, a quarter for the body above
/// it, and half for the share of 8 horizontal directions, from points of the thing's surface, that meet the body. If
/// there is a surface above, a direction without free space up to the border of the body's box counts as well. The body
/// is below if the caller knows it (`is_below`, because it touches the thing), or if rays down from half of the points
/// meet it. The result is 0 unless the body is below, so that a wall encloses nothing that stands in the room; and 0
/// unless most of the thing is in the body's box. Ends soon after a `stop` request; the result is then invalid.
double EnclosureOf(const RelatedThing& thing, const RelatedBody& body, bool is_below, const QueryWorld& world,
                   const OneSurface& surface, const std::stop_token& stop);

}  // namespace dhpmap
