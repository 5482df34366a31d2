// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/fusion/point_runs.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The range of the sorted runs that belongs to one segment.
struct RunsOfSegment {
  int row;  ///< of the table, or -1 for no known object
  std::size_t begin, end;
};

/// Sorts the runs by segment, otherwise in their order; the runs stay in place in `bands`. Returns the segments with
/// runs: first that of unknown objects, then by row. `positions` is scratch memory.
std::vector<RunsOfSegment> SortRunsBySegment(std::span<const SegmentInfo> table, const RunBands& bands,
                                             std::vector<std::uint32_t>& positions,
                                             std::vector<const PointRun*>& sorted);

}  // namespace dhpmap
