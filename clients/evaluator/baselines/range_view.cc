// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/range_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace dhpmap::evaluator {
namespace {

constexpr int kScanColumns = 1024, kScanRows = 64;
constexpr float kDegree = std::numbers::pi_v<float> / 180.0f;
constexpr float kScanTop = 3.0f * kDegree, kScanBottom = -25.0f * kDegree;
constexpr float kColumnAngle = 2.0f * std::numbers::pi_v<float> / kScanColumns;
constexpr float kRowAngle = (kScanTop - kScanBottom) / (kScanRows - 1);
constexpr float kMaxStep_m = 0.2f;  ///< neighbours that differ more are on different surfaces

/// Rows of a frame's segment table by segment id.
class RowFinder {
 public:
  explicit RowFinder(const PanopticFrame& frame) {
    for (std::size_t i = 0; i < frame.segments.size(); ++i) {
      rows_.emplace(frame.segments[i].id.value, static_cast<int>(i));
    }
  }
  int operator()(std::uint32_t segment) {
    if (segment != last_segment_) {
      const auto it = rows_.find(segment);
      last_segment_ = segment;
      last_row_ = it == rows_.end() ? -1 : it->second;
    }
    return last_row_;
  }

 private:
  std::unordered_map<std::uint32_t, int> rows_;
  std::uint32_t last_segment_ = kNoSegment.value;
  int last_row_ = -1;
};

Color ColorAt(const std::vector<Color>& colors, std::size_t i) {
  return colors.empty() ? Color{128, 128, 128} : colors[i];
}

}  // namespace

RangeView::RangeView(const PanopticFrame& frame, const IntegrationConfig& config)
    : config_(config), is_spherical_(frame.lidar.has_value()) {
  if (is_spherical_) camera_ = {.width_px = kScanColumns, .height_px = kScanRows};
  else camera_ = frame.camera->camera;
  const auto num_pixels = static_cast<std::size_t>(camera_.num_pixels());
  range_m_.assign(num_pixels, 0.0f);
  row_.assign(num_pixels, -1);
  color_.resize(num_pixels);
  if (is_spherical_) FillFromScan(frame);
  else FillFromCamera(frame);
}

void RangeView::Put(std::size_t pixel, float range_m, int row, Color color) {
  if (!(range_m >= config_.min_range_m && range_m <= config_.max_range_m)) return;  // false for NaN, too
  range_m_[pixel] = range_m;
  row_[pixel] = row;
  color_[pixel] = color;
}

void RangeView::FillFromCamera(const PanopticFrame& frame) {
  const DepthCameraData& data = *frame.camera;
  RowFinder row_of(frame);
  std::size_t i = 0;
  for (int v = 0; v < camera_.height_px; ++v) {
    const auto y = static_cast<float>((v - camera_.cy_px) / camera_.fy_px);
    for (int u = 0; u < camera_.width_px; ++u, ++i) {
      if (!(data.depth_m[i] > 0)) continue;
      const auto x = static_cast<float>((u - camera_.cx_px) / camera_.fx_px);
      const int row = data.segments.empty() ? -1 : row_of(data.segments[i]);
      Put(i, data.depth_m[i] * std::sqrt(x * x + y * y + 1.0f), row, ColorAt(data.color, i));
    }
  }
}

void RangeView::FillFromScan(const PanopticFrame& frame) {
  const LidarData& scan = *frame.lidar;
  RowFinder row_of(frame);
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    float u, v;
    if (!ProjectToImage(scan.points_m[i], u, v)) continue;
    const auto pixel = static_cast<std::size_t>(std::lround(v)) * kScanColumns +
                       static_cast<std::size_t>(std::lround(u)) % kScanColumns;
    const float range_m = scan.points_m[i].norm();
    if (range_m_[pixel] > 0 && range_m_[pixel] <= range_m) continue;
    Put(pixel, range_m, scan.segments.empty() ? -1 : row_of(scan.segments[i]), ColorAt(scan.color, i));
  }
}

bool RangeView::ProjectToImage(const Eigen::Vector3f& p, float& u, float& v) const {
  if (is_spherical_) {
    u = (std::numbers::pi_v<float> - std::atan2(p.y(), p.x())) / kColumnAngle;  // 0..columns; the seam points backwards
    v = (kScanTop - std::atan2(p.z(), std::hypot(p.x(), p.y()))) / kRowAngle;
    return v >= 0 && v <= kScanRows - 1;
  }
  if (!(p.z() > 0)) return false;
  u = static_cast<float>(camera_.fx_px) * p.x() / p.z() + static_cast<float>(camera_.cx_px);
  v = static_cast<float>(camera_.fy_px) * p.y() / p.z() + static_cast<float>(camera_.cy_px);
  return u >= 0 && v >= 0 && u <= static_cast<float>(camera_.width_px - 1) &&
         v <= static_cast<float>(camera_.height_px - 1);
}

bool RangeView::Read(const Eigen::Vector3f& p_sensor_m, RangeReading& reading) const {
  float u, v;
  if (!ProjectToImage(p_sensor_m, u, v)) return false;
  const int width = camera_.width_px;
  const int u0 = std::min(static_cast<int>(u), width - 1), v0 = static_cast<int>(v);
  const int u1 = u0 + 1 < width ? u0 + 1 : (is_spherical_ ? 0 : u0);
  const int v1 = std::min(v0 + 1, camera_.height_px - 1);
  const float fu = u - static_cast<float>(u0), fv = v - static_cast<float>(v0);
  const std::array<int, 4> pixels = {v0 * width + u0, v0 * width + u1, v1 * width + u0, v1 * width + u1};
  const std::array<float, 4> shares = {(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};

  int nearest = -1;
  float share = -1, mean_m = 0, low_m = range_m_[static_cast<std::size_t>(pixels[0])], high_m = low_m;
  for (std::size_t i = 0; i < 4; ++i) {
    const float range_m = range_m_[static_cast<std::size_t>(pixels[i])];
    low_m = std::min(low_m, range_m);
    high_m = std::max(high_m, range_m);
    mean_m += shares[i] * range_m;
    if (range_m > 0 && shares[i] > share) {
      share = shares[i];
      nearest = pixels[i];
    }
  }
  if (nearest < 0) return false;
  const auto pixel = static_cast<std::size_t>(nearest);
  const bool is_smooth = low_m > 0 && high_m - low_m <= kMaxStep_m;
  reading = {is_smooth ? mean_m : range_m_[pixel], row_[pixel], color_[pixel]};
  return true;
}

float RangeView::RayWeight(float depth_m, float range_m) const {
  switch (config_.weighting) {
    case Weighting::kConstant: return 1.0f;
    case Weighting::kInverseDepthSquared: return 1.0f / (depth_m * depth_m);
    case Weighting::kInverseRangeSquared: return 1.0f / (range_m * range_m);
  }
  return 1.0f;
}

float RangeView::Weight(const Eigen::Vector3f& p, float voxel_size_m) const {
  const float range_m = p.norm();
  if (is_spherical_) {
    const float size = voxel_size_m / range_m;
    return size * size / (kColumnAngle * kRowAngle) * RayWeight(range_m, range_m);  // a scanner has no depth axis
  }
  const float size = voxel_size_m / p.z();
  return static_cast<float>(camera_.fx_px * camera_.fy_px) * size * size * RayWeight(p.z(), range_m);
}

}  // namespace dhpmap::evaluator
