// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/relations_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "clients/command_line/terminal_line.h"
#include "clients/evaluator/experiment.h"
#include "clients/evaluator/output.h"
#include "clients/evaluator/recording.h"
#include "clients/evaluator/relation_score.h"
#include "clients/evaluator/truth_points.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/query/point_lookup.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap::evaluator {
namespace {

struct RelationsOptions {
  std::vector<std::string> directories, settings;
  std::string labels = "predicted";
  int num_threads = 0;
  bool lists_mistakes = false;
};

Result<std::shared_ptr<const MapSnapshot>> MapOf(const std::string& directory, const RelationsOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const LabelSource labels, ParseLabelSource(options.labels));
  if (labels == LabelSource::kNone) return InvalidArgument("without labels there are no things");
  DHPMAP_ASSIGN_OR_RETURN(const auto settings, ParseSettings(options.settings));
  DHPMAP_ASSIGN_OR_RETURN(Recording recording, Recording::Open(directory, kAnyFormat, labels, 0, 0));
  MapInfo info;
  info.name = "relations";
  DHPMAP_ASSIGN_OR_RETURN(info.config, ConfigFor(recording.preset(), settings));
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(recording.label_classes()));
  info.label_set = std::make_shared<const LabelSet>(std::move(label_set));
  recording.set_min_score(info.config.tracking.min_score);
  MapBuilder builder(std::move(info), options.num_threads);
  TerminalLine progress;
  std::size_t num_done = 0;
  DHPMAP_RETURN_IF_ERROR(recording.ForEach([&](const PanopticFrame& frame) {
    progress.Draw(directory + ": frame " + std::to_string(++num_done) + " of " +
                  std::to_string(recording.num_frames()));
    return builder.Integrate(frame).status();
  }));
  builder.Finish();
  return builder.map().Publish(0);
}

/// Labels of measured places: by the truth, and by point queries of the map.
Result<SharedPlaces> PlacesOf(const std::string& directory, const std::shared_ptr<const MapSnapshot>& map) {
  DHPMAP_ASSIGN_OR_RETURN(Recording recording, Recording::OpenMeasured(directory, kAnyFormat, 0));
  TruthPoints points(map->info().config.integration);
  DHPMAP_RETURN_IF_ERROR(recording.ForEach([&points](const PanopticFrame& frame) {
    points.Add(frame);
    return Status::Ok();
  }));
  const SurfaceSamples places = points.Elements();
  const PointLookup lookup(map);
  SharedPlaces shared;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PointInfo there = lookup.At(places.positions_m[i].cast<double>());
    const bool is_near = there.is_observed && std::abs(there.distance_m) < map->info().config.truncation_m;
    ++shared[{places.instances[i], is_near ? static_cast<std::uint32_t>(there.submap.value) : 0}];
  }
  return shared;
}

std::vector<NamedRelation> ToldBy(const std::shared_ptr<const MapSnapshot>& map) {
  SurfaceCache cache(std::size_t{1} << 30);
  const std::shared_ptr<const MapSurfaces> surfaces = cache.Of(map);
  std::vector<NamedRelation> told;
  RelationQuestion question;
  question.most = 100'000;
  for (const Relation& relation : FindRelations(*surfaces, question)) {
    told.push_back(MakeNamedRelation(relation.kind, static_cast<std::uint32_t>(relation.subject->id().value),
                                     static_cast<std::uint32_t>(relation.object->id().value)));
  }
  return told;
}

void PrintScores(const std::string& directory, const char* of, const std::map<RelationKind, RelationScore>& scores) {
  for (const auto& [kind, score] : scores) {
    std::printf("| %s | %s | %s | %ld | %ld | %ld | %.3f | %.3f |\n", DatasetName(directory).c_str(), of, NameOf(kind),
                static_cast<long>(score.num_right), static_cast<long>(score.num_wrong),
                static_cast<long>(score.num_missed), score.Precision(), score.Recall());
  }
}

Status RunOne(const std::string& directory, const RelationsOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const RelationTruth truth, ReadRelationTruth(directory + "/truth.json"));
  DHPMAP_ASSIGN_OR_RETURN(const std::shared_ptr<const MapSnapshot> map, MapOf(directory, options));
  DHPMAP_ASSIGN_OR_RETURN(const SharedPlaces shared, PlacesOf(directory, map));
  const auto stands_for = MatchByPlaces(shared);
  const std::vector<NamedRelation> told = ToldBy(map);
  std::vector<std::string> mistakes;
  PrintScores(directory, "all", ScoreRelations(truth, told, stands_for, false, &mistakes));
  PrintScores(directory, "matched", ScoreRelations(truth, told, stands_for, true, nullptr));
  if (options.lists_mistakes) {
    for (const std::string& mistake : mistakes) std::printf("%s\n", mistake.c_str());
  }
  return Status::Ok();
}

Status Run(const RelationsOptions& options) {
  std::printf("| data | objects | kind | right | wrong | missed | precision | recall |\n");
  std::printf("|---|---|---|--:|--:|--:|--:|--:|\n");
  for (const std::string& directory : options.directories) DHPMAP_RETURN_IF_ERROR(RunOne(directory, options));
  return Status::Ok();
}

}  // namespace

void AddRelationsCommand(CLI::App& app, Status& status) {
  auto options = std::make_shared<RelationsOptions>();
  CLI::App& command =
      *app.add_subcommand("relations", "Compare the relations of maps with truth.json of dhpmap-simulate");
  command.add_option("DATASET_DIR", options->directories, "Recordings of dhpmap-simulate")->required();
  command.add_option("--labels", options->labels, "Labels to map: predicted or groundtruth")->capture_default_str();
  command.add_option("--set", options->settings, "key=value of the map's configuration, on top of the preset");
  command.add_option("--threads", options->num_threads, "0 = one a core")->capture_default_str();
  command.add_flag("--mistakes", options->lists_mistakes, "Also list wrong and missed ones");
  command.callback([options, &status] { status = Run(*options); });
}

}  // namespace dhpmap::evaluator
