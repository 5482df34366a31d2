// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "mapping/fusion/kept_clear_voxels.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map_config.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Where the rays of a frame start, on the grid of a submap.
struct RayOrigin {
  VoxelIndex voxel;            ///< that holds the sensor's origin
  Eigen::Vector3f offset_vox;  ///< of the origin within it, 0..1
  RayOrigin(const Eigen::Vector3d& p_grid_m, double voxel_size_m);
};

/// Traces the bundles of one segment through the band of +-truncation around their end points (paper II-C) and updates
/// the TSDF and, by `votes` (what a sighting counts at a voxel, in classes and in instances; empty: nothing), the
/// labels of the submap. A voxel's distance is that to the bundle's plane (see FitTangentPlanes); one whose centre lies
/// beyond the end of the band is left as it is. Rays that graze it are walked on, as far as there are others in the
/// plane, so that the cells around it are complete, and where they do not come to its other side so are the voxels
/// about their ends (GrazedColumns); labels are only written within +-truncation along the ray, where it is the
/// object's own space, and in the voxel in which that begins. A voxel that was looked through (GoneBlock) begins at 0
/// again, and where it was contradicted so does its TSDF. Bundles must be on the submap's grid. Writes to `submap`
/// alone, so segments of different submaps may run at once; those of one submap one after the other. Nothing is written
/// to voxels of `kept_clear`, which may be null. Returns the number of voxel updates. Throws Stopped soon after `stop`
/// is requested, with a part done, and std::bad_alloc for a segment that was cut short.
std::int64_t IntegrateSegment(const SegmentBundles& segment, const RayOrigin& origin, const LabelHistograms& votes,
                              const IntegrationConfig& config, Submap& submap, const std::stop_token& stop = {},
                              KeptClearVoxels* kept_clear = nullptr);

/// Moves voxels of `submap` that the rays of a whole frame pass through, more than the truncation and a voxel before
/// their ends, towards free space. Only voxels that there are; labels stay, and so do voxels of `kept_clear`, which may
/// be null. Bundles must be on the submap's grid. Stops as IntegrateSegment does.
std::int64_t CarveFreeSpace(std::span<const SegmentBundles> segments, const RayOrigin& origin,
                            const IntegrationConfig& config, Submap& submap, const std::stop_token& stop = {},
                            KeptClearVoxels* kept_clear = nullptr);

}  // namespace dhpmap
