// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/lidar_view.h"

#include <algorithm>
#include <cmath>

#include "mapping/space/beam_gaps.h"
#include "mapping/space/camera_kernel.h"

namespace dhpmap {
namespace {

constexpr double kLeastRange_m = 1e-3;  // nearer than any scanner measures
constexpr float kRangeSlack_vox = 2e-3f;
constexpr auto kColumns = static_cast<std::size_t>(kAzimuthBins);

}  // namespace

/// The bins of elevation that have points, and in each bin how far its points let us see.
void LidarView::BinPoints(const LidarData& data, const LookOptions& options) {
  struct Return {
    std::size_t column;
    int row;
    float limit_vox;
  };
  std::vector<Return> returns;
  returns.reserve(data.points_m.size());
  int first_row = kElevationBins, last_row = -1;
  first_column_ = kColumns, last_column_ = 0;
  for (const Eigen::Vector3f& p : data.points_m) {
    const double range = p.cast<double>().norm();
    if (!(range >= kLeastRange_m)) continue;
    const Eigen::Vector3f ray = (p.cast<double>() / range).cast<float>();
    const Direction direction = DirectionOf(ray.x(), ray.y(), ray.z());
    const int column = std::clamp(static_cast<int>(direction.azimuth), 0, kAzimuthBins - 1);
    const int row = std::clamp(static_cast<int>(direction.elevation), 0, kElevationBins - 1);
    const double before_m = std::clamp(range - options.margin_m, 0.0, options.max_range_m);
    first_row = std::min(first_row, row);
    last_row = std::max(last_row, row);
    first_column_ = std::min(first_column_, static_cast<std::size_t>(column));
    last_column_ = std::max(last_column_, static_cast<std::size_t>(column));
    returns.push_back({static_cast<std::size_t>(column), row, static_cast<float>(before_m / options.voxel_size_m)});
  }
  geometry_.first_row = first_row;
  geometry_.height = std::max(0, last_row - first_row + 1);
  geometry_.last_u = std::nextafter(static_cast<float>(kAzimuthBins), 0.0f);
  geometry_.last_v = std::nextafter(static_cast<float>(geometry_.height), 0.0f);
  bins_.assign(kColumns * static_cast<std::size_t>(geometry_.height), kNoLimit);
  for (const Return& r : returns) {
    float& limit = bins_[static_cast<std::size_t>(r.row - first_row) * kColumns + r.column];
    limit = std::min(limit, r.limit_vox);
  }
}

void LidarView::BuildGeometry(const Eigen::Matrix3d& R_sensor_grid) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d row = R_sensor_grid.row(axis);
    for (int i = 0; i < 3; ++i) geometry_.R[axis][i] = static_cast<float>(row[i]);
    for (int i = 0; i < kOctantVoxels; ++i) {
      const Eigen::Vector3d offset(i & 3, i >> 2 & 3, i >> 4);
      geometry_.voxels[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)] =
          static_cast<float>(row.dot(offset));
    }
  }
}

void LidarView::Build(const LidarData& data, const Eigen::Matrix3d& R_sensor_grid, const LookOptions& options,
                      ThreadPool& pool) {
  BinPoints(data, options);
  BuildGeometry(R_sensor_grid);
  const auto height = static_cast<std::size_t>(geometry_.height);
  if (height > 0) {  // a camera's sector is a fifth of all columns
    FillBetweenBeams({.first_line = first_column_,
                      .num_lines = last_column_ - first_column_ + 1,
                      .line_step = 1,
                      .num_bins = height,
                      .bin_step = kColumns,
                      .go_around = false},
                     bins_);
  }
  FillBetweenBeams({.num_lines = height, .line_step = kColumns, .num_bins = kColumns, .bin_step = 1, .go_around = true},
                   bins_);

  // Each bin takes the least of the nine around, and nothing where one of them is missing. Azimuths go around.
  image_.width = kAzimuthBins;
  image_.height = geometry_.height;
  image_.limit_vox.assign(bins_.size(), 0.0f);
  constexpr std::size_t kRowsPerBand = 16;
  pool.ParallelFor((height + kRowsPerBand - 1) / kRowsPerBand, [&](std::size_t band) {
    std::vector<float> least(kColumns + 2);  // scratch
    for (std::size_t v = band * kRowsPerBand; v < std::min(height, (band + 1) * kRowsPerBand); ++v) {
      if (v == 0 || v + 1 == height) continue;
      const float* above = bins_.data() + (v - 1) * kColumns;
      SpreadRow(above, above + kColumns, above + 2 * kColumns, kAzimuthBins, least.data(),
                image_.limit_vox.data() + v * kColumns);
    }
  });
  pyramid_.Build(image_);
}

