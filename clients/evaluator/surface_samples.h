// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mapping/mesh/mesh.h"

namespace dhpmap::evaluator {

/// Points spread evenly over a surface, with labels.
struct SurfaceSamples {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<std::uint16_t> classes;    ///< 0: no label
  std::vector<std::uint32_t> instances;  ///< 0: no label
  std::vector<std::uint32_t> triangles;  ///< triangle of the mesh that contains the sample
  [[nodiscard]] std::size_t size() const { return positions_m.size(); }
};

/// One sample for each spacing_m^2 of area, independent of triangle edges, so that equal areas count alike in every
/// direction (vertices of marching cubes are denser on slanted surfaces). A sample has the label of the nearest corner
/// of its triangle. Deterministic. `spacing_m` > 0.
SurfaceSamples SampleSurface(const Mesh& mesh, double spacing_m);

}  // namespace dhpmap::evaluator
