// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/earlier_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dhpmap {
namespace {

/// A cell is about a third of a degree of a usual camera.
constexpr int kNumColumns = 160;
/// What noise and the coarse image may be off by.
constexpr float kTolerance_m = 0.02f, kToleranceShare = 0.015f;

}  // namespace

ViewFit& ViewFit::operator+=(const ViewFit& other) {
  num_points += other.num_points;
  num_agreeing += other.num_agreeing;
  num_before += other.num_before;
  num_behind += other.num_behind;
  return *this;
}

EarlierView::EarlierView(const PanopticFrame& frame)
    : claim_(SensorClaim::Of(frame)),
      step_px_(std::max(1, std::max(claim_.camera->width_px, claim_.camera->height_px) / kNumColumns)),
      num_columns_(claim_.camera->width_px / step_px_),
      num_rows_(claim_.camera->height_px / step_px_) {
  depth_m_.reserve(static_cast<std::size_t>(num_columns_) * static_cast<std::size_t>(num_rows_));
  for (int row = 0; row < num_rows_; ++row) {
    const int v = row * step_px_ + step_px_ / 2;
    const float* const depth_m =
        frame.camera->depth_m.data() + static_cast<std::ptrdiff_t>(v) * claim_.camera->width_px;
    for (int column = 0; column < num_columns_; ++column) {
      const float d_m = depth_m[column * step_px_ + step_px_ / 2];
      depth_m_.push_back(std::isfinite(d_m) && d_m > 0 ? d_m : 0);
    }
  }
}

EarlierView::DepthRange EarlierView::DepthAround(int column, int row) const {
  DepthRange range{std::numeric_limits<float>::infinity(), 0};
  for (int y = std::max(0, row - 1); y <= std::min(num_rows_ - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(num_columns_ - 1, column + 1); ++x) {
      const float d_m =
          depth_m_[static_cast<std::size_t>(y) * static_cast<std::size_t>(num_columns_) + static_cast<std::size_t>(x)];
      if (d_m <= 0) continue;
      range.least_m = std::min(range.least_m, d_m);
      range.greatest_m = std::max(range.greatest_m, d_m);
    }
  }
  return range;
}

ViewFit EarlierView::FitOf(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor,
                           const SensorClaim& claim) const {
  const Eigen::Isometry3f T_here_sensor = (claim.T_map_sensor.inverse() * T_map_sensor).cast<float>();
  const PinholeCamera& camera = *claim.camera;
  const auto fx = static_cast<float>(camera.fx_px), fy = static_cast<float>(camera.fy_px);
  const auto cx = static_cast<float>(camera.cx_px), cy = static_cast<float>(camera.cy_px);
  const auto step = static_cast<float>(step_px_);
  ViewFit fit;
  fit.num_points = points_m.size();
  for (const Eigen::Vector3f& p_m : points_m) {
    const Eigen::Vector3f q_m = T_here_sensor * p_m;
    if (!(q_m.z() > kTolerance_m)) continue;
    const float column = std::floor((fx * q_m.x() / q_m.z() + cx + 0.5f) / step);
    const float row = std::floor((fy * q_m.y() / q_m.z() + cy + 0.5f) / step);
    if (!(column >= 0 && row >= 0 && column < static_cast<float>(num_columns_) &&
          row < static_cast<float>(num_rows_))) {
      continue;
    }
    const DepthRange range = DepthAround(static_cast<int>(column), static_cast<int>(row));
    if (range.empty()) continue;
    const float tolerance_m = kTolerance_m + kToleranceShare * q_m.z();
    if (q_m.z() < range.least_m - tolerance_m) ++fit.num_before;
    else if (q_m.z() > range.greatest_m + tolerance_m) ++fit.num_behind;
    else ++fit.num_agreeing;
  }
  return fit;
}

}  // namespace dhpmap
