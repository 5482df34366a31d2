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

#include "mapping/query/query_world.h"
#include "mapping/query/slice_options.h"
#include "mapping/query/slice_surface.h"
#include "mapping/query/voxel_states.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// Cells of a slice, row by row. A cell is occupied if any surface lies within it and the band, or anything that is
/// inside of something; or, if the unknown is occupied, anything that nobody has seen. Else it is free if at least
/// `free_share` of it is, else unknown. Surfaces are cut to the cell exactly. The rest is looked at in points of the
/// cell not more than a voxel apart (.57 of one, if the frame is turned against the map's), in the middle of equal
/// parts: of the map's own frame, on multiples of the voxel size, these are the voxels' centres; see VoxelStates. The
/// inside of what nobody has seen counts only if the unknown is free.
/// So a ball of a radius r from half a voxel's diagonal on that stays at heights from min_z_m + r to max_z_m - r, and
/// farther than r from all cells that are not free, touches nothing by BodyQuery or SweepQuery with the same unknown.
/// Belongs to one thread.
class OccupancySlice {
 public:
  OccupancySlice(const std::shared_ptr<const MapSurfaces>& surfaces, SliceOptions options);
  OccupancySlice(const OccupancySlice&) = delete;
  OccupancySlice& operator=(const OccupancySlice&) = delete;

  /// Row y, `width` cells from x = 0 on. `objects`, if they are wanted, are as many: whose most of the cell's surface
  /// is, or else of its inside; null where there is neither. They last as long as the surfaces. Gives up soon after
  /// `stop` is requested: then the row means nothing, and a cell may be of many millions of points.
  void Row(int y, std::span<std::int8_t> cells, std::span<const SubmapInfo*> objects, const std::stop_token& stop = {});

  /// How many points a cell is looked at in.
  [[nodiscard]] std::int64_t points_a_cell() const { return std::int64_t{num_side_} * num_side_ * num_up_; }

 private:
  struct Cell {
    std::int8_t value;
    const SubmapInfo* object;
  };
  /// Of one that holds no surface.
  Cell CellAt(int x, int y, const std::stop_token& stop);
  void CountInside(const VoxelStates::Voxel& voxel);
  /// Looks once in some thousand points.
  bool GivesUp(const std::stop_token& stop);
  [[nodiscard]] const SubmapInfo* MostOften();

  const SliceOptions options_;
  const QueryWorld world_;
  VoxelStates states_;
  SliceSurface surface_;
  int num_side_, num_up_;
  Eigen::Vector3d side_x_m_, side_y_m_, up_m_;             ///< from one point to the next, map frame
  std::vector<std::pair<const SubmapInfo*, int>> counts_;  ///< of points inside, by whose inside it is
  std::vector<Eigen::Vector3d> unknown_;                   ///< points of the cell that nobody has seen
  std::uint32_t num_points_ = 0;                           ///< looked at so far, modulo 2^32
  bool has_given_up_ = false;
};

/// What a slice looks at in each cell: see OccupancySlice::points_a_cell.
std::int64_t PointsACell(const SliceOptions& options, double voxel_size_m);

/// Around all that is known in the band, by blocks of voxels, in the asker's frame; nothing if nothing is.
std::optional<Eigen::AlignedBox2d> KnownArea(const MapSurfaces& surfaces, const SliceOptions& options);

}  // namespace dhpmap
