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

/// Robust outline of a surface, tuned on simulated walks (`dhpmap-bench boxes`): depth is noisy, most of all at jumps.
struct OutlineRules {
  double least_weight = 0.05;  ///< share of the median weight over the surface; voxels below it are left out, as few
                               ///< frames have seen them
  double stray_share = 0.002;  ///< share of the surface that may stick out of a side of the box
  double disc_vox = 0.5;       ///< radius of the piece of surface around each crossing
  double layer_share = 0.1;    ///< share of the surface within a voxel of a side that may lie outside
};

/// The rotation of a submap's frame that aligns the map's vertical with its z axis.
Eigen::Matrix3d LevellingOf(const Transform& T_map_submap);

/// The outline of a submap's surface (FindSurfaceCrossings), in its levelled frame. Nothing if it has no surface.
/// Visits all its blocks: about a millisecond for an object of an apartment. Throws StatusError if a block cannot be
/// read.
std::optional<SubmapOutline> FindOutline(const Submap& submap, const Eigen::Matrix3d& R_level_submap,
                                         const OutlineRules& rules = {});

/// An outline in another frame with z up: T preserves the vertical.
SubmapOutline Moved(const SubmapOutline& outline, const Transform& T_there_here);

/// In the map frame.
std::optional<SubmapOutline> OutlineInMap(const Submap& submap, const OutlineRules& rules = {});
/// The same for another pose.
std::optional<SubmapOutline> OutlineAt(const Transform& T_map_submap, const Submap& submap,
                                       const OutlineRules& rules = {});

/// The outline levelled for the submap's pose, from its cache or computed and cached. Throws as FindOutline.
std::shared_ptr<const LevelOutline> FindLevelOutline(const Submap& submap);

/// The axis-aligned box around an outline.
Eigen::AlignedBox3d BoxAround(const SubmapOutline& outline);

}  // namespace dhpmap
