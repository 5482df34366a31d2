// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/mesh_judge.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "clients/evaluator/triangle_distance.h"
#include "mapping/base/grid.h"

namespace dhpmap::bench {
namespace {

using Cubes = std::unordered_map<BlockIndex, std::vector<std::uint32_t>, BlockIndexHash>;  // triangles

BlockIndex CubeAt(const Eigen::Vector3f& p_m, double side_m) {
  const VoxelIndex v = VoxelAt(p_m.cast<double>(), side_m);
  return {v.x, v.y, v.z};
}

/// Each triangle in every cube that its box touches.
Cubes SortByBox(const Mesh& mesh, double side_m) {
  Cubes cubes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3f &p = mesh.vertices_m[a], &q = mesh.vertices_m[b], &r = mesh.vertices_m[c];
    const BlockIndex low = CubeAt(p.cwiseMin(q).cwiseMin(r), side_m), high = CubeAt(p.cwiseMax(q).cwiseMax(r), side_m);
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) cubes[{x, y, z}].push_back(t);
      }
    }
  }
  return cubes;
}

void AddPatch(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, double flat_m, Roughness& roughness) {
  constexpr std::size_t kLeastTriangles = 100;  // fewer are a corner of something
  if (triangles.size() < kLeastTriangles) return;
  std::vector<Eigen::Vector3d> points;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t v : mesh.triangles[t]) points.emplace_back(mesh.vertices_m[v].cast<double>());
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter / static_cast<double>(points.size()));
  if (std::sqrt(std::max(0.0, axes.eigenvalues()[0])) > flat_m) return;
  const Eigen::Vector3d normal = axes.eigenvectors().col(0);
  ++roughness.num_cubes;
  for (const Eigen::Vector3d& p : points) roughness.off_plane_m.push_back(std::abs(normal.dot(p - mean)));
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d ab = (mesh.vertices_m[b] - mesh.vertices_m[a]).cast<double>();
    const Eigen::Vector3d across = ab.cross((mesh.vertices_m[c] - mesh.vertices_m[a]).cast<double>());
    if (across.norm() == 0) continue;
    const double cosine = std::min(1.0, std::abs(across.dot(normal)) / across.norm());
    roughness.angles_deg.push_back(std::acos(cosine) * 180 / std::numbers::pi);
  }
}

}  // namespace

PointsToMesh MeasurePoints(const std::vector<Eigen::Vector3f>& points_m, const Mesh& mesh, double reach_m) {
  const Cubes cubes = SortByBox(mesh, reach_m);
  PointsToMesh result;
  for (const Eigen::Vector3f& p_m : points_m) {
    const BlockIndex centre = CubeAt(p_m, reach_m);
    float nearest_m = std::numeric_limits<float>::infinity();
    for (int n = 0; n < 27; ++n) {
      const auto it = cubes.find({centre.x + n % 3 - 1, centre.y + n / 3 % 3 - 1, centre.z + n / 9 - 1});
      if (it == cubes.end()) continue;
      for (const std::uint32_t t : it->second) {
        const auto& [a, b, c] = mesh.triangles[t];
        nearest_m = std::min(
            nearest_m, evaluator::DistanceToTriangle(p_m, mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]));
      }
    }
    if (nearest_m <= static_cast<float>(reach_m)) {
      result.distances_m.push_back(nearest_m);
    } else {
      ++result.num_without;
    }
  }
  return result;
}

Roughness MeasureRoughness(const Mesh& mesh, double cube_m, double flat_m) {
  Cubes cubes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3f centre_m = (mesh.vertices_m[a] + mesh.vertices_m[b] + mesh.vertices_m[c]) / 3;
    cubes[CubeAt(centre_m, cube_m)].push_back(t);
  }
  Roughness roughness;
  for (const auto& [cube, triangles] : cubes) AddPatch(mesh, triangles, flat_m, roughness);
  return roughness;
}

}  // namespace dhpmap::bench
