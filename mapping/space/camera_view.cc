// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/camera_view.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

// Sizes of the parts that run in parallel.
constexpr int kRowsPerBand = 30;

// A result for a cell must hold for each of its voxels as TestOctant computes it, in single precision: up to 600 voxels
// away and 8192 pixels wide, with a relative error of 2^-22.
constexpr float kSlack_vox = 2e-3f;
constexpr float kSlack_px = 1e-2f;

}  // namespace

void CameraView::BuildImage(const DepthCameraData& data, const LookOptions& options, ThreadPool& pool) {
  const PinholeCamera& camera = data.camera;
  image_.width = camera.width_px / 2;  // an odd row or column has no 2 x 2 pixels
  image_.height = camera.height_px / 2;
  const auto width = static_cast<std::size_t>(image_.width), height = static_cast<std::size_t>(image_.height);
  const std::size_t stride = width + 2;
  raw_.resize(stride * (height + 2));
  image_.limit_vox.resize(width * height);
  std::fill_n(raw_.begin(), stride, kNoLimit);
  std::fill_n(raw_.end() - static_cast<std::ptrdiff_t>(stride), stride, kNoLimit);

  // The ray through the centre of 2 x 2 pixels represents them.
  std::vector<float> column_length2(width);
  for (std::size_t u = 0; u < width; ++u) {
    const double x = (2.0 * static_cast<double>(u) + 0.5 - camera.cx_px) / camera.fx_px;
    column_length2[u] = static_cast<float>(x * x);
  }
  const std::size_t num_bands = (height + kRowsPerBand - 1) / kRowsPerBand;
  pool.ParallelFor(num_bands, [&](std::size_t band) {
    for (std::size_t v = band * kRowsPerBand; v < std::min(height, (band + 1) * kRowsPerBand); ++v) {
      const double y = (2.0 * static_cast<double>(v) + 0.5 - camera.cy_px) / camera.fy_px;
      const LimitRowGeometry geometry{column_length2.data(), static_cast<float>(y * y + 1.0),
                                      static_cast<float>(options.margin_m), static_cast<float>(options.max_range_m),
                                      static_cast<float>(1.0 / options.voxel_size_m)};
      float* row = raw_.data() + (v + 1) * stride;
      row[0] = row[width + 1] = kNoLimit;
      const float* depth = data.depth_m.data() + 2 * v * static_cast<std::size_t>(camera.width_px);
      LimitRow(depth, depth + camera.width_px, image_.width, geometry, row + 1);
    }
  });
  pool.ParallelFor(num_bands, [&](std::size_t band) {
    std::vector<float> scratch(2 * stride);
    for (std::size_t v = band * kRowsPerBand; v < std::min(height, (band + 1) * kRowsPerBand); ++v) {
      const float* above = raw_.data() + v * stride;
      CloseRow(above, above + stride, above + 2 * stride, image_.width, scratch.data(), scratch.data() + stride,
               image_.limit_vox.data() + v * width);
    }
  });
}

void CameraView::BuildGeometry(const PinholeCamera& camera, const Eigen::Matrix3d& R_camera_grid) {
  geometry_.fx = static_cast<float>(0.5 * camera.fx_px);
  geometry_.fy = static_cast<float>(0.5 * camera.fy_px);
  geometry_.cx = static_cast<float>(0.5 * (camera.cx_px + 0.5));  // pixel centres are integers in the full image
  geometry_.cy = static_cast<float>(0.5 * (camera.cy_px + 0.5));
  geometry_.width = image_.width;
  geometry_.height = image_.height;
  geometry_.last_u = std::nextafter(static_cast<float>(image_.width), 0.0f);
  geometry_.last_v = std::nextafter(static_cast<float>(image_.height), 0.0f);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Eigen::Vector3d row = R_camera_grid.row(axis);
    for (int i = 0; i < 3; ++i) geometry_.R[axis][i] = static_cast<float>(row[i]);
    for (std::size_t size = 0; size < kNumCellSizes; ++size) {
      const double half = HalfSpanOf(static_cast<CellSize>(size));
      for (std::size_t corner = 0; corner < kLanes; ++corner) {
        const Eigen::Vector3d offset((corner & 1) != 0 ? half : -half, (corner & 2) != 0 ? half : -half,
                                     (corner & 4) != 0 ? half : -half);
        geometry_.corners[size][a][corner] = static_cast<float>(row.dot(offset));
      }
    }
    for (int i = 0; i < kOctantVoxels; ++i) {
      const Eigen::Vector3d offset(i & 3, i >> 2 & 3, i >> 4);
      geometry_.voxels[a][static_cast<std::size_t>(i)] = static_cast<float>(row.dot(offset));
    }
  }
}

