// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/query/occupancy_slice.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

enum class SliceFormat {
  kCells,  ///< no picture
  kPgm,
  kPng,
  kYaml,  ///< no picture either, but what goes with one
};

/// What slice, and as what.
struct SliceRequest {
  SliceOptions options;                       ///< without corner and size; a resolution of 0 is the map's voxel size
  std::optional<Eigen::AlignedBox2d> area_m;  ///< finite, not empty; nothing: all that is known
  SliceFormat format = SliceFormat::kCells;
  std::string image;  ///< its path in the YAML; empty: after the map
};

struct SliceAnswer {
  SliceOptions options;  ///< with the corner and the size
  std::vector<std::int8_t> cells;
  std::vector<const SubmapInfo*> objects;  ///< if they are wanted; valid as long as the view
  std::string picture;
  std::string yaml;
};

/// INVALID_ARGUMENT, with the field, for more than kMostSliceCells cells or more points to look at than take seconds;
/// FAILED_PRECONDITION if nothing is known and no area given; CANCELLED soon after `stop` is requested.
Result<SliceAnswer> ExportSlice(const MapView& view, SurfaceCache& cache, const SliceRequest& request,
                                const std::stop_token& stop);

/// As bytes a little less than what gRPC's clients take of a message by default.
inline constexpr std::int64_t kMostSliceCells = 4'000'000;

}  // namespace dhpmap
