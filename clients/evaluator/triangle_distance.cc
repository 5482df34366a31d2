// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/triangle_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

namespace dhpmap::evaluator {
namespace {

float DistanceToSegment(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f ab = b - a;
  const float length2 = ab.squaredNorm();
  const float t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0f, 1.0f) : 0.0f;
  return (p - (a + t * ab)).norm();
}

}  // namespace

float DistanceToTriangle(const Eigen::Vector3f& p_m, const Eigen::Vector3f& a_m, const Eigen::Vector3f& b_m,
                         const Eigen::Vector3f& c_m) {
  const Eigen::Vector3f normal = (b_m - a_m).cross(c_m - a_m);
  const float length = normal.norm();
  // The projection onto the plane is inside if it is on the inner side of all three edges.
  const auto is_inside = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    return normal.dot((to - from).cross(p_m - from)) >= 0;
  };
  if (length > 0 && is_inside(a_m, b_m) && is_inside(b_m, c_m) && is_inside(c_m, a_m)) {
    return std::abs((p_m - a_m).dot(normal)) / length;
  }
  return std::min(
      {DistanceToSegment(p_m, a_m, b_m), DistanceToSegment(p_m, b_m, c_m), DistanceToSegment(p_m, c_m, a_m)});
}

void MeasureToTriangles(const std::vector<Eigen::Vector3f>& queries_m, const Mesh& mesh, const SurfaceSamples& samples,
                        std::span<Neighbour> neighbours) {
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    Neighbour& n = neighbours[i];
    if (!n.exists()) continue;
    const auto& [a, b, c] = mesh.triangles[samples.triangles[n.index]];
    const float distance_m =
        DistanceToTriangle(queries_m[i], mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]);
    n.distance_m = std::min(n.distance_m, distance_m);
  }
}

}  // namespace dhpmap::evaluator
