// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/experiment.h"

#include <utility>

#include "clients/evaluator/dhp_system.h"
#include "clients/evaluator/recording.h"
#include "clients/evaluator/systems.h"
#include "clients/evaluator/truth_points.h"

namespace dhpmap::evaluator {
namespace {

constexpr std::size_t kCacheBytes = std::size_t{3} << 30;

Result<std::shared_ptr<const LabelSet>> MakeLabelSet(const std::vector<LabelClass>& classes) {
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(classes));
  return std::make_shared<const LabelSet>(std::move(label_set));
}

Status MapRecording(MappingSystem& system, Recording& recording, const ExperimentOptions& options) {
  std::size_t num_done = 0;
  DHPMAP_RETURN_IF_ERROR(recording.ForEach([&](const PanopticFrame& frame) {
    if (options.on_frame) options.on_frame(system.name(), num_done++, recording.num_frames());
    return system.Integrate(frame);
  }));
  system.Finish();
  return Status::Ok();
}

/// All measured points, labelled or not: a system's surface near one is not false.
Result<TruthPoints> MeasuredPoints(const ExperimentOptions& options, const IntegrationConfig& config) {
  DHPMAP_ASSIGN_OR_RETURN(Recording recording,
                          Recording::OpenMeasured(options.directory, options.format, options.num_frames));
  TruthPoints points(config);
  DHPMAP_RETURN_IF_ERROR(recording.ForEach([&points](const PanopticFrame& frame) {
    points.Add(frame);
    return Status::Ok();
  }));
  return points;
}

Result<ClassMap> ReadClasses(const ExperimentOptions& options, const std::vector<LabelClass>& truth,
                             const std::vector<LabelClass>& predicted) {
  if (!options.class_map.empty()) return ClassMap::Read(options.class_map);
  return FindClassMap(options.directory, truth, predicted);
}

}  // namespace

Result<MapConfig> ConfigFor(const std::string& preset,
                            const std::vector<std::pair<std::string, std::string>>& settings) {
  MapConfig config;
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(preset, config));
  for (const auto& [key, value] : settings) DHPMAP_RETURN_IF_ERROR(SetField(config, key, value));
  DHPMAP_RETURN_IF_ERROR(config.Validate());
  return config;
}

Result<Experiment> RunExperiment(const ExperimentOptions& options, const SystemVisitor& visit) {
  for (const std::string& name : options.systems) DHPMAP_RETURN_IF_ERROR(CheckSystemName(name));
  DHPMAP_ASSIGN_OR_RETURN(Recording truth_recording, Recording::Open(options.directory, options.format,
                                                                     LabelSource::kGroundTruth, options.num_frames, 0));
  DHPMAP_ASSIGN_OR_RETURN(Recording recording, Recording::Open(options.directory, options.format, options.labels,
                                                               options.num_frames, kCacheBytes));
  Experiment experiment;
  experiment.directory = options.directory;
  experiment.preset = recording.preset();
  experiment.labels = options.labels == LabelSource::kPredicted ? "predicted" : "groundtruth";
  DHPMAP_ASSIGN_OR_RETURN(experiment.config, ConfigFor(recording.preset(), options.settings));
  recording.set_min_score(experiment.config.tracking.min_score);
  DHPMAP_ASSIGN_OR_RETURN(experiment.classes,
                          ReadClasses(options, truth_recording.label_classes(), recording.label_classes()));
  experiment.protocol = ProtocolFor(experiment.config.voxel_size_m);

  SystemSetup truth_setup{experiment.config, nullptr, options.num_threads};
  DHPMAP_ASSIGN_OR_RETURN(truth_setup.label_set, MakeLabelSet(truth_recording.label_classes()));
  auto truth_system = MakeTruthMap(truth_setup);
  DHPMAP_RETURN_IF_ERROR(MapRecording(*truth_system, truth_recording, options));
  const Truth truth(truth_system->Surface().mesh, experiment.classes, experiment.protocol);
  truth_system.reset();
  experiment.num_truth_samples = static_cast<std::int64_t>(truth.samples().size());
  DHPMAP_ASSIGN_OR_RETURN(TruthPoints points, MeasuredPoints(options, experiment.config.integration));
  experiment.points_protocol = ProtocolForElements(experiment.protocol, points.cell_m());
  ThreadPool pool(options.num_threads);
  Truth truth_points(points.Elements(), experiment.classes, experiment.points_protocol);
  truth_points.set_elements_a_sample(ElementsASample(truth_points, truth.samples(), pool));
  points = TruthPoints(experiment.config.integration);  // frees its memory
  experiment.num_truth_points = static_cast<std::int64_t>(truth_points.samples().size());

  SystemSetup setup{experiment.config, nullptr, options.num_threads};
  DHPMAP_ASSIGN_OR_RETURN(setup.label_set, MakeLabelSet(recording.label_classes()));
  for (const std::string& name : options.systems) {
    DHPMAP_ASSIGN_OR_RETURN(const std::unique_ptr<MappingSystem> system, MakeSystem(name, setup));
    DHPMAP_RETURN_IF_ERROR(MapRecording(*system, recording, options));
    std::vector<ElementLabel> labels;
    const LabelledSurface surface = system->Surface();
    Scores scores = Evaluate(truth, surface, system->has_instances(), pool, &labels);
    Scores on_points = Evaluate(truth_points, surface, system->has_instances(), pool, nullptr);
    scores.system = on_points.system = name;
    scores.times = on_points.times = system->times();
    experiment.on_points.push_back(std::move(on_points));
    if (const auto asked = system->LabelsAt(truth_points.samples().positions_m)) {
      experiment.asked.push_back(EvaluateAsked(truth_points, *asked, surface.instance_scores, system->has_instances()));
      experiment.asked.back().system = name;
      experiment.asked.back().times = system->times();
    }
    if (visit) DHPMAP_RETURN_IF_ERROR(visit(truth, scores, labels));
    experiment.num_frames = scores.times.num_frames;
    experiment.systems.push_back(std::move(scores));
  }
  experiment.num_skipped = static_cast<std::int64_t>(recording.num_skipped());
  return experiment;
}

}  // namespace dhpmap::evaluator
