// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mapping/mesh/mesh.h"

namespace dhpmap::bench {

// Judges of a surface that share no code with the queries that answer from it.

/// How far measured points are from the nearest triangle of all.
struct PointsToMesh {
  std::vector<double> distances_m;  ///< of the points that have a triangle within reach
  std::size_t num_without = 0;      ///< the others
};
PointsToMesh MeasurePoints(const std::vector<Eigen::Vector3f>& points_m, const Mesh& mesh, double reach_m);

/// What should be flat: the part of the mesh in each cube of `cube_m` whose vertices lie within `flat_m` rms of their
/// plane. How far its triangles are turned out of that plane, and its vertices off it.
struct Roughness {
  std::vector<double> angles_deg, off_plane_m;
  std::size_t num_cubes = 0;
};
Roughness MeasureRoughness(const Mesh& mesh, double cube_m, double flat_m);

}  // namespace dhpmap::bench
