// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

// The shape of one submap in the query's frame; computes its surface if necessary.

/// Axis-aligned box around the surface in the query's frame. Empty if there is none.
Eigen::AlignedBox3d SurfaceBox(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map);

/// Centres of triangles of the surface, in the query's frame: all, or an even selection of at most `most`. Triangles of
/// marching cubes are smaller than a voxel.
std::vector<Eigen::Vector3d> SurfacePoints(const MapSurfaces& surfaces, std::size_t number,
                                           const Transform& T_query_map, std::size_t most);

/// Whether any part of the surface is in a box of the query's frame.
bool SurfaceIsIn(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map,
                 const Eigen::AlignedBox3d& box);

}  // namespace dhpmap
