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
  std::int64_t num_changed_classes = 0;    ///< voxels that went to a submap of another class
  std::int64_t num_changed_instances = 0;  ///< voxels that went to another submap
  int num_tiles = 0;                       ///< parts that were solved one by one
};

/// CRF (paper II-E) over the labelled voxels of the submaps `ids`, which label management has made exclusive: which
/// submap each belongs to, and with it its class. It goes by what voxels have seen, and changes nothing of that: one
/// that belongs elsewhere moves there with all its counts, and is marked where that is against what it has seen most
/// (LabelBlock::IsConcluded). What an earlier run has concluded has no say. Does not depend on the number of threads.
/// `refined_before`, if there is one, is what an earlier run left: where no block has been written since, nothing is
/// solved again, so that only what is new costs time, and labels that have settled stay.
LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                            const StateMarks* refined_before = nullptr, const std::function<bool()>& is_cancelled = {});

}  // namespace dhpmap
