// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

// Slow and obvious: the distance of points to all triangles of a mesh, one after the other.

namespace dhpmap::testing {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Of a PLY file as GetSubmapMesh sends it.
inline std::vector<Triangle> TrianglesOf(const std::string& ply) {
  constexpr std::size_t kVertexBytes = 6 * 4 + 3 + 2 + 4, kFaceBytes = 1 + 3 * 4;
  const auto count = [&ply](const std::string& element) {
    return std::stoul(ply.substr(ply.find("element " + element + " ") + 9 + element.size()));
  };
  const std::size_t num_vertices = count("vertex"), num_faces = count("face");
  const char* vertices = ply.data() + ply.find("end_header\n") + 11;
  const char* faces = vertices + num_vertices * kVertexBytes;
  std::vector<Triangle> triangles(num_faces);
  for (std::size_t i = 0; i < num_faces; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::int32_t index = 0;
      std::memcpy(&index, faces + i * kFaceBytes + 1 + 4 * corner, sizeof index);
      std::array<float, 3> at{};
      std::memcpy(at.data(), vertices + static_cast<std::size_t>(index) * kVertexBytes, sizeof at);
      triangles[i][corner] = {at[0], at[1], at[2]};
    }
  }
  return triangles;
}

inline double DistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (p - a - t * along).norm();
}

/// To the plane where the foot of the perpendicular lies inside, else to the nearest side.
inline double DistanceToTriangle(const Eigen::Vector3d& p, const Triangle& t) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool is_inside = normal.squaredNorm() > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = t[i], &b = t[(i + 1) % 3];
    is_inside = is_inside && (b - a).cross(p - a).dot(normal) >= 0;
    nearest = std::min(nearest, DistanceToSegment(p, a, b));
  }
  return is_inside ? std::abs((p - t[0]).dot(normal)) / normal.norm() : nearest;
}

/// Farther than reach_m: reach_m.
inline double DistanceToMesh(const Eigen::Vector3d& p, const std::vector<Triangle>& triangles, double reach_m) {
  double nearest_m = reach_m;
  for (const Triangle& t : triangles) {
    const double most_m = nearest_m + std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
    if ((p - t[0]).squaredNorm() > most_m * most_m) continue;  // no point of it can be nearer
    nearest_m = std::min(nearest_m, DistanceToTriangle(p, t));
  }
  return nearest_m;
}

}  // namespace dhpmap::testing
