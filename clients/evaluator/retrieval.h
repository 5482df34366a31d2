// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dhpmap::evaluator {

inline constexpr int kRetrievalRuns = 5;

/// A synthetic map: the number of observed voxels, and how many of them are of one object.
struct RetrievalScene {
  std::int64_t num_voxels = 0;
  std::int64_t num_object_voxels = 0;
  std::optional<double> paper_ms;  ///< by traversal (the paper's Table IV)
};

struct RetrievalTimes {
  RetrievalScene scene;
  double traversal_s = 0;  ///< scan all voxels of a flat map, and copy the object's
  double find_s = 0;       ///< find the object's submap by id, with access to its blocks
  double copy_s = 0;       ///< the same, and copy all its voxels as for traversal_s
  std::int64_t num_copied = 0;
  std::size_t flat_bytes = 0, map_bytes = 0;
};

/// The paper's scenes: 4 M voxels with a bed, 82 M with the road.
std::vector<RetrievalScene> PaperScenes();

/// Builds the scene as a flat TSDF whose voxels know their instance, and as our map with one submap for the object
/// among a hundred others; one at a time in memory (1.3 GB for 82 M voxels, and 0.6 GB for the copy). The object's
/// blocks are spread over the flat map, as after a sensor has passed. Medians over `num_runs`, in one thread; memory
/// for copies is allocated before. Requires 0 < num_object_voxels <= num_voxels.
RetrievalTimes MeasureRetrieval(const RetrievalScene& scene, int num_runs);

/// Name of this machine's processor.
std::string ProcessorName();

}  // namespace dhpmap::evaluator
