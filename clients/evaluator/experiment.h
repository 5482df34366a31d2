// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clients/datasets/dataset.h"
#include "clients/evaluator/evaluation.h"

namespace dhpmap::evaluator {

/// What to run on a data set.
struct ExperimentOptions {
  std::string directory;
  std::string format = kAnyFormat;
  LabelSource labels = LabelSource::kPredicted;
  std::size_t num_frames = 0;  ///< 0: all
  std::string class_map;       ///< file; empty: see FindClassMap
  std::vector<std::string> systems;
  std::vector<std::pair<std::string, std::string>> settings;  ///< keys of MapConfig, applied to the preset
  int num_threads = 0;                                        ///< 0: one per core
  /// Called before each frame with the system and its progress; may be empty.
  std::function<void(const std::string& system, std::size_t num_done, std::size_t num_frames)> on_frame;
};

struct Experiment {
  std::string directory, preset, labels;
  std::int64_t num_frames = 0, num_skipped = 0;
  MapConfig config;
  ClassMap classes;
  Protocol protocol;
  std::int64_t num_truth_samples = 0;
  std::vector<Scores> systems;  ///< compared with the map of the ground truth's labels
  Protocol points_protocol;
  std::int64_t num_truth_points = 0;
  std::vector<Scores> on_points;  ///< the same systems, compared with the ground truth's own points (TruthPoints)
  std::vector<Scores> asked;      ///< systems that answer point queries (LabelsAt), at these points
};

/// Called after each system, before its map is freed.
using SystemVisitor = std::function<Status(const Truth&, const Scores&, const std::vector<ElementLabel>& labels)>;

/// Builds the map of the ground truth's labels with the same fusion (see MakeTruthMap), then each system's map of the
/// same frames. Compares them with that map and with the ground truth's own points. `visit` gets the former; it may be
/// empty.
Result<Experiment> RunExperiment(const ExperimentOptions& options, const SystemVisitor& visit);

/// The preset of a data set with `settings` applied; INVALID_ARGUMENT for unknown keys and values out of range.
Result<MapConfig> ConfigFor(const std::string& preset,
                            const std::vector<std::pair<std::string, std::string>>& settings);

}  // namespace dhpmap::evaluator
