// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Triangles of the surface of one submap or of a whole map (map_mesh.h), vertices shared between triangles.
/// Coordinates in metres of the map frame. A vertex has the label of the nearer voxel of the edge that it lies on;
/// where submaps meet, that of the submap around it (see OwnerHalo::Labelling).
struct Mesh {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<Eigen::Vector3f> normals;  ///< unit, out of the surface, one a vertex
  std::vector<Color> colors;             ///< one a vertex
  std::vector<std::uint16_t> classes;    ///< one a vertex: the voxel's, see ClassOfVoxel; 0 in the unknown submap
  std::vector<std::uint32_t> instances;  ///< one a vertex: id of the submap that answers for the voxel
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

enum class MeshColoring { kSensor, kClass, kInstance };

/// Marching cubes over all cells whose 8 corners are observed (Lorensen and Cline 1987). Deterministic order. Of one
/// submap alone: cells that it shares with others are left out.
Mesh ExtractMesh(const Submap& submap, const LabelSet& label_set, MeshColoring coloring);

/// The triangles of `part` after those of `whole`.
void AppendMesh(const Mesh& part, Mesh& whole);

/// A well-spread colour for an id, the same in every run.
Color ColorOfId(std::uint32_t id);

}  // namespace dhpmap
