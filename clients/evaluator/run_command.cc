// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/run_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "clients/command_line/terminal_line.h"
#include "clients/datasets/open_dataset.h"
#include "clients/evaluator/experiment.h"
#include "clients/evaluator/experiment_json.h"
#include "clients/evaluator/markdown.h"
#include "clients/evaluator/output.h"
#include "clients/evaluator/pictures.h"
#include "clients/evaluator/report.h"
#include "clients/evaluator/systems.h"

namespace dhpmap::evaluator {
namespace {

struct RunOptions {
  ExperimentOptions experiment;
  std::string labels = "predicted", json, markdown, html, pictures;
  std::vector<std::string> settings;
};

Status Run(RunOptions& options) {
  ExperimentOptions& wanted = options.experiment;
  DHPMAP_ASSIGN_OR_RETURN(wanted.labels, ParseLabelSource(options.labels));
  if (wanted.labels == LabelSource::kNone) return InvalidArgument("without labels there is nothing to evaluate");
  DHPMAP_ASSIGN_OR_RETURN(wanted.settings, ParseSettings(options.settings));
  DHPMAP_RETURN_IF_ERROR(CheckWritable({options.json, options.markdown, options.html}));

  TerminalLine progress;
  wanted.on_frame = [&progress](const std::string& system, std::size_t num_done, std::size_t num_frames) {
    progress.Draw(system + ": frame " + std::to_string(num_done + 1) + " of " + std::to_string(num_frames));
  };
  std::optional<TruthPictures> views;
  ReportPictures report;
  const SystemVisitor draw = [&](const Truth& truth, const Scores& scores, const std::vector<ElementLabel>& labels) {
    if (options.pictures.empty() && options.html.empty()) return Status::Ok();
    if (!views) views.emplace(truth);
    if (!options.html.empty()) report.Add(*views, scores, labels);
    return options.pictures.empty() ? Status::Ok() : WritePictures(*views, scores, labels, options.pictures);
  };
  DHPMAP_ASSIGN_OR_RETURN(const Experiment experiment, RunExperiment(wanted, draw));
  progress.Clear();
  const std::string text = ProtocolText(experiment) + "\n" + PointsTable(experiment) +
                           "\nAsked at the same points:\n\n" + AskedTable(experiment) +
                           "\nAgainst the map of the true labels:\n\n" + ScoreTable(experiment) + "\n" +
                           "Classes of that table:\n\n" + ClassTable(experiment);
  std::cout << text;
  if (!options.markdown.empty()) DHPMAP_RETURN_IF_ERROR(WriteText(options.markdown, text));
  if (!options.html.empty()) DHPMAP_RETURN_IF_ERROR(WriteText(options.html, ReportPage(experiment, report)));
  if (!options.json.empty()) DHPMAP_RETURN_IF_ERROR(WriteText(options.json, ToJson(experiment).dump(1) + "\n"));
  return Status::Ok();
}

}  // namespace

void AddRunCommand(CLI::App& app, Status& status) {
  auto options = std::make_shared<RunOptions>();
  ExperimentOptions& wanted = options->experiment;
  wanted.systems = {"dhp_no_refine_one_field", "dhp"};
  CLI::App& command = *app.add_subcommand("run", "Compare maps of one data set with its ground truth");
  command.add_option("DATASET_DIR", wanted.directory, "Data set with ground truth labels")->required();
  command.add_option("--labels", options->labels, "Labels the systems map: predicted or groundtruth")
      ->capture_default_str();
  command.add_option("--format", wanted.format, "Layout of the data set")
      ->check(CLI::IsMember(DatasetFormats()))
      ->capture_default_str();
  command.add_option("--frames", wanted.num_frames, "First frames only; 0 = all")->capture_default_str();
  command.add_option("--systems", wanted.systems, "Which systems, by commas")->delimiter(',')->capture_default_str();
  command.add_option("--set", options->settings, "key=value of the map's configuration, on top of the preset");
  command.add_option("--class-map", wanted.class_map, "File like evaluation_classes.csv instead of the data set's");
  command.add_option("--threads", wanted.num_threads, "0 = one a core")->capture_default_str();
  command.add_option("--json", options->json, "Write everything to this file");
  command.add_option("--markdown", options->markdown, "Write the tables to this file too");
  command.add_option("--html", options->html,
                     "Write one page to look at: tables, scores by class, pictures of truth, maps and errors");
  command.add_option("--pictures", options->pictures, "Write label and error pictures (PNG) to this folder");
  command.callback([options, &status] { status = Run(*options); });
}

}  // namespace dhpmap::evaluator
