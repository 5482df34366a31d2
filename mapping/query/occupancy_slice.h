// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "mapping/query/query_scope.h"
#include "mapping/query/surface_cache.h"
#include "mapping/query/voxel_states.h"

namespace dhpmap {

/// Values of a cell, as in nav_msgs/OccupancyGrid.
inline constexpr std::int8_t kFreeCell = 0, kOccupiedCell = 100, kUnknownCell = -1;

/// A band of heights, seen from above in the asker's frame, whose z is up.
struct SliceOptions {
  Transform T_map_query = Transform::Identity();    ///< from the asker's frame
  double min_z_m = 0, max_z_m = 0;                  ///< finite, min < max
  double resolution_m = 0;                          ///< side of a cell; finite, positive
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();  ///< corner of cell (0, 0)
  int width = 0, height = 0;                        ///< cells along x and y
  double free_share = 0.3;                          ///< within 0 and 1
  std::int8_t unknown = kUnknownCell;               ///< value of cells of which nothing is known
  bool with_objects = false;
  QueryScope scope;
};

/// Cells of a slice, row by row. A cell's column is looked at in points not more than a voxel apart, in the middle of
/// equal parts: of the map's own frame, on multiples of the voxel size, these are the voxels' centres. The cell is
/// occupied if any of their voxels is, free if at least `free_share` of them are, else unknown; see VoxelStates.
/// Belongs to one thread.
class OccupancySlice {
 public:
  OccupancySlice(const std::shared_ptr<const MapSurfaces>& surfaces, SliceOptions options);

  /// Row y, `width` cells from x = 0 on. `objects`, if they are wanted, are as many: whose most of the cell's occupied
  /// points are; null where it is not occupied. They last as long as the surfaces. Gives up soon after `stop` is
  /// requested: then the row means nothing, and a cell may be of many millions of points.
  void Row(int y, std::span<std::int8_t> cells, std::span<const SubmapInfo*> objects, const std::stop_token& stop = {});

  /// How many points a cell is looked at in.
  [[nodiscard]] std::int64_t points_a_cell() const { return std::int64_t{num_side_} * num_side_ * num_up_; }

 private:
  struct Cell {
    std::int8_t value;
    const SubmapInfo* object;
  };
  Cell CellAt(int x, int y, const std::stop_token& stop);
  /// Looks once in some thousand points.
  bool GivesUp(const std::stop_token& stop);
  [[nodiscard]] const SubmapInfo* MostOften();

  const SliceOptions options_;
  VoxelStates states_;
  int num_side_, num_up_;
  Eigen::Vector3d side_x_m_, side_y_m_, up_m_;  ///< from one point to the next, map frame
  std::vector<std::pair<const SubmapInfo*, int>> counts_;
  std::uint32_t num_points_ = 0;  ///< looked at so far, modulo 2^32
  bool has_given_up_ = false;
};

/// What a slice looks at in each cell: see OccupancySlice::points_a_cell.
std::int64_t PointsACell(double resolution_m, double band_m, double voxel_size_m);

/// Around all that is known in the band, by blocks of voxels, in the asker's frame; nothing if nothing is.
std::optional<Eigen::AlignedBox2d> KnownArea(const MapSurfaces& surfaces, const SliceOptions& options);

}  // namespace dhpmap
