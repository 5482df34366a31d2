// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// The surface of a submap as spheres, in its own frame: one around what lies in each voxel, so that they hold all of
/// the surface and stick out by at most half a voxel's diagonal; and one around all those of a block.
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

/// Of a submap of a state, and of its surface as it is, but for what only is one together with others: what a robot
/// carries has left them. Ends early, with more than `max_balls`, once there are so many.
AttachedShape AttachedShapeOf(const MapSnapshot& state, const Submap& submap, const SubmapSurface& surface,
                              std::size_t max_balls);

/// Of all that was ever observed of a submap of a state, be it absent: what sensors look through where it was taken
/// from says nothing of what it is. Nothing, if there is no such submap.
AttachedShape WholeBodyOf(const MapSurfaces& surfaces, SubmapId id, std::size_t max_balls);

}  // namespace dhpmap
