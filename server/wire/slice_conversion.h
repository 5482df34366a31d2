// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "dhpmap/v1/occupancy.pb.h"
#include "server/app/queries/slice_export.h"

namespace dhpmap {

/// INVALID_ARGUMENT, naming the field, for a band, area, resolution, share, format or path that is not usable; errors
/// of QueryOptionsFromProto.
Result<SliceRequest> SliceRequestFromProto(const v1::QueryOccupancySliceRequest& request, const MapSnapshot& map);

/// What answering takes of memory at most, if the request says how many cells there are: else of the most there may be.
std::size_t BytesOfAnswers(const v1::QueryOccupancySliceRequest& request);

void ToProto(const SliceRequest& request, const MapInfo& map, SliceAnswer answer,
             v1::QueryOccupancySliceResponse& response);

}  // namespace dhpmap
