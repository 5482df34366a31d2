// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/query/relations.h"
#include "mapping/query/submap_search.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

// Questions about objects rather than places. What answers refer to lasts as long as the view. Surfaces that are not in
// the cache are made meanwhile, and kept until the answer is there. CANCELLED soon after `stop` is requested.

Result<std::vector<SubmapMatch>> FindSubmaps(const MapView& view, SurfaceCache& cache, const SubmapQuestion& question,
                                             const std::stop_token& stop);

Result<std::vector<Relation>> ListRelations(const MapView& view, SurfaceCache& cache, const RelationQuestion& question,
                                            const std::stop_token& stop);

}  // namespace dhpmap
