// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/beam_grid.h"

#include <algorithm>
#include <array>

namespace dhpmap::simulator {
namespace {

/// The pyramid from the eye through a rectangle of the image, with inward normals.
BoundingTree::Pyramid PyramidThrough(const PinholeCamera& camera, const Transform& T_map_camera, double u0_px,
                                     double v0_px, double u1_px, double v1_px) {
  const auto corner = [&](double u, double v) -> Eigen::Vector3d {
    return T_map_camera.linear() *
           Eigen::Vector3d((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
  };
  const std::array<Eigen::Vector3d, 4> corners{corner(u0_px, v0_px), corner(u1_px, v0_px), corner(u1_px, v1_px),
                                               corner(u0_px, v1_px)};
  BoundingTree::Pyramid pyramid;
  pyramid.apex_m << T_map_camera.translation().cast<float>().array(), 0.0f;
  for (std::size_t i = 0; i < 4; ++i) {
    pyramid.inward[i] << corners[i].cross(corners[(i + 1) % 4]).normalized().cast<float>().array(), 0.0f;
  }
  return pyramid;
}

}  // namespace

BeamGrid::BeamGrid(const BoundingTree& tree, const PinholeCamera& camera, const Transform& T_map_camera)
    : num_columns_((camera.width_px + kTile_px - 1) / kTile_px) {
  constexpr double kMargin_px = 0.52;  // from pixel centres to borders, and rounding
  const int num_rows = (camera.height_px + kTile_px - 1) / kTile_px;
  for (int row = 0; row < num_rows; ++row) {
    for (int column = 0; column < num_columns_; ++column) {
      const double u = column * kTile_px, v = row * kTile_px;
      first_.push_back(static_cast<std::uint32_t>(candidates_.size()));
      tree.Gather(PyramidThrough(camera, T_map_camera, u - kMargin_px, v - kMargin_px, u + kTile_px - 1 + kMargin_px,
                                 v + kTile_px - 1 + kMargin_px),
                  candidates_);
      std::sort(candidates_.begin() + first_.back(), candidates_.end(),
                [](const auto& a, const auto& b) { return a.nearest_m < b.nearest_m; });
    }
  }
  first_.push_back(static_cast<std::uint32_t>(candidates_.size()));
}

BoundingTree::Hit BeamGrid::Cast(int u_px, int v_px, const Ray& ray) const {
  const auto tile = static_cast<std::size_t>(v_px / kTile_px * num_columns_ + u_px / kTile_px);
  const FastRay fast(ray);
  BoundingTree::Hit best{kFar_m, nullptr};
  for (std::uint32_t i = first_[tile]; i < first_[tile + 1]; ++i) {
    const BoundingTree::Candidate& candidate = candidates_[i];
    const auto limit = static_cast<float>(best.distance_m);
    if (candidate.nearest_m > limit) break;
    if (fast.Enter(candidate.bounds, limit) > limit) continue;
    const std::optional<double> t = candidate.solid->Intersect(ray, best.distance_m);
    if (t && *t < best.distance_m) best = {*t, candidate.solid};
  }
  return best;
}

}  // namespace dhpmap::simulator
