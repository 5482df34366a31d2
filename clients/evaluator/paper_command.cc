// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/paper_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "clients/command_line/terminal_line.h"
#include "clients/datasets/open_dataset.h"
#include "clients/evaluator/experiment_json.h"
#include "clients/evaluator/output.h"
#include "clients/evaluator/paper_tables.h"
#include "clients/evaluator/pictures.h"

namespace dhpmap::evaluator {
namespace {

struct PaperOptions {
  std::vector<std::string> directories, settings;
  std::size_t num_frames = 0;
  int num_threads = 0;
  bool without_retrieval = false;
  std::string json, markdown, pictures;
};

nlohmann::json TimesToJson(const RetrievalTimes& r) {
  return {{"num_voxels", r.scene.num_voxels},
          {"num_object_voxels", r.scene.num_object_voxels},
          {"num_copied_voxels", r.num_copied},
          {"traversal_s", r.traversal_s},
          {"find_s", r.find_s},
          {"copy_s", r.copy_s},
          {"flat_bytes", r.flat_bytes},
          {"map_bytes", r.map_bytes}};
}

Result<Experiment> RunOn(const std::string& directory, const PaperOptions& options) {
  ExperimentOptions wanted;
  wanted.directory = directory;
  wanted.num_frames = options.num_frames;
  wanted.num_threads = options.num_threads;
  wanted.systems = PaperSystems();
  DHPMAP_ASSIGN_OR_RETURN(wanted.settings, ParseSettings(options.settings));
  TerminalLine progress;
  wanted.on_frame = [&](const std::string& system, std::size_t num_done, std::size_t num_frames) {
    progress.Draw(directory + ": " + system + ", frame " + std::to_string(num_done + 1) + " of " +
                  std::to_string(num_frames));
  };
  std::optional<TruthPictures> views;
  return RunExperiment(wanted, [&](const Truth& truth, const Scores& scores, const auto& labels) {
    progress.Clear();
    std::cerr << directory << ": " << scores.system << std::endl;
    if (options.pictures.empty()) return Status::Ok();
    if (!views) views.emplace(truth);
    return WritePictures(*views, scores, labels, options.pictures + "/" + DatasetName(directory));
  });
}

/// Checks all data sets first, so that a missing one does not discard results.
Status CheckReadable(const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    for (const LabelSource labels : {LabelSource::kGroundTruth, LabelSource::kPredicted}) {
      DHPMAP_RETURN_IF_ERROR(OpenDataset(directory, kAnyFormat, labels).status());
    }
  }
  return Status::Ok();
}

Status Run(const PaperOptions& options) {
  DHPMAP_RETURN_IF_ERROR(CheckWritable({options.json, options.markdown}));
  DHPMAP_RETURN_IF_ERROR(CheckReadable(options.directories));
  std::vector<Experiment> experiments;
  for (const std::string& directory : options.directories) {
    DHPMAP_ASSIGN_OR_RETURN(Experiment experiment, RunOn(directory, options));
    experiments.push_back(std::move(experiment));
  }
  std::vector<RetrievalTimes> retrievals;
  if (!options.without_retrieval) {
    for (const RetrievalScene& scene : PaperScenes()) retrievals.push_back(MeasureRetrieval(scene, kRetrievalRuns));
  }
  const std::string text = PaperText(experiments, retrievals);
  std::cout << text;
  if (!options.markdown.empty()) DHPMAP_RETURN_IF_ERROR(WriteText(options.markdown, text));
  if (options.json.empty()) return Status::Ok();
  nlohmann::json results{{"processor", ProcessorName()}};
  results["experiments"] = nlohmann::json::array();
  results["retrieval"] = nlohmann::json::array();
  for (const Experiment& experiment : experiments) results["experiments"].push_back(ToJson(experiment));
  for (const RetrievalTimes& times : retrievals) results["retrieval"].push_back(TimesToJson(times));
  return WriteText(options.json, results.dump(1) + "\n");
}

}  // namespace

void AddPaperCommand(CLI::App& app, Status& status) {
  auto options = std::make_shared<PaperOptions>();
  CLI::App& command = *app.add_subcommand("paper", "The paper's tables, with our numbers and its own");
  command.add_option("DATASET_DIR", options->directories, "Data sets with ground truth and predicted labels");
  command.add_option("--frames", options->num_frames, "First frames of each only; 0 = all")->capture_default_str();
  command.add_option("--set", options->settings, "key=value of the map's configuration, on top of the preset");
  command.add_option("--threads", options->num_threads, "0 = one a core")->capture_default_str();
  command.add_flag("--without-retrieval", options->without_retrieval, "Leave out Table IV (takes 2 GB of memory)");
  command.add_option("--json", options->json, "Write everything to this file");
  command.add_option("--markdown", options->markdown, "Write the tables to this file too");
  command.add_option("--pictures", options->pictures, "Write label and error pictures (PNG) to folders in this one");
  command.callback([options, &status] { status = Run(*options); });
}

}  // namespace dhpmap::evaluator
