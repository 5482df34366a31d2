// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "dhpmap/v1/occupancy.pb.h"
#include "server/app/queries/distance_grid.h"

namespace dhpmap {

/// INVALID_ARGUMENT, naming the field, for an invalid box or resolution, or more than 16,000,000 nodes; errors of
/// QueryOptionsFromProto.
Result<GridQuestion> GridQuestionFromProto(const v1::QueryDistanceGridRequest& request, const MapSnapshot& map);

/// The nodes of a grid in messages of at most 256 KiB.
class GridChunks {
 public:
  GridChunks(DistanceGrid grid, const v1::QueryDistanceGridRequest& request)
      : grid_(std::move(grid)),
        with_gradients_(request.include_gradients()),
        with_objects_(request.include_objects()) {}
  /// Fills the next, empty message; false at the end.
  Result<bool> Next(v1::QueryDistanceGridResponse& message, const std::stop_token& stop);

 private:
  DistanceGrid grid_;
  bool with_gradients_, with_objects_;
};

}  // namespace dhpmap
