// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/occupancy_slice.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

/// Number of equal parts of a length that are at most `step_m`, up to rounding.
int NumParts(double length_m, double step_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / step_m - 1e-6)));
}

/// Distance of sample points that misses no voxel whose centre is in a cell.
double StepOf(const SliceOptions& options, double voxel_size_m) {
  const Eigen::Matrix3d axes = options.T_map_query.linear().cwiseAbs();
  const bool is_turned = ((axes.array() > 1e-9) && (axes.array() < 1 - 1e-9)).any();
  constexpr double kTurned_vox = 0.57;  // less than 1 / sqrt(3)
  return (is_turned ? kTurned_vox : 1.0) * voxel_size_m;
}

}  // namespace

std::int64_t PointsACell(const SliceOptions& options, double voxel_size_m) {
  const double step_m = StepOf(options, voxel_size_m);
  const double side = std::ceil(options.resolution_m / step_m);
  const double up = std::ceil((options.max_z_m - options.min_z_m) / step_m);
  return static_cast<std::int64_t>(std::min(std::max(side * side * up, 1.0), 1e15));
}

OccupancySlice::OccupancySlice(const std::shared_ptr<const MapSurfaces>& surfaces, SliceOptions options)
    : options_(std::move(options)),
      world_(surfaces, options_.scope),
      states_(surfaces, {.max_distance_m = options_.max_distance_m, .scope = options_.scope}, options_.with_objects),
      surface_(world_, options_) {
  const double step_m = StepOf(options_, world_.voxel_size_m());
  const double band_m = options_.max_z_m - options_.min_z_m;
  num_side_ = NumParts(options_.resolution_m, step_m);
  num_up_ = NumParts(band_m, step_m);
  const Eigen::Matrix3d axes = options_.T_map_query.linear();
  side_x_m_ = axes.col(0) * (options_.resolution_m / num_side_);
  side_y_m_ = axes.col(1) * (options_.resolution_m / num_side_);
  up_m_ = axes.col(2) * (band_m / num_up_);
}

void OccupancySlice::Row(int y, std::span<std::int8_t> cells, std::span<const SubmapInfo*> objects,
                         const std::stop_token& stop) {
  const std::uint32_t* owners = surface_.Row(y, stop);
  has_given_up_ = has_given_up_ || stop.stop_requested();
  const std::span<const SubmapIndex::Entry> entries = world_.surfaces().index().entries();
  for (std::size_t x = 0; x < cells.size() && !has_given_up_; ++x) {
    const bool has_surface = owners[x] != SliceSurface::kNobody;
    const Cell cell =
        has_surface ? Cell{kOccupiedCell, &entries[owners[x]].submap().info()} : CellAt(static_cast<int>(x), y, stop);
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
  counts_.clear();
  unknown_.clear();
  for (int j = 0; j < num_side_; ++j) {
    for (int i = 0; i < num_side_; ++i) {
      for (int k = 0; k < num_up_; ++k) {
        if (GivesUp(stop)) return {options_.unknown, nullptr};
        const Eigen::Vector3d p = corner + (i + 0.5) * side_x_m_ + (j + 0.5) * side_y_m_ + (k + 0.5) * up_m_;
        const VoxelStates::Voxel voxel = states_.At(p);
        num_free += voxel.state == VoxelState::kFree;
        if (voxel.state == VoxelState::kUnknown) unknown_.push_back(p);
        if (voxel.state != VoxelState::kInside) continue;
        if (!options_.with_objects) return {kOccupiedCell, nullptr};
        CountInside(voxel);
      }
    }
  }
  for (std::size_t i = 0; i < unknown_.size() && options_.unknown == kFreeCell; ++i) {
    if (GivesUp(stop)) return {options_.unknown, nullptr};
    const VoxelStates::Voxel voxel = states_.UnseenAt(unknown_[i]);
    if (voxel.state != VoxelState::kInside) continue;
    if (!options_.with_objects) return {kOccupiedCell, nullptr};
    CountInside(voxel);
  }
  if (!counts_.empty()) return {kOccupiedCell, MostOften()};
  if (!unknown_.empty() && options_.unknown == kOccupiedCell) return {kOccupiedCell, nullptr};
  const bool is_free = static_cast<double>(num_free) >= options_.free_share * static_cast<double>(points_a_cell());
  return {is_free && num_free > 0 ? kFreeCell : options_.unknown, nullptr};
}

void OccupancySlice::CountInside(const VoxelStates::Voxel& voxel) {
  const auto known =
      std::find_if(counts_.begin(), counts_.end(), [&voxel](const auto& count) { return count.first == voxel.submap; });
  if (known != counts_.end()) ++known->second;
  else counts_.emplace_back(voxel.submap, 1);
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
