// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/distance_grid.h"

#include <algorithm>
#include <cmath>

namespace dhpmap::simulator {

DistanceGrid::DistanceGrid(std::span<const Solid> solids) {
  Eigen::AlignedBox3d bounds;
  for (const Solid& solid : solids) bounds.extend(solid.Bounds());
  if (bounds.isEmpty()) return;
  origin_m_ = bounds.min().cast<float>();
  cells_ = (bounds.sizes() / kCell_m).array().ceil().cast<int>() + 1;
  distance_m_.assign(static_cast<std::size_t>(cells_.prod()), kReach_m);
  for (const Solid& solid : solids) Draw(solid);
}

void DistanceGrid::Draw(const Solid& solid) {
  const Eigen::AlignedBox3d box = solid.Bounds();
  const Eigen::Array3d from = (box.min().array() - kReach_m - origin_m_.cast<double>().array()) / kCell_m;
  const Eigen::Array3d to = (box.max().array() + kReach_m - origin_m_.cast<double>().array()) / kCell_m;
  const Eigen::Array3i first = from.ceil().cast<int>().max(0);
  const Eigen::Array3i last = to.floor().cast<int>().min(cells_.array() - 1);
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        const Eigen::Vector3f p = origin_m_ + kCell_m * Eigen::Vector3i(x, y, z).cast<float>();
        float& cell = distance_m_[Index(x, y, z)];
        cell = std::min(cell, static_cast<float>(solid.Distance(p.cast<double>())));
      }
    }
  }
}

float DistanceGrid::At(const Eigen::Vector3f& p_map) const {
  const Eigen::Vector3f at = (p_map - origin_m_) / kCell_m;
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y())),
            z = static_cast<int>(std::floor(at.z()));
  if (x < 0 || y < 0 || z < 0 || x + 1 >= cells_.x() || y + 1 >= cells_.y() || z + 1 >= cells_.z()) return kReach_m;
  const float fx = at.x() - static_cast<float>(x), fy = at.y() - static_cast<float>(y),
              fz = at.z() - static_cast<float>(z);
  const auto row = static_cast<std::size_t>(cells_.x());
  const float* cell = &distance_m_[Index(x, y, z)];
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const auto plane = [&](const float* c) { return mix(mix(c[0], c[1], fx), mix(c[row], c[row + 1], fx), fy); };
  return mix(plane(cell), plane(cell + row * static_cast<std::size_t>(cells_.y())), fz);
}

}  // namespace dhpmap::simulator
