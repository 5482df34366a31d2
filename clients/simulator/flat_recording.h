// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "clients/simulator/apartment.h"
#include "clients/simulator/instance_views.h"
#include "mapping/base/result.h"
#include "mapping/base/thread_pool.h"

namespace dhpmap::simulator {

struct RecordingOptions {
  std::filesystem::path directory;
  std::string run = "run1";  ///< folder of the frames in `directory`
  int num_frames = 120;      ///< for one round through the apartment
  int first_frame = 0;       ///< earlier frames are left out
  std::uint64_t seed = 1;
  int width_px = 640;
  int height_px = 480;
  bool has_depth_noise = true;
  double noise_level = 1;         ///< scale of errors in depth and predictions: 1 for a typical camera and network
  bool has_predictions = true;    ///< in addition to the ground truth
  bool has_class_scores = false;  ///< in predictions: the scores of likely classes
  /// Number of things that are moved, and of things that are removed, before a second walk with as many frames, an hour
  /// later. 0: one walk.
  int num_changed = 0;

  /// INVALID_ARGUMENT naming every value out of range.
  [[nodiscard]] Status Validate() const;
  /// Frames of both walks.
  [[nodiscard]] int TotalFrames() const { return num_changed > 0 ? 2 * num_frames : num_frames; }
};

/// Renders a walk through the apartment as a data set in the flat layout: the run's folder, label tables, camera.txt,
/// truth.json and, with changes, changes.json (see ChangesJson); then truth.json describes the second walk. All bytes
/// depend only on the options, not on the number of threads; a frame does not depend on the others. Calls
/// `on_frame_done` from any thread of the pool. Returns what was seen of each instance. INVALID_ARGUMENT for options
/// out of range, UNAVAILABLE if a file cannot be written; stops at the first error.
Result<std::vector<InstanceView>> RecordApartment(const ApartmentScene& scene, const RecordingOptions& options,
                                                  ThreadPool& threads, const std::function<void()>& on_frame_done = {});

}  // namespace dhpmap::simulator
