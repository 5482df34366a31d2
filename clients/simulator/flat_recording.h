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
  int num_frames = 120;      ///< once round the apartment
  int first_frame = 0;       ///< earlier ones are left out
  std::uint64_t seed = 1;
  int width_px = 640;
  int height_px = 480;
  bool has_depth_noise = true;
  double noise_level = 1;         ///< how much depth and predictions err: 1 as a depth camera and a network do
  bool has_predictions = true;    ///< beside the ground truth
  bool has_class_scores = false;  ///< in predictions: the classes that the network thinks of
  /// Things that are moved, and as many that are taken away, before a second walk of as many frames, an hour later. 0:
  /// one walk.
  int num_changed = 0;

  /// INVALID_ARGUMENT naming every value out of range.
  [[nodiscard]] Status Validate() const;
  /// Of both walks.
  [[nodiscard]] int TotalFrames() const { return num_changed > 0 ? 2 * num_frames : num_frames; }
};

/// Renders a walk through the apartment as a data set in the flat layout: the run's folder, label tables, camera.txt
/// truth.json and, if things change, changes.json (see ChangesJson); then truth.json is of the second walk. Every byte
/// follows from the options, whatever the number of threads; a frame does not depend on which others are written.
/// `on_frame_done` is called from any thread of the pool. Returns what was seen of each instance. INVALID_ARGUMENT for
/// options out of range, UNAVAILABLE where a file cannot be written; the first error ends the work.
Result<std::vector<InstanceView>> RecordApartment(const ApartmentScene& scene, const RecordingOptions& options,
                                                  ThreadPool& threads, const std::function<void()>& on_frame_done = {});

}  // namespace dhpmap::simulator
