// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// The surface of a submap as spheres, in its own frame: one for the surface in each voxel, and one around all those of
/// a block. The spheres contain the whole surface and extend beyond it by at most half a voxel's diagonal.
struct AttachedShape {
  struct Ball {
    Eigen::Vector3d center_m;
    double radius_m;
  };
  struct Group {
    Ball around;
    std::vector<Ball> balls;
  };
  std::vector<Group> groups;
  double reach_m = 0;  ///< of its points from the origin of the submap's frame
  std::size_t num_balls = 0;
};

/// The shape of a submap of a state, from its own surface without the triangles that also need voxels of other submaps,
/// because a carried object has left those. Stops early, with more than `max_balls` balls, once there are so many.
AttachedShape AttachedShapeOf(const MapSnapshot& state, const Submap& submap, const SubmapSurface& surface,
                              std::size_t max_balls);

/// The shape from all observations of a submap of a state, even if it is absent: free space seen at its old place does
/// not change the object's shape. Empty if there is no such submap.
AttachedShape WholeBodyOf(const MapSurfaces& surfaces, SubmapId id, std::size_t max_balls);

}  // namespace dhpmap
