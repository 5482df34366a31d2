// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/occupancy_slice.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

/// Parts of a length that are no longer than a voxel, but for rounding.
int NumParts(double length_m, double voxel_size_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / voxel_size_m - 1e-6)));
}

}  // namespace

std::int64_t PointsACell(double resolution_m, double band_m, double voxel_size_m) {
  const double side = std::ceil(resolution_m / voxel_size_m), up = std::ceil(band_m / voxel_size_m);
  return static_cast<std::int64_t>(std::min(std::max(side * side * up, 1.0), 1e15));
}

OccupancySlice::OccupancySlice(const std::shared_ptr<const MapSurfaces>& surfaces, SliceOptions options)
    : options_(std::move(options)), states_(surfaces, options_.scope, options_.with_objects) {
  const double voxel_size_m = surfaces->state().info().config.voxel_size_m;
  const double band_m = options_.max_z_m - options_.min_z_m;
  num_side_ = NumParts(options_.resolution_m, voxel_size_m);
  num_up_ = NumParts(band_m, voxel_size_m);
  const Eigen::Matrix3d axes = options_.T_map_query.linear();
  side_x_m_ = axes.col(0) * (options_.resolution_m / num_side_);
  side_y_m_ = axes.col(1) * (options_.resolution_m / num_side_);
  up_m_ = axes.col(2) * (band_m / num_up_);
}

void OccupancySlice::Row(int y, std::span<std::int8_t> cells, std::span<const SubmapInfo*> objects,
                         const std::stop_token& stop) {
  for (std::size_t x = 0; x < cells.size() && !has_given_up_; ++x) {
    const Cell cell = CellAt(static_cast<int>(x), y, stop);
    cells[x] = cell.value;
    if (!objects.empty()) objects[x] = cell.object;
  }
}

bool OccupancySlice::GivesUp(const std::stop_token& stop) {
  constexpr std::uint32_t kPointsALook = 4096;
  has_given_up_ = has_given_up_ || (++num_points_ % kPointsALook == 0 && stop.stop_requested());
  return has_given_up_;
}

OccupancySlice::Cell OccupancySlice::CellAt(int x, int y, const std::stop_token& stop) {
  const double side_m = options_.resolution_m;
  const Eigen::Vector3d corner =
      options_.T_map_query *
      Eigen::Vector3d(options_.min_m.x() + x * side_m, options_.min_m.y() + y * side_m, options_.min_z_m);
  std::int64_t num_free = 0;
  bool is_occupied = false;
  counts_.clear();
  for (int j = 0; j < num_side_; ++j) {
    for (int i = 0; i < num_side_; ++i) {
      for (int k = 0; k < num_up_; ++k) {
        if (GivesUp(stop)) return {options_.unknown, nullptr};
        const VoxelStates::Voxel voxel =
            states_.At(corner + (i + 0.5) * side_x_m_ + (j + 0.5) * side_y_m_ + (k + 0.5) * up_m_);
        num_free += voxel.state == VoxelState::kFree;
        if (voxel.state != VoxelState::kOccupied) continue;
        if (!options_.with_objects) return {kOccupiedCell, nullptr};
        is_occupied = true;
        const auto known = std::find_if(counts_.begin(), counts_.end(),
                                        [&voxel](const auto& count) { return count.first == voxel.submap; });
        if (known != counts_.end()) ++known->second;
        else counts_.emplace_back(voxel.submap, 1);
      }
    }
  }
  if (is_occupied) return {kOccupiedCell, MostOften()};
  const bool is_free = static_cast<double>(num_free) >= options_.free_share * static_cast<double>(points_a_cell());
  return {is_free && num_free > 0 ? kFreeCell : options_.unknown, nullptr};
}

const SubmapInfo* OccupancySlice::MostOften() {
  return std::max_element(counts_.begin(), counts_.end(),
                          [](const auto& a, const auto& b) {
                            return a.second != b.second ? a.second < b.second : a.first->id > b.first->id;
                          })
      ->first;
}

std::optional<Eigen::AlignedBox2d> KnownArea(const MapSurfaces& surfaces, const SliceOptions& options) {
  const Transform T_query_map = options.T_map_query.inverse();
  Eigen::AlignedBox2d area;
  const auto add = [&](const Eigen::AlignedBox3d& box_m, const Transform& T_query_box) {
    const Eigen::AlignedBox3d box = box_m.transformed(T_query_box);
    if (box.max().z() <= options.min_z_m || box.min().z() >= options.max_z_m) return;
    area.extend(Eigen::AlignedBox2d(box.min().head<2>(), box.max().head<2>()));
  };
  for (const SubmapIndex::Entry& entry : surfaces.index().entries()) {
    const SubmapInfo& submap = entry.submap().info();
    if (options.scope.Holds(submap)) add(entry.box_m(), T_query_map * submap.T_map_submap);
  }
  const double voxel_size_m = surfaces.state().info().config.voxel_size_m;
  for (const FreeTileEntry& tile : surfaces.state().free_space()->tiles()) {
    const std::uint64_t cells = tile.tile->full() | tile.tile->mixed();
    for (int cell = 0; cell < kTileBlocks; ++cell) {
      if ((cells >> cell & 1u) == 0) continue;
      const Eigen::Vector3d corner = BlockCorner(BlockIn(tile.index, cell), voxel_size_m);
      add({corner, corner + Eigen::Vector3d::Constant(kBlockSide * voxel_size_m)}, T_query_map);
    }
  }
  if (area.isEmpty()) return std::nullopt;
  return area;
}

}  // namespace dhpmap
