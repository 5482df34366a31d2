// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/base/grid.h"
#include "mapping/labels/color.h"
#include "mapping/map/map_config.h"

namespace dhpmap {

/// Below the range of every sensor. A point's weight may be 1 / depth^2, which must stay finite.
inline constexpr float kLeastDepth_m = 1e-3f;

/// Geometry that turns a row of depth pixels into points on a grid. A pixel's ray, along the axes of the grid, is
/// column[u] + row; its squared length at unit depth is column_length2[u] + row_length2.
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

/// The segment and voxel in which points are summed up. Four words, because vectors write and compare it.
struct PointPlace {
  std::array<std::int32_t, 4> words{};  ///< segment, x, y, z

  PointPlace() = default;
  PointPlace(std::uint32_t segment, VoxelIndex voxel)
      : words{static_cast<std::int32_t>(segment), voxel.x, voxel.y, voxel.z} {}
  [[nodiscard]] std::uint32_t segment() const { return static_cast<std::uint32_t>(words[0]); }
  [[nodiscard]] VoxelIndex voxel() const { return {words[1], words[2], words[3]}; }
  bool operator==(const PointPlace&) const = default;
};

/// Hash of a place with kPlaceBits bits. Few places of a neighbourhood share a value.
inline constexpr int kPlaceBits = 12;
constexpr std::uint32_t PlaceNumber(std::int32_t segment, std::int32_t x, std::int32_t y, std::int32_t z) {
  return (static_cast<std::uint32_t>(x) * 0x9E3779B1u + static_cast<std::uint32_t>(y) * 0x85EBCA77u +
          static_cast<std::uint32_t>(z) * 0xC2B2AE3Du + static_cast<std::uint32_t>(segment) * 0x27D4EB2Fu) >>
         (32 - kPlaceBits);
}

/// A row of pixels as points.
struct RowPoints {
  float* weighted_m;       ///< four per pixel: the weight, and weighted x, y, z, relative to the sensor's origin
  std::int32_t* places;    ///< four per pixel: the words of its PointPlace
  std::uint32_t* numbers;  ///< hashes of the places; kNoPoint for a pixel without a valid point
  static constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};
};

/// Projects `width` pixels. Vectorised; the same result with every instruction set.
void ProjectRow(const float* depth_m, const std::uint32_t* segments, int width, const RowGeometry& geometry,
                const RowPoints& points);

/// Four per pixel: red, green and blue times the weight, and 1. All kNoColor if `colors` is null.
inline constexpr std::uint8_t kNoColor = 128;
void WeighColors(const Color* colors, const float* weighted_m, int width, float* weighted);

}  // namespace dhpmap
