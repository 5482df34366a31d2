// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "mapping/map/state_marks.h"

namespace dhpmap {

struct LabelCrfReport {
  std::int64_t num_voxels = 0;             ///< that took part
  std::int64_t num_changed_classes = 0;    ///< voxels whose most seen class became another
  std::int64_t num_changed_instances = 0;  ///< voxels that went to another submap
  int num_tiles = 0;                       ///< parts that were solved one by one
};

/// Multi-variable CRF (paper II-E) over the voxels of the submaps `ids`, which label management has made exclusive.
/// A voxel whose class or instance becomes another has the counts of its old and new label exchanged, so all sums of
/// counts are conserved and the new label is its most seen one; it then moves to the submap of its instance. Every
/// other voxel keeps its counts as they are. Does not depend on the number of threads.
/// `refined_before`, if there is one, is what an earlier run left: where no block has been written since, nothing is
/// solved again, so that only what is new costs time, and labels that have settled stay.
LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                            const StateMarks* refined_before = nullptr, const std::function<bool()>& is_cancelled = {});

}  // namespace dhpmap
