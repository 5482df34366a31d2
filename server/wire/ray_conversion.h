// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/ray_query.h"

namespace dhpmap {

/// The rays of a request, packed ones first, with normalised directions. INVALID_ARGUMENT for incomplete or mismatched
/// lists, more than `max_rays`, or a ray that is not finite or has no direction.
Result<std::vector<Ray>> RaysFromProto(const v1::CastRaysRequest& request, std::int64_t max_rays);

/// Number of rays in a request, if its lists match.
std::size_t NumRays(const v1::CastRaysRequest& request);

/// Maximum memory of answering: the rays, the answer, and its bytes.
std::size_t BytesOfAnswers(const v1::CastRaysRequest& request);

/// Writes hits, ray by ray, in the requested form.
class RayAnswers {
 public:
  /// For the state `map`. The request and the response outlive this.
  RayAnswers(const v1::CastRaysRequest& request, const MapInfo& map, v1::CastRaysResponse& response);
  void Append(const RayHit& hit);

 private:
  const MapInfo& map_;
  const bool is_packed_;
  v1::CastRaysResponse& response_;
};

}  // namespace dhpmap
