// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/lidar_bins.h"

#include <algorithm>

#include "mapping/space/camera_kernel.h"
#include "mapping/space/lidar_kernel.h"

namespace dhpmap {
namespace {

// A pyramid cell of this width spans 13 degrees. What is tested covers less, except close to the scanner.
constexpr int kColumnsACell = 64;

}  // namespace

void LidarBins::ChooseWindow() {
  int first_row = kElevationBins, last_row = -1, first_column = kAzimuthBins, last_column = -1;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i] < 0) continue;
    first_row = std::min(first_row, rows_[i]), last_row = std::max(last_row, rows_[i]);
    first_column = std::min(first_column, columns_[i]), last_column = std::max(last_column, columns_[i]);
  }
  window_ = {first_row, std::max(0, last_row - first_row + 1), 0, kAzimuthBins};
  if (window_.height == 0) return;
  // Leaves a column without points on either side, so that bins beyond the window are like those at its edges.
  const int begin = (first_column - 1) / kColumnsACell * kColumnsACell;
  const int end = std::min(kAzimuthBins, (last_column + 1) / kColumnsACell * kColumnsACell + kColumnsACell);
  const bool has_edges = first_column > 0 && last_column + 1 < kAzimuthBins;
  const int num_beyond = first_column + kAzimuthBins - last_column;
  if (has_edges && num_beyond > static_cast<int>(BeamGaps::kMostBins)) {
    window_.first_column = begin;
    window_.width = end - begin;
  }
}

void LidarBins::Build(const LidarData& data, const LookOptions& options) {
  const std::size_t num_points = data.points_m.size();
  columns_.resize(num_points), rows_.resize(num_points), of_points_vox_.resize(num_points);
  const ReturnRule rule{options.margin_m, options.max_range_m, options.voxel_size_m};
  if (num_points > 0) {
    PlaceReturns(data.points_m.data()->data(), num_points, rule,
                 {columns_.data(), rows_.data(), of_points_vox_.data()});
  }
  ChooseWindow();
  const auto width = static_cast<std::size_t>(window_.width), height = static_cast<std::size_t>(window_.height);
  limits_vox_.assign(width * height, kNoLimit);
  for (std::size_t i = 0; i < num_points; ++i) {
    if (rows_[i] < 0) continue;
    const auto row = static_cast<std::size_t>(rows_[i] - window_.first_row);
    const auto column = static_cast<std::size_t>(columns_[i] - window_.first_column);
    float& limit = limits_vox_[row * width + column];
    limit = std::min(limit, of_points_vox_[i]);
  }
  gaps_.FillColumns(width, height, limits_vox_);
  gaps_.FillRows(width, height, kAzimuthBins, limits_vox_);
}

}  // namespace dhpmap
