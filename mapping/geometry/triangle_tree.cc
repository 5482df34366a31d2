// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/triangle_tree.h"

#include <Eigen/Geometry>

namespace dhpmap {
namespace {

std::vector<Eigen::AlignedBox3f> BoxesOf(const std::vector<TriangleCorners>& triangles) {
  std::vector<Eigen::AlignedBox3f> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) boxes.emplace_back(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
  return boxes;
}

}  // namespace

/// By Voronoi regions of corners, edges and face (Ericson, Real-Time Collision Detection, 5.1.5).
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

TriangleTree::TriangleTree(TileSurface surface)
    : tree_(BoxesOf(surface.triangles), TrianglePacket::kLanes),
      packets_((surface.triangles.size() + TrianglePacket::kLanes - 1) / TrianglePacket::kLanes),
      needed_(std::move(surface.needed)) {
  needs_.reserve(surface.needs.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const std::uint32_t item = tree_.items()[i];
    packets_[i / TrianglePacket::kLanes].Set(i % TrianglePacket::kLanes, surface.triangles[item]);
    if (!surface.needs.empty()) needs_.push_back(surface.needs[item]);
  }
}

std::size_t TriangleTree::MemoryBytes() const {
  std::size_t bytes = sizeof(*this) + tree_.MemoryBytes() + packets_.capacity() * sizeof(packets_[0]) +
                      needs_.capacity() * sizeof(needs_[0]) + needed_.capacity() * sizeof(needed_[0]);
  for (const std::vector<SubmapId>& ids : needed_) bytes += ids.capacity() * sizeof(SubmapId);
  return bytes;
}

}  // namespace dhpmap
