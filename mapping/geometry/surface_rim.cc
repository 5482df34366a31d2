// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/surface_rim.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

namespace dhpmap {
namespace {

bool HasCorner(const TriangleCorners& triangle, const Eigen::Vector3f& corner, float same_m) {
  return std::any_of(triangle.begin(), triangle.end(),
                     [&](const Eigen::Vector3f& other) { return (other - corner).squaredNorm() <= same_m * same_m; });
}

/// Whether another triangle has the edge from `a` to `b`.
bool IsShared(std::span<const TriangleCorners> triangles, std::size_t own, const Eigen::Vector3f& a,
              const Eigen::Vector3f& b, float same_m) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i != own && HasCorner(triangles[i], a, same_m) && HasCorner(triangles[i], b, same_m)) return true;
  }
  return false;
}

float SquaredDistanceToEdge(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f along = b - a;
  const float length2 = along.squaredNorm();
  const float share = length2 > 0 ? std::clamp(-a.dot(along) / length2, 0.0f, 1.0f) : 0.0f;
  return (a + share * along).squaredNorm();
}

}  // namespace

bool EndsAtOrigin(std::span<const TriangleCorners> triangles, float same_m) {
  const TriangleCorners& first = triangles[0];
  if (HasCorner(first, Eigen::Vector3f::Zero(), same_m)) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (!HasCorner(triangles[i], Eigen::Vector3f::Zero(), same_m)) continue;
      for (const Eigen::Vector3f& end : triangles[i]) {
        if (end.norm() <= same_m) continue;
        if (!IsShared(triangles, i, Eigen::Vector3f::Zero(), end, same_m)) return true;
      }
    }
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3f &a = first[i], &b = first[(i + 1) % 3];
    if (SquaredDistanceToEdge(a, b) <= same_m * same_m) return !IsShared(triangles, 0, a, b, same_m);
  }
  return false;
}

}  // namespace dhpmap
