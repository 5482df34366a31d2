// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "dhpmap/v1/occupancy.pb.h"
#include "server/app/queries/slice_export.h"

namespace dhpmap {

/// INVALID_ARGUMENT, naming the field, for an invalid band, area, resolution, fraction, format or path; errors of
/// QueryOptionsFromProto.
Result<SliceRequest> SliceRequestFromProto(const v1::QueryOccupancySliceRequest& request, const MapSnapshot& map);

/// Maximum memory of answering, for the cells of the request if it specifies them, else for the limit.
std::size_t BytesOfAnswers(const v1::QueryOccupancySliceRequest& request);

void ToProto(const SliceRequest& request, const MapInfo& map, SliceAnswer answer,
             v1::QueryOccupancySliceResponse& response);

}  // namespace dhpmap
