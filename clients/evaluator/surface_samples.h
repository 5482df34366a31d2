// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mapping/mesh/mesh.h"

namespace dhpmap::evaluator {

/// Points spread evenly over a surface, each with the label of its place.
struct SurfaceSamples {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<std::uint16_t> classes;    ///< 0 = the surface does not say
  std::vector<std::uint32_t> instances;  ///< 0 = the surface does not say
  std::vector<std::uint32_t> triangles;  ///< of the mesh, that the sample lies on
  [[nodiscard]] std::size_t size() const { return positions_m.size(); }
};

/// One sample for each spacing_m^2 of area, wherever the triangles' edges are, so that every square metre counts the
/// same whatever its direction to the grid (vertices of marching cubes lie denser on slanted surfaces). A sample has
/// the label of the nearest corner of its triangle. Deterministic. `spacing_m` > 0.
SurfaceSamples SampleSurface(const Mesh& mesh, double spacing_m);

}  // namespace dhpmap::evaluator
