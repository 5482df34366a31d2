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

/// Cells of a slice, row by row. A cell is occupied if any surface lies within it and the height band, or any inside of
/// an object, or, with unknown as occupied, any unseen point. Otherwise it is free if at least the given fraction of it
/// is, else unknown.
///
/// Surfaces are clipped to the cell exactly. The rest is sampled at points at most a voxel apart (.57 of one if the
/// frame is rotated against the map's), at the centres of equal parts; in the map's own frame, on multiples of the
/// voxel size, these are the voxel centres (see VoxelStates). The inside of unseen space counts only if unknown is
/// free.
///
/// Guarantee: a ball of radius r of at least half a voxel's diagonal that stays between min_z_m + r and max_z_m - r,
/// and farther than r from all cells that are not free, has no contact by BodyQuery or SweepQuery with the same
/// treatment of unknown. One thread.
class OccupancySlice {
 public:
  OccupancySlice(const std::shared_ptr<const MapSurfaces>& surfaces, SliceOptions options);
  OccupancySlice(const OccupancySlice&) = delete;
  OccupancySlice& operator=(const OccupancySlice&) = delete;

  /// Row y, `width` cells from x = 0 on. `objects`, if wanted, has the same size: the owner of most of the cell's
  /// surface, else of most of its inside; null without either. Valid as long as the surfaces. Stops soon after a `stop`
  /// request with a meaningless row; a single cell may have millions of points.
  void Row(int y, std::span<std::int8_t> cells, std::span<const SubmapInfo*> objects, const std::stop_token& stop = {});

  /// Number of sample points of a cell.
  [[nodiscard]] std::int64_t points_a_cell() const { return std::int64_t{num_side_} * num_side_ * num_up_; }

 private:
  struct Cell {
    std::int8_t value;
    const SubmapInfo* object;
  };
  /// For a cell without surface.
  Cell CellAt(int x, int y, const std::stop_token& stop);
  void CountInside(const VoxelStates::Voxel& voxel);
  /// Polls once in some thousand points.
  bool GivesUp(const std::stop_token& stop);
  [[nodiscard]] const SubmapInfo* MostOften();

  const SliceOptions options_;
  const QueryWorld world_;
  VoxelStates states_;
  SliceSurface surface_;
  int num_side_, num_up_;
  Eigen::Vector3d side_x_m_, side_y_m_, up_m_;             ///< steps between sample points, map frame
  std::vector<std::pair<const SubmapInfo*, int>> counts_;  ///< points inside of objects, by object
  std::vector<Eigen::Vector3d> unknown_;                   ///< unseen points of the cell
  std::uint32_t num_points_ = 0;                           ///< points sampled so far, modulo 2^32
  bool has_given_up_ = false;
};

/// Sample points of a slice's cell: see OccupancySlice::points_a_cell.
std::int64_t PointsACell(const SliceOptions& options, double voxel_size_m);

/// Bounds of known space in the band, in whole blocks, in the query's frame; nothing if there is none.
std::optional<Eigen::AlignedBox2d> KnownArea(const MapSurfaces& surfaces, const SliceOptions& options);

}  // namespace dhpmap