void CameraView::Build(const DepthCameraData& data, const Eigen::Matrix3d& R_camera_grid, const LookOptions& options,
                       ThreadPool& pool) {
  BuildImage(data, options, pool);
  BuildGeometry(data.camera, R_camera_grid);
  pyramid_.Build(image_);
}

Box CameraView::Reach() const {
  Box box;
  const double depth = pyramid_.most();
  if (!(depth > 0)) return box;
  box.least_vox = box.most_vox = Eigen::Vector3d::Zero();  // the sensor
  for (const double u : {0.0, static_cast<double>(geometry_.width)}) {
    for (const double v : {0.0, static_cast<double>(geometry_.height)}) {
      const double x = depth * (u - geometry_.cx) / geometry_.fx, y = depth * (v - geometry_.cy) / geometry_.fy;
      Eigen::Vector3d corner;
      for (int axis = 0; axis < 3; ++axis) {
        corner[axis] = geometry_.R[0][axis] * x + geometry_.R[1][axis] * y + geometry_.R[2][axis] * depth;
      }
      box.least_vox = box.least_vox.cwiseMin(corner);
      box.most_vox = box.most_vox.cwiseMax(corner);
    }
  }
  return box;
}

void CameraView::Classify(const CellBatch& cells, CellSights& sights) const {
  CellBounds bounds;
  BoundCells(cells, geometry_, bounds);
  const auto last_u = static_cast<float>(geometry_.width - 1), last_v = static_cast<float>(geometry_.height - 1);
  for (std::size_t i = 0; i < kLanes; ++i) {
    sights[i] = CellSight::kHidden;
    const float near = bounds.near[i] - kSlack_vox, far = bounds.far[i] + kSlack_vox;
    if (far <= 0 || near >= pyramid_.most()) continue;
    if (near <= kSlack_vox) {  // around the sensor, where no pixel can be computed
      sights[i] = CellSight::kMixed;
      continue;
    }
    const float u0 = bounds.u0[i] - kSlack_px, u1 = bounds.u1[i] + kSlack_px;
    const float v0 = bounds.v0[i] - kSlack_px, v1 = bounds.v1[i] + kSlack_px;
    // In this form NaN, from an absurd focal length, counts as out of view.
    if (!(u1 >= 0 && v1 >= 0 && u0 < last_u + 1 && v0 < last_v + 1)) continue;
    const bool is_inside = u0 >= 0 && v0 >= 0 && u1 < last_u + 1 && v1 < last_v + 1;
    const SightPyramid::Span span =
        pyramid_.Over(static_cast<int>(std::max(u0, 0.0f)), static_cast<int>(std::max(v0, 0.0f)),
                      static_cast<int>(std::min(u1, last_u)), static_cast<int>(std::min(v1, last_v)));
    if (span.most <= near) continue;
    sights[i] = is_inside && span.least > far ? CellSight::kFree : CellSight::kMixed;
  }
}

bool CameraView::AllSeeFartherThan(float far_vox, int u0, int v0, int u1, int v1) const {
  // For few pixels the pyramid would include too many neighbours.
  constexpr int kFew = 64;
  if ((u1 - u0 + 1) * (v1 - v0 + 1) > kFew) return pyramid_.Over(u0, v0, u1, v1).least > far_vox;
  for (int v = v0; v <= v1; ++v) {
    const float* row = image_.limit_vox.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(image_.width);
    unsigned is_any_nearer = 0;  // no branches within a row
    for (int u = u0; u <= u1; ++u) is_any_nearer |= static_cast<unsigned>(row[u] <= far_vox);
    if (is_any_nearer != 0) return false;
  }
  return true;
}

void CameraView::LookPast(const BallBatch& balls, std::array<bool, kLanes>& is_past) const {
  CellBounds bounds;
  BoundBalls(balls, geometry_, bounds);
  const auto end_u = static_cast<float>(geometry_.width), end_v = static_cast<float>(geometry_.height);
  for (std::size_t i = 0; i < kLanes; ++i) {
    is_past[i] = false;
    const float near = bounds.near[i] - kSlack_vox, far = bounds.far[i] + kSlack_vox;
    if (near <= kSlack_vox || far >= pyramid_.most()) continue;
    const float u0 = bounds.u0[i] - kSlack_px, u1 = bounds.u1[i] + kSlack_px;
    const float v0 = bounds.v0[i] - kSlack_px, v1 = bounds.v1[i] + kSlack_px;
    if (!(u0 >= 0 && v0 >= 0 && u1 < end_u && v1 < end_v)) continue;
    is_past[i] =
        AllSeeFartherThan(far, static_cast<int>(u0), static_cast<int>(v0), static_cast<int>(u1), static_cast<int>(v1));
  }
}

}  // namespace dhpmap
