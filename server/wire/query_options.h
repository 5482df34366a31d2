// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/map/map.h"
#include "server/app/distance_lookup.h"

namespace dhpmap {

/// What a request's options mean for a state of a map. INVALID_ARGUMENT for a distance, pose, name, policy or length of
/// a list that is not usable, NOT_FOUND for a submap that is not there; each names the field, "options.frame", and of a
/// list the first item that is wrong.
Result<DistanceQuestion> QueryOptionsFromProto(const v1::QueryOptions& options, const MapSnapshot& map);

}  // namespace dhpmap
