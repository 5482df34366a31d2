// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dhpmap::evaluator {

inline constexpr int kRetrievalRuns = 5;

/// A synthetic map: so many observed voxels, so many of them of one object.
struct RetrievalScene {
  std::int64_t num_voxels = 0;
  std::int64_t num_object_voxels = 0;
  std::optional<double> paper_ms;  ///< by traversal (its Table IV)
};

struct RetrievalTimes {
  RetrievalScene scene;
  double traversal_s = 0;  ///< all voxels of a flat map looked at, the object's copied out
  double find_s = 0;       ///< the object's submap found by its id, its blocks at hand
  double copy_s = 0;       ///< the same, and all its voxels copied out as for traversal_s
  std::int64_t num_copied = 0;
  std::size_t flat_bytes = 0, map_bytes = 0;
};

/// The paper's scenes: 4 M voxels with a bed, 82 M with the road.
std::vector<RetrievalScene> PaperScenes();

/// Builds the scene as a flat TSDF whose voxels know their instance, and as our map with one submap an object among a
/// hundred others; one at a time in memory (1.3 GB for 82 M voxels, and 0.6 GB for the copy). Blocks of the object lie
/// spread over the flat map, as they do when a sensor passes by. Medians over `num_runs`, in one thread; memory for the
/// copies is there before. Requires 0 < num_object_voxels <= num_voxels.
RetrievalTimes MeasureRetrieval(const RetrievalScene& scene, int num_runs);

/// Of this machine.
std::string ProcessorName();

}  // namespace dhpmap::evaluator
