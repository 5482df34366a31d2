// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/evidence/label_management.h"
#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"
#include "mapping/refinement/label_crf.h"

namespace dhpmap {

struct RefinementReport {
  ManagementReport management;
  LabelCrfReport crf;
  std::int64_t num_stray_voxels = 0;     ///< see AbsorbStrayVoxels
  double management_s = 0, crf_s = 0;    ///< wall time
  std::int64_t num_bytes_dropped = 0;    ///< by drop_voxel_labels
  std::int64_t num_deferred_blocks = 0;  ///< refined on the side, but written meanwhile: left for the next time

  RefinementReport& operator+=(const RefinementReport& other);
};

/// Settled things, all background classes and the unknown submap are refined together (paper II-D). What is absent or
/// locked is not, and a voxel that is contradicted (GoneBlock) stays as it is.
bool IsSettled(const SubmapInfo& info);
/// Whether refinement may read and write its voxels: it is settled and shares the map's grid (IsExclusive).
bool IsRefined(const SubmapInfo& info, const MapConfig& config);
/// Those that share the map's grid and those that do not.
std::vector<SubmapId> SettledSubmaps(const Map& map);

/// Label management, the CRF and the return of stray voxels (AbsorbStrayVoxels) on the settled submaps, each part if
/// its switch in the map's config is on (paper II-D and II-E). Does not depend on the number of threads.
/// `is_cancelled`, if set, is asked now and then; once it says true, the map is left half refined and must be thrown
/// away. With `region`, only its cubes: all regions of a map one after the other, in any order, make of it what one
/// call without a region makes.
RefinementReport RefineMap(Map& map, ThreadPool& pool, const RefinementRegion* region = nullptr,
                           const std::function<bool()>& is_cancelled = {});

/// RefineMap in two: all but stray voxels, which only whole things can tell, and these.
RefinementReport RefineRegion(Map& map, ThreadPool& pool, const RefinementRegion* region,
                              const std::function<bool()>& is_cancelled = {});
RefinementReport RefineStrayVoxels(Map& map, ThreadPool& pool);

/// Drops the labels of voxels of all labelled submaps that are not locked and share the map's grid (paper II-D):
/// afterwards a voxel has the label of its submap. Returns the bytes saved. Call it where positions are exclusive.
std::int64_t DropVoxelLabels(Map& map);

}  // namespace dhpmap
