// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "mapping/base/transform.h"
#include "mapping/submap/kept_outline.h"
#include "mapping/submap/outline.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// What of a surface counts, chosen on simulated walks (`dhpmap-bench boxes`): depth is noisy, and worst where it
/// jumps.
struct OutlineRules {
  double least_weight = 0.05;  ///< of the median over the surface: less is left out, few frames have seen it
  double stray_share = 0.002;  ///< of the surface, so much may reach out of a side of the box
  double disc_vox = 0.5;       ///< radius of the piece of surface around each crossing
  double layer_share = 0.1;    ///< of what lies within a voxel of a side, so much may be outside
};

/// The turn of a submap's frame that brings the map's vertical to its z: none if it is there.
Eigen::Matrix3d LevellingOf(const Transform& T_map_submap);

/// The outline of a submap's surface (FindSurfaceCrossings) in its frame turned so. Nothing if it has no surface. Looks
/// at all its blocks: a millisecond for an object of an apartment. Throws StatusError if some cannot be read.
std::optional<SubmapOutline> FindOutline(const Submap& submap, const Eigen::Matrix3d& R_level_submap,
                                         const OutlineRules& rules = {});

/// An outline in another frame whose z is up: T keeps the vertical.
SubmapOutline Moved(const SubmapOutline& outline, const Transform& T_there_here);

/// In the map frame.
std::optional<SubmapOutline> OutlineInMap(const Submap& submap, const OutlineRules& rules = {});
/// The same as if it were at another pose.
std::optional<SubmapOutline> OutlineAt(const Transform& T_map_submap, const Submap& submap,
                                       const OutlineRules& rules = {});

/// The outline levelled for the pose that the submap has: as it is kept with the submap, else found and kept. Throws as
/// FindOutline.
std::shared_ptr<const LevelOutline> FindLevelOutline(const Submap& submap);

/// The box along the axes around an outline.
Eigen::AlignedBox3d BoxAround(const SubmapOutline& outline);

}  // namespace dhpmap
