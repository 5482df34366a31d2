// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/query/relations.h"
#include "mapping/query/submap_search.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

// Queries about objects rather than places. References are valid as long as the view. Computes missing surfaces and
// pins them until the end. CANCELLED soon after a `stop` request.

Result<std::vector<SubmapMatch>> FindSubmaps(const MapView& view, SurfaceCache& cache, const SubmapQuestion& question,
                                             const std::stop_token& stop);

Result<std::vector<Relation>> ListRelations(const MapView& view, SurfaceCache& cache, const RelationQuestion& question,
                                            const std::stop_token& stop);

}  // namespace dhpmap
