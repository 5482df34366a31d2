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
  std::int64_t num_stray_voxels = 0;   ///< see AbsorbStrayVoxels
  double management_s = 0, crf_s = 0;  ///< wall time
  std::int64_t num_bytes_dropped = 0;  ///< by drop_voxel_labels
  std::int64_t num_deferred_blocks =
      0;  ///< refined in the background but written meanwhile: left for the next refinement

  RefinementReport& operator+=(const RefinementReport& other);
};

/// Inactive things, all background classes and the unknown submap are refined together (paper II-D), except absent and
/// locked ones. Contradicted voxels (GoneBlock) do not change.
bool IsSettled(const SubmapInfo& info);
/// Whether refinement may read and write its voxels: IsSettled, and on the map's grid (IsExclusive).
bool IsRefined(const SubmapInfo& info, const MapConfig& config);
/// All submaps that are IsSettled, on the map's grid or not.
std::vector<SubmapId> SettledSubmaps(const Map& map);

/// Label management, the CRF and the absorption of stray voxels (AbsorbStrayVoxels) on the inactive submaps (paper II-D
/// and II-E); the map's config enables each part. Independent of the number of threads. `is_cancelled`, if set, is
/// polled; once it returns true, the map is left half refined and must be discarded. With `region`, only its cubes are
/// refined: all regions in any order give the same map as one call without a region.
RefinementReport RefineMap(Map& map, ThreadPool& pool, const RefinementRegion* region = nullptr,
                           const std::function<bool()>& is_cancelled = {});

/// RefineMap in two steps: all except stray voxels, which need whole things; then stray voxels.
RefinementReport RefineRegion(Map& map, ThreadPool& pool, const RefinementRegion* region,
                              const std::function<bool()>& is_cancelled = {});
RefinementReport RefineStrayVoxels(Map& map, ThreadPool& pool);

/// Drops the voxel labels of all submaps that are not locked and on the map's grid (paper II-D): a voxel then has the
/// label of its submap. Returns the bytes saved. Requires exclusive positions.
std::int64_t DropVoxelLabels(Map& map);

}  // namespace dhpmap
