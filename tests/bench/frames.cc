// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/frames.h"

#include <algorithm>
#include <numeric>

#include "clients/datasets/open_dataset.h"

namespace dhpmap::bench {

Result<LoadedFrames> LoadFrames(const std::string& directory, LabelSource labels, std::size_t num_frames) {
  LoadedFrames loaded;
  DHPMAP_ASSIGN_OR_RETURN(loaded.dataset, OpenDataset(directory, kAnyFormat, labels));
  const std::size_t available = loaded.dataset->num_frames();
  const std::size_t wanted = num_frames == 0 ? available : std::min(num_frames, available);
  for (std::size_t i = 0; i < wanted; ++i) {
    const Result<DatasetFrame> read = loaded.dataset->Read(i);
    Result<PanopticFrame> frame = read.ok() ? DecodeFrame(*read, loaded.dataset->has_persistent_ids()) : read.status();
    if (frame.ok()) {
      loaded.frames.push_back(std::move(frame).value());
    } else {
      ++loaded.num_skipped;
    }
  }
  if (loaded.frames.empty()) return NotFound("no frame of " + directory + " can be read");
  return loaded;
}

Summary Summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {sum / static_cast<double>(values.size()), values[values.size() / 2], values[values.size() * 95 / 100]};
}

}  // namespace dhpmap::bench
