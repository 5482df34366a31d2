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
  kCells,  ///< no image
  kPgm,
  kPng,
  kYaml,  ///< no image, only its YAML
};

/// Selects a slice and a format.
struct SliceRequest {
  SliceOptions options;  ///< corner and size are ignored; a resolution of 0 is the map's voxel size
  std::optional<Eigen::AlignedBox2d> area_m;  ///< finite, not empty; nothing: all known space
  SliceFormat format = SliceFormat::kCells;
  std::string image;  ///< path of the image in the YAML; empty: derived from the map's name
};

struct SliceAnswer {
  SliceOptions options;  ///< with the corner and the size
  std::vector<std::int8_t> cells;
  std::vector<const SubmapInfo*> objects;  ///< if they are wanted; valid as long as the view
  std::string picture;
  std::string yaml;
};

/// INVALID_ARGUMENT, with the field, for more than kMostSliceCells cells or too many sample points (several seconds);
/// FAILED_PRECONDITION if nothing is known and no area is given; CANCELLED soon after a `stop` request.
Result<SliceAnswer> ExportSlice(const MapView& view, SurfaceCache& cache, const SliceRequest& request,
                                const std::stop_token& stop);

/// In bytes, slightly below the default message limit of gRPC clients.
inline constexpr std::int64_t kMostSliceCells = 4'000'000;

}  // namespace dhpmap
