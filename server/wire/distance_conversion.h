// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/distance_query.h"

namespace dhpmap {

v1::QueryStatus::Code StatusToProto(DistanceStatus status);

/// Maximum memory of answering: the points, the answer, and its bytes.
std::size_t BytesOfAnswers(const v1::QueryDistancesRequest& request);

/// Writes distances, point by point, in the requested form.
class DistanceAnswers {
 public:
  /// For the state `map`. The response outlives this.
  DistanceAnswers(const v1::QueryDistancesRequest& request, const MapInfo& map, std::size_t num_points,
                  v1::QueryDistancesResponse& response);
  void Append(const SurfaceDistance& answer);

 private:
  const MapInfo& map_;
  const bool is_packed_;
  v1::QueryDistancesResponse& response_;
};

}  // namespace dhpmap
