// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/point_lookup.h"

namespace dhpmap {

/// The points of a request, packed ones first. INVALID_ARGUMENT for an incomplete list, more than `max_points`, or a
/// non-finite point.
Result<std::vector<Eigen::Vector3d>> PointsFromProto(const google::protobuf::RepeatedField<float>& packed_points_m,
                                                     const google::protobuf::RepeatedPtrField<v1::Vector3>& points_m,
                                                     std::int64_t max_points);
template <typename Request>
Result<std::vector<Eigen::Vector3d>> PointsFromProto(const Request& request, std::int64_t max_points) {
  return PointsFromProto(request.packed_points_m(), request.points_m(), max_points);
}

/// Maximum memory of answering: the points, the answer, and its bytes.
std::size_t BytesOfAnswers(const v1::QueryPointsRequest& request);

/// Writes answers, point by point, in the requested form.
class PointAnswers {
 public:
  /// For the state `map`. The response outlives this.
  PointAnswers(const v1::QueryPointsRequest& request, const MapInfo& map, std::size_t num_points,
               v1::QueryPointsResponse& response);
  void Append(const PointInfo& point);

 private:
  const MapInfo& map_;
  const bool is_packed_;
  v1::QueryPointsResponse& response_;
};

}  // namespace dhpmap
