// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "mapping/pipeline/map_builder.h"
#include "tests/bench/frames.h"

namespace dhpmap::bench {

/// A map as it was made, refined at the end, and what it was made from.
struct Recording {
  LoadedFrames loaded;
  MapInfo info;
  std::unique_ptr<MapBuilder> builder;
  [[nodiscard]] double voxel_m() const { return info.config.voxel_size_m; }
};

/// Maps the first `num_frames` (0: all) of a data set, as its preset says.
Result<Recording> MapRecording(const std::string& directory, std::size_t num_frames,
                               LabelSource labels = LabelSource::kPredicted);

}  // namespace dhpmap::bench
