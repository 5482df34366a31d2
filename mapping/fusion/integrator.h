// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>

#include "mapping/fusion/kept_clear_voxels.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/fusion/voxel_journal.h"
#include "mapping/map/map_config.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Start of a frame's rays, on the grid of a submap.
struct RayOrigin {
  VoxelIndex voxel;            ///< contains the sensor's origin
  Eigen::Vector3f offset_vox;  ///< position of the origin within it, 0..1
  RayOrigin(const Eigen::Vector3d& p_grid_m, double voxel_size_m);
};

/// Traces the bundles of one segment through the band of +-truncation around their end points (paper II-C). Updates the
/// TSDF of the submap and, if `label` is given, its labels: one observation of that class for each ray and voxel.
/// - The distance of a voxel is that to the bundle's plane (FitTangentPlanes). Voxels with their centre beyond the end
///   of the band are not changed.
/// - Grazing rays are extended as far as the plane has other points, so that the cells around it are complete. If a ray
///   does not reach the other side of the plane, the voxels around its end are updated as well (GrazedColumns).
/// - Labels are written only within +-truncation along the ray in the object's own space, and in the first voxel of it.
/// - A voxel with a gone count (GoneBlock) has it reset to 0; if it was contradicted, its TSDF starts anew.
/// - Voxels of `kept_clear`, which may be null, are not written.
/// - With a `journal`, blocks that only a Map::ForkInPlace shares are written in place, and noted.
///
/// Bundles must be on the submap's grid. Writes only to `submap`, so segments of different submaps may run in parallel,
/// those of one submap in turn. Returns the number of voxel updates. Throws Stopped soon after a `stop` request, with
/// part of the work done, and std::bad_alloc for a segment that was cut short.
std::int64_t IntegrateSegment(const SegmentBundles& segment, const RayOrigin& origin, std::optional<ClassId> label,
                              const IntegrationConfig& config, Submap& submap, const std::stop_token& stop = {},
                              KeptClearVoxels* kept_clear = nullptr, VoxelJournal* journal = nullptr);

}  // namespace dhpmap
