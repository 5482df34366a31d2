// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/base/grid.h"
#include "mapping/labels/color.h"
#include "mapping/map/map_config.h"

namespace dhpmap {

/// Nearer than any sensor measures. A point's weight may go with 1 / depth^2, which must stay finite.
inline constexpr float kLeastDepth_m = 1e-3f;

/// What a row of depth pixels needs to become points on a grid. A pixel's ray, along the axes of the grid, is
/// column[u] + row; its squared length for unit depth is column_length2[u] + row_length2.
struct RowGeometry {
  const float* column_x;
  const float* column_y;
  const float* column_z;
  const float* column_length2;
  float row_x, row_y, row_z, row_length2;
  /// Sensor origin within its voxel, in voxels (0..1), and its voxel.
  float offset_x_vox, offset_y_vox, offset_z_vox;
  std::int32_t base_x, base_y, base_z;
  float voxels_per_m;
  float min_range2_m2, max_range2_m2;
  Weighting weighting;
};

/// Where points are summed up: one segment in one voxel. Four words, as vectors are written and compared.
struct PointPlace {
  std::array<std::int32_t, 4> words{};  ///< segment, x, y, z

  PointPlace() = default;
  PointPlace(std::uint32_t segment, VoxelIndex voxel)
      : words{static_cast<std::int32_t>(segment), voxel.x, voxel.y, voxel.z} {}
  [[nodiscard]] std::uint32_t segment() const { return static_cast<std::uint32_t>(words[0]); }
  [[nodiscard]] VoxelIndex voxel() const { return {words[1], words[2], words[3]}; }
  bool operator==(const PointPlace&) const = default;
};

/// A number of kPlaceBits bits, so that few places of a neighbourhood have the same.
inline constexpr int kPlaceBits = 12;
constexpr std::uint32_t PlaceNumber(std::int32_t segment, std::int32_t x, std::int32_t y, std::int32_t z) {
  return (static_cast<std::uint32_t>(x) * 0x9E3779B1u + static_cast<std::uint32_t>(y) * 0x85EBCA77u +
          static_cast<std::uint32_t>(z) * 0xC2B2AE3Du + static_cast<std::uint32_t>(segment) * 0x27D4EB2Fu) >>
         (32 - kPlaceBits);
}

/// A row of pixels as points.
struct RowPoints {
  float* weighted_m;       ///< four a pixel: the weight, and x, y and z times it, relative to the sensor's origin
  std::int32_t* places;    ///< four a pixel: the words of its PointPlace
  std::uint32_t* numbers;  ///< of the places; kNoPoint of a pixel without a valid point
  static constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};
};

/// Projects `width` pixels. Vectorised; the same result with every instruction set.
void ProjectRow(const float* depth_m, const std::uint32_t* segments, int width, const RowGeometry& geometry,
                const RowPoints& points);

/// Four a pixel: red, green and blue times the weight, and 1. All kNoColor where `colors` is null.
inline constexpr std::uint8_t kNoColor = 128;
void WeighColors(const Color* colors, const float* weighted_m, int width, float* weighted);

}  // namespace dhpmap
