// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Triangles of the surface of one submap or of a whole map (map_mesh.h), with shared vertices. Coordinates in metres
/// of the map frame. A vertex has the label of the nearer voxel on its edge; where submaps meet, that of the submap
/// around it (see OwnerHalo::Labelling).
struct Mesh {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<Eigen::Vector3f> normals;  ///< unit, out of the surface, one a vertex
  std::vector<Color> colors;             ///< one a vertex
  std::vector<std::uint16_t> classes;    ///< one a vertex: the voxel's, see ClassOfVoxel; 0 in the unknown submap
  std::vector<std::uint32_t> instances;  ///< one a vertex: id of the submap that answers for the voxel
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

enum class MeshColoring { kSensor, kClass, kInstance };

/// Marching cubes over all cells with 8 observed corners (Lorensen and Cline 1987). Deterministic order. For one submap
/// alone: without cells shared with others.
Mesh ExtractMesh(const Submap& submap, const LabelSet& label_set, MeshColoring coloring);

/// Appends the triangles of `part` to `whole`.
void AppendMesh(const Mesh& part, Mesh& whole);

/// A well-spread colour for an id, the same in every run.
Color ColorOfId(std::uint32_t id);

}  // namespace dhpmap
