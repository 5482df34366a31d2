// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

// The shape of one submap in the frame of whoever asks: its surface, which is made if it is not there.

/// Around the surface, along the axes of the asker's frame. Empty if there is none.
Eigen::AlignedBox3d SurfaceBox(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map);

/// Centres of triangles of the surface, in the asker's frame: all, or evenly chosen so that there are no more than
/// `most`. Marching cubes makes them smaller than a voxel.
std::vector<Eigen::Vector3d> SurfacePoints(const MapSurfaces& surfaces, std::size_t number,
                                           const Transform& T_query_map, std::size_t most);

/// Whether any part of the surface is in a box of the asker's frame.
bool SurfaceIsIn(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map,
                 const Eigen::AlignedBox3d& box);

}  // namespace dhpmap
