// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Triangles of one submap's surface, vertices shared between triangles. Coordinates in metres of the map frame.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<Eigen::Vector3f> normals;  ///< unit, out of the surface, one a vertex
  std::vector<Color> colors;             ///< one a vertex
  std::vector<std::uint16_t> classes;    ///< one a vertex: voxel's most seen class, or the submap's where it has none
  std::vector<std::uint32_t> instances;  ///< one a vertex: the submap's id
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

enum class MeshColoring { kSensor, kClass, kInstance };

/// Marching cubes over all cells whose 8 corners are observed (Lorensen and Cline 1987). Deterministic order.
Mesh ExtractMesh(const Submap& submap, const LabelSet& label_set, MeshColoring coloring);

/// The triangles of `part` after those of `whole`.
void AppendMesh(const Mesh& part, Mesh& whole);

/// A well-spread colour for an id, the same in every run.
Color ColorOfId(std::uint32_t id);

}  // namespace dhpmap
