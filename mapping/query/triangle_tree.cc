// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/triangle_tree.h"

#include <Eigen/Geometry>
#include <cmath>

namespace dhpmap {
namespace {

std::vector<Eigen::AlignedBox3f> BoxesOf(const std::vector<TriangleCorners>& triangles) {
  std::vector<Eigen::AlignedBox3f> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) boxes.emplace_back(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
  return boxes;
}

/// A triangle's say on the side of those to whom `point` of it is nearest: its angle there (Baerentzen and Aanaes,
/// Signed distance computation using the angle weighted pseudonormal, 2005).
float AngleAt(const TriangleCorners& triangle, const Eigen::Vector3f& point) {
  constexpr float kHalfTurn = 3.14159265f;  // on an edge, which two triangles share; inside, any will do
  for (std::size_t i = 0; i < 3; ++i) {
    if (point != triangle[i]) continue;
    const Eigen::Vector3f u = triangle[(i + 1) % 3] - point, v = triangle[(i + 2) % 3] - point;
    return std::atan2(u.cross(v).norm(), u.dot(v));
  }
  return kHalfTurn;
}

}  // namespace

/// By the Voronoi regions of corners, edges and face (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3f NearestPointOf(const TriangleCorners& triangle, const Eigen::Vector3f& p) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3f ab = b - a, ac = c - a, ap = p - a;
  const float ab_ap = ab.dot(ap), ac_ap = ac.dot(ap);
  if (ab_ap <= 0 && ac_ap <= 0) return a;
  const Eigen::Vector3f bp = p - b;
  const float ab_bp = ab.dot(bp), ac_bp = ac.dot(bp);
  if (ab_bp >= 0 && ac_bp <= ab_bp) return b;
  const float in_c = ab_ap * ac_bp - ab_bp * ac_ap;
  if (in_c <= 0 && ab_ap >= 0 && ab_bp <= 0) return a + ab_ap / (ab_ap - ab_bp) * ab;
  const Eigen::Vector3f cp = p - c;
  const float ab_cp = ab.dot(cp), ac_cp = ac.dot(cp);
  if (ac_cp >= 0 && ab_cp <= ac_cp) return c;
  const float in_b = ab_cp * ac_ap - ab_ap * ac_cp;
  if (in_b <= 0 && ac_ap >= 0 && ac_cp <= 0) return a + ac_ap / (ac_ap - ac_cp) * ac;
  const float in_a = ab_bp * ac_cp - ab_cp * ac_bp;
  const float to_c = ac_bp - ab_bp, to_b = ab_cp - ac_cp;
  if (in_a <= 0 && to_c >= 0 && to_b >= 0) return b + to_c / (to_c + to_b) * (c - b);
  return a + (in_b * ab + in_c * ac) / (in_a + in_b + in_c);
}

TriangleTree::TriangleTree(std::vector<TriangleCorners> triangles) : tree_(BoxesOf(triangles)) {
  triangles_.reserve(triangles.size());
  for (const std::uint32_t number : tree_.items()) triangles_.push_back(triangles[number]);
}

bool TriangleTree::ImproveNearest(const Eigen::Vector3f& p, NearestSurface& best) const {
  bool has_point = false;
  tree_.VisitNearest(p, best.Limit2(), [&](std::size_t position) {
    const TriangleCorners& triangle = triangles_[position];
    const Eigen::Vector3f point = NearestPointOf(triangle, p);
    const float distance2 = (p - point).squaredNorm();
    if (!(distance2 <= best.Limit2())) return best.Limit2();  // a triangle without an area may give NaN
    const Eigen::Vector3f across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const float length = across.norm();
    const Eigen::Vector3f normal = length > 0 ? Eigen::Vector3f(across / length) : Eigen::Vector3f::Zero();
    const float side = AngleAt(triangle, point) * normal.dot(p - point);
    const bool is_first = best.normal.isZero(0);
    if (is_first || distance2 * (1 + 2e-5f) + 1e-9f < best.distance2_m2) {
      best = {std::min(distance2, best.distance2_m2), side, point, normal};
      has_point = true;
    } else {  // as near
      best.side += side;
      best.distance2_m2 = std::min(best.distance2_m2, distance2);
    }
    return best.Limit2();
  });
  return has_point;
}

std::size_t TriangleTree::MemoryBytes() const {
  return sizeof(*this) + tree_.MemoryBytes() + triangles_.capacity() * sizeof(triangles_[0]);
}

}  // namespace dhpmap
