// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/sorted_runs.h"

#include <unordered_map>

namespace dhpmap {

std::vector<RunsOfSegment> SortRunsBySegment(std::span<const SegmentInfo> table, const RunBands& bands,
                                             std::vector<std::uint32_t>& positions,
                                             std::vector<const PointRun*>& sorted) {
  // Positions: 0 for points of no known object, else 1 + row of the table.
  std::unordered_map<std::uint32_t, std::uint32_t> position_of;
  for (std::size_t row = 0; row < table.size(); ++row) {
    position_of[table[row].id.value] = static_cast<std::uint32_t>(row + 1);
  }
  std::size_t num_runs = 0;
  for (const auto& runs : bands) num_runs += runs.size();
  positions.clear();
  positions.reserve(num_runs);
  std::vector<std::size_t> starts(table.size() + 2, 0);
  std::uint32_t last_segment = 0, last_position = 0;
  for (const auto& runs : bands) {
    for (const PointRun& run : runs) {
      if (run.place.segment() != last_segment) {
        const auto it = position_of.find(run.place.segment());
        last_segment = run.place.segment();
        last_position = it == position_of.end() ? 0 : it->second;
      }
      positions.push_back(last_position);
      ++starts[last_position + 1];
    }
  }
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];

  sorted.resize(num_runs);
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  std::size_t i = 0;
  for (const auto& runs : bands) {
    for (const PointRun& run : runs) sorted[next[positions[i++]]++] = &run;
  }

  std::vector<RunsOfSegment> segments;
  for (std::size_t position = 0; position + 1 < starts.size(); ++position) {
    if (starts[position] == starts[position + 1]) continue;
    segments.push_back({static_cast<int>(position) - 1, starts[position], starts[position + 1]});
  }
  return segments;
}

}  // namespace dhpmap