Box LidarView::Reach() const {
  Box box;
  const double reach = pyramid_.most();
  if (!(reach > 0)) return box;
  box.least_vox = Eigen::Vector3d::Constant(-reach);
  box.most_vox = Eigen::Vector3d::Constant(reach);
  return box;
}

void LidarView::Classify(const CellBatch& cells, CellSights& sights) const {
  LidarBounds bounds;
  BoundCells(cells, geometry_, bounds);
  const auto first_row = static_cast<float>(geometry_.first_row);
  const auto last_u = static_cast<float>(kAzimuthBins - 1), last_v = static_cast<float>(geometry_.height - 1);
  for (std::size_t i = 0; i < kLanes; ++i) {
    sights[i] = CellSight::kHidden;
    const float near = bounds.near[i] - kRangeSlack_vox, far = bounds.far[i] + kRangeSlack_vox;
    if (near >= pyramid_.most()) continue;
    const float v0 = bounds.elevation0[i] - first_row, v1 = bounds.elevation1[i] - first_row;
    if (v1 < 0 || v0 >= last_v + 1) continue;
    const float u0 = bounds.azimuth0[i], u1 = bounds.azimuth1[i];
    if (u0 < 0 || u1 >= last_u + 1) {  // goes on at the other edge
      sights[i] = CellSight::kMixed;
      continue;
    }
    const SightPyramid::Span span = pyramid_.Over(static_cast<int>(u0), static_cast<int>(std::max(v0, 0.0f)),
                                                  static_cast<int>(u1), static_cast<int>(std::min(v1, last_v)));
    if (span.most <= near) continue;
    const bool is_inside = v0 >= 0 && v1 < last_v + 1;
    sights[i] = is_inside && span.least > far ? CellSight::kFree : CellSight::kMixed;
  }
}

void LidarView::LookPast(const BallBatch& balls, std::array<bool, kLanes>& is_past) const {
  LidarBounds bounds;
  BoundBalls(balls, geometry_, bounds);
  const auto first_row = static_cast<float>(geometry_.first_row), end_v = static_cast<float>(geometry_.height);
  for (std::size_t i = 0; i < kLanes; ++i) {
    is_past[i] = false;
    const float far = bounds.far[i] + kRangeSlack_vox;
    const float u0 = bounds.azimuth0[i], u1 = bounds.azimuth1[i];
    const float v0 = bounds.elevation0[i] - first_row, v1 = bounds.elevation1[i] - first_row;
    if (far >= pyramid_.most() || !(v0 >= 0 && v1 < end_v) || u1 - u0 >= kAzimuthBins) continue;
    const int first = static_cast<int>(std::floor(u0)), last = static_cast<int>(std::floor(u1));
    const auto least = [&](int from, int to) {
      return pyramid_.Over(from, static_cast<int>(v0), to, static_cast<int>(v1)).least;
    };
    if (first < 0) {  // goes on at the other edge
      is_past[i] = std::min(least(first + kAzimuthBins, kAzimuthBins - 1), least(0, last)) > far;
    } else if (last >= kAzimuthBins) {
      is_past[i] = std::min(least(first, kAzimuthBins - 1), least(0, last - kAzimuthBins)) > far;
    } else {
      is_past[i] = least(first, last) > far;
    }
  }
}

}  // namespace dhpmap
