// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/fusion/point_runs.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Which of the sorted runs are a segment's.
struct RunsOfSegment {
  int row;  ///< of the table, or -1: of no known object
  std::size_t begin, end;
};

/// The runs of each segment together, otherwise in their order; they stay where they are in `bands`. Gives the segments
/// that have any: first that of unknown objects, then by row. `positions`: to work with.
std::vector<RunsOfSegment> SortRunsBySegment(std::span<const SegmentInfo> table, const RunBands& bands,
                                             std::vector<std::uint32_t>& positions,
                                             std::vector<const PointRun*>& sorted);

}  // namespace dhpmap
