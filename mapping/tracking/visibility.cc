// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dhpmap {
namespace {

constexpr std::int32_t kNoBeam = -1;

/// Directions are sorted into cells of a cube around the unit sphere, which needs no angles and has no seams or poles.
/// Cells are wider than the widest gap, so everything within a gap is in a cell or its neighbours.
constexpr int kCubeSide = 48;
constexpr float kCellsPerUnit = kCubeSide / 2.0f;
static_assert(1.0 / kCellsPerUnit > FrameSight::kMostBeamGap_rad);

Eigen::Vector3i DirectionCell(const Eigen::Vector3f& direction) {
  return ((direction.array() + 1.0f) * kCellsPerUnit).floor().cast<int>().max(0).min(kCubeSide - 1);
}

std::size_t CellAt(const Eigen::Vector3i& cell) {
  return static_cast<std::size_t>(cell.x()) +
         kCubeSide * (static_cast<std::size_t>(cell.y()) + kCubeSide * static_cast<std::size_t>(cell.z()));
}

}  // namespace

bool MayBeInView(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d p = frame.T_map_sensor.inverse() * sphere.center_m;
  if (p.norm() > max_range_m + sphere.radius_m) return false;
  if (!frame.camera) return true;
  if (p.z() < -sphere.radius_m) return false;
  const PinholeCamera& camera = frame.camera->camera;
  // Inward normals of the four planes through the sensor and the image borders.
  const Eigen::Vector3d borders[] = {
      {camera.fx_px, 0, camera.cx_px},
      {-camera.fx_px, 0, camera.width_px - camera.cx_px},
      {0, camera.fy_px, camera.cy_px},
      {0, -camera.fy_px, camera.height_px - camera.cy_px},
  };
  for (const Eigen::Vector3d& normal : borders) {
    if (p.dot(normal.normalized()) < -sphere.radius_m) return false;
  }
  return true;
}

bool FrameSight::ShouldBeSeen(const BoundingSphere& sphere) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d p = frame_.T_map_sensor.inverse() * sphere.center_m;
  if (p.norm() > max_range_m_) return false;
  return frame_.camera ? IsSeenByCamera(p, sphere.radius_m) : IsMetByBeam(p, sphere.radius_m);
}

bool FrameSight::IsSeenByCamera(const Eigen::Vector3d& p, double radius_m) const {
  const PinholeCamera& camera = frame_.camera->camera;
  if (p.z() <= 0) return false;
  const auto u = static_cast<int>(std::lround(camera.fx_px * p.x() / p.z() + camera.cx_px));
  const auto v = static_cast<int>(std::lround(camera.fy_px * p.y() / p.z() + camera.cy_px));
  if (u < 0 || v < 0 || u >= camera.width_px || v >= camera.height_px) return false;
  const float depth_m = frame_.camera->depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) +
                                               static_cast<std::size_t>(u)];
  return std::isfinite(depth_m) && depth_m > 0 && depth_m >= p.z() - radius_m;
}

void FrameSight::SortBeams() {
  const std::vector<Eigen::Vector3f>& points_m = frame_.lidar->points_m;
  first_.assign(CellAt(Eigen::Vector3i::Constant(kCubeSide - 1)) + 1, kNoBeam);
  next_.assign(points_m.size(), kNoBeam);
  for (std::size_t i = points_m.size(); i-- > 0;) {
    const float range_m = points_m[i].norm();
    if (!(range_m > 0)) continue;
    std::int32_t& first = first_[CellAt(DirectionCell(points_m[i] / range_m))];
    next_[i] = first;
    first = static_cast<std::int32_t>(i);
  }
}

bool FrameSight::IsMetByBeam(const Eigen::Vector3d& p, double radius_m) {
  const double distance_m = p.norm();
  if (!(distance_m > 0)) return false;
  if (first_.empty()) SortBeams();
  const Eigen::Vector3f towards = (p / distance_m).cast<float>();
  const double widest_rad = distance_m > radius_m ? std::asin(radius_m / distance_m) : kMostBeamGap_rad;
  // Squared chords of the unit sphere, because cosines of small angles lose precision.
  float least2 = static_cast<float>(std::pow(2 * std::sin(0.5 * std::min(widest_rad, kMostBeamGap_rad)), 2));
  float range_m = -1;  // of the nearest beam
  const Eigen::Vector3i cell = DirectionCell(towards);
  for (int n = 0; n < 27; ++n) {
    const Eigen::Vector3i at = cell + Eigen::Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    if ((at.array() < 0).any() || (at.array() >= kCubeSide).any()) continue;
    for (std::int32_t i = first_[CellAt(at)]; i != kNoBeam; i = next_[static_cast<std::size_t>(i)]) {
      const Eigen::Vector3f& beam_m = frame_.lidar->points_m[static_cast<std::size_t>(i)];
      const float length_m = beam_m.norm();
      const float off2 = (beam_m / length_m - towards).squaredNorm();
      if (off2 > least2) continue;
      // Of several returns of one beam, use the first: the surface there did not hide the sphere.
      range_m = off2 == least2 && range_m >= 0 ? std::min(range_m, length_m) : length_m;
      least2 = off2;
    }
  }
  return range_m >= 0 && range_m >= distance_m - radius_m;
}

}  // namespace dhpmap
