// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "mapping/base/status.h"

namespace dhpmap::bench {

struct FusionBenchOptions {
  std::string directory;
  std::string labels = "one";  ///< "one": a single background segment a frame; or predicted, groundtruth
  double voxel_size_m = 0.04;
  double truncation_m = 0.08;
  double max_range_m = 5.0;
  int num_threads = 1;
  std::size_t num_frames = 0;
  int repetitions = 3;
  bool carving = false;
};
/// Time of fusing a frame by stage, and the size of the map.
Status RunFusionBench(const FusionBenchOptions& options);

struct GeometryCheckOptions {
  std::string directory;
  int hold_out_every = 10;
  int pixel_step = 7;
  double voxel_size_m = 0.04;
  double truncation_m = 0.08;
};
/// Maps all frames but every n-th, then compares the surface along the rays of the frames held out with their depth.
Status RunGeometryCheck(const GeometryCheckOptions& options);

}  // namespace dhpmap::bench
