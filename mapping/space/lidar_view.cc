// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/lidar_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mapping/space/lidar_kernel.h"

namespace dhpmap {
namespace {

constexpr float kRangeSlack_vox = 2e-3f;

}  // namespace

void LidarView::BuildGeometry(const Eigen::Matrix3d& R_sensor_grid) {
  const LidarWindow& window = bins_.window();
  geometry_.first_row = window.first_row;
  geometry_.first_column = window.first_column;
  geometry_.width = window.width;
  geometry_.first_u = static_cast<float>(window.first_column);
  geometry_.last_u = std::nextafter(static_cast<float>(window.first_column + window.width), 0.0f);
  geometry_.last_v = std::nextafter(static_cast<float>(window.height), 0.0f);
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
  bins_.Build(data, options);
  BuildGeometry(R_sensor_grid);
  SpreadBins(pool);
  pyramid_.Build(image_);
}

/// Each bin takes the minimum of the 3 x 3 bins around it, and 0 if one of them has no beam. Azimuths wrap around.
void LidarView::SpreadBins(ThreadPool& pool) {
  image_.width = window().width;
  image_.height = window().height;
  const std::vector<float>& bins = bins_.limits_vox();
  image_.limit_vox.assign(bins.size(), 0.0f);
  const auto width = static_cast<std::size_t>(image_.width), height = static_cast<std::size_t>(image_.height);
  constexpr std::size_t kRowsPerBand = 16;
  pool.ParallelFor((height + kRowsPerBand - 1) / kRowsPerBand, [&](std::size_t band) {
    std::vector<float> least(width + 2);  // scratch
    for (std::size_t v = band * kRowsPerBand; v < std::min(height, (band + 1) * kRowsPerBand); ++v) {
      if (v == 0 || v + 1 == height) continue;
      const float* above = bins.data() + (v - 1) * width;
      SpreadRow(above, above + width, above + 2 * width, image_.width, least.data(),
                image_.limit_vox.data() + v * width);
    }
  });
}

SightPyramid::Span LidarView::OverEdge(int first_column, int last_column, int v0, int v1) const {
  if (first_column < 0 || last_column >= kAzimuthBins) {  // continues at the other edge
    const auto around = [](int column) { return (column + kAzimuthBins) % kAzimuthBins; };
    const SightPyramid::Span left = Over(around(first_column), kAzimuthBins - 1, v0, v1);
    const SightPyramid::Span right = Over(0, around(last_column), v0, v1);
    return {std::min(left.least, right.least), std::max(left.most, right.most)};
  }
  const LidarWindow& window = bins_.window();
  const int u0 = first_column - window.first_column, u1 = last_column - window.first_column;
  if (u1 < 0 || u0 >= window.width) return {0, 0};
  SightPyramid::Span span = pyramid_.Over(std::max(u0, 0), v0, std::min(u1, window.width - 1), v1);
  if (u0 < 0 || u1 >= window.width) span.least = 0;
  return span;
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
  const auto first_row = static_cast<float>(window().first_row), last_v = static_cast<float>(window().height - 1);
  for (std::size_t i = 0; i < kLanes; ++i) {
    sights[i] = CellSight::kHidden;
    const float near = bounds.near[i] - kRangeSlack_vox, far = bounds.far[i] + kRangeSlack_vox;
    if (near >= pyramid_.most()) continue;
    const float v0 = bounds.elevation0[i] - first_row, v1 = bounds.elevation1[i] - first_row;
    if (v1 < 0 || v0 >= last_v + 1) continue;
    const bool is_around = bounds.azimuth1[i] - bounds.azimuth0[i] >= kAzimuthBins;
    const SightPyramid::Span span = Over(is_around ? 0 : static_cast<int>(std::floor(bounds.azimuth0[i])),
                                         is_around ? kAzimuthBins - 1 : static_cast<int>(bounds.azimuth1[i]),
                                         static_cast<int>(std::max(v0, 0.0f)), static_cast<int>(std::min(v1, last_v)));
    if (span.most <= near) continue;
    const bool is_inside = v0 >= 0 && v1 < last_v + 1;
    sights[i] = is_inside && span.least > far ? CellSight::kFree : CellSight::kMixed;
  }
}

void LidarView::LookPast(const BallBatch& balls, std::array<bool, kLanes>& is_past) const {
  LidarBounds bounds;
  BoundBalls(balls, geometry_, bounds);
  const auto first_row = static_cast<float>(window().first_row), end_v = static_cast<float>(window().height);
  for (std::size_t i = 0; i < kLanes; ++i) {
    is_past[i] = false;
    const float far = bounds.far[i] + kRangeSlack_vox;
    const float u0 = bounds.azimuth0[i], u1 = bounds.azimuth1[i];
    const float v0 = bounds.elevation0[i] - first_row, v1 = bounds.elevation1[i] - first_row;
    if (far >= pyramid_.most() || !(v0 >= 0 && v1 < end_v) || u1 - u0 >= kAzimuthBins) continue;
    const SightPyramid::Span span = Over(static_cast<int>(std::floor(u0)), static_cast<int>(std::floor(u1)),
                                         static_cast<int>(v0), static_cast<int>(v1));
    is_past[i] = span.least > far;
  }
}

}  // namespace dhpmap
