// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/ray_query.h"

namespace dhpmap {

/// The rays of a request, packed ones first, their directions made unit. INVALID_ARGUMENT for lists that are cut off or
/// do not go together, more than `max_rays`, or a ray that is not finite or has no direction.
Result<std::vector<Ray>> RaysFromProto(const v1::CastRaysRequest& request, std::int64_t max_rays);

/// How many rays a request has, if its lists go together.
std::size_t NumRays(const v1::CastRaysRequest& request);

/// What answering takes of memory at most: the rays, the answer, and the answer as bytes.
std::size_t BytesOfAnswers(const v1::CastRaysRequest& request);

/// Writes what rays meet, ray by ray, in the form that the request asks for.
class RayAnswers {
 public:
  /// Of the state `map` of a map. The response outlives this.
  RayAnswers(const v1::CastRaysRequest& request, const MapInfo& map, v1::CastRaysResponse& response);
  void Append(const RayHit& hit);

 private:
  const MapInfo& map_;
  const bool is_packed_;
  v1::CastRaysResponse& response_;
};

}  // namespace dhpmap
