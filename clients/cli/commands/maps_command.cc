// SPDX-License-Identifier: BSD-3-Clause
// dhpmap maps list|show|create|delete, dhpmap stats, dhpmap finish.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/cli/class_names.h"
#include "clients/cli/confirmation.h"
#include "clients/cli/connection.h"
#include "clients/cli/edit_flags.h"
#include "clients/cli/finish_call.h"
#include "clients/cli/new_map.h"
#include "clients/cli/printable.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "clients/datasets/open_dataset.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap {
namespace {

void PrintTable(const v1::ListMapsResponse& response) {
  TextTable table({"MAP", "FRAMES", "SUBMAPS", "CLASSES", "VOXEL_M", "REVISION", "TITLE"});
  for (const v1::Map& map : response.maps()) {
    table.Add({map.name().substr(5), std::to_string(map.num_frames()), std::to_string(map.num_submaps()),
               std::to_string(map.label_classes_size()), Fixed(map.config().voxel_size_m(), 3),
               std::to_string(map.revision()), map.display_name()});
  }
  table.Print(std::cout);
}

ExitCode RunList(const Session& session) {
  v1::ListMapsRequest request;
  request.set_include_label_classes(true);
  return Tell(session, AskForAll(session, &v1::MapService::Stub::ListMaps, request),
              [](const auto& all) { PrintTable(all); });
}

/// A map in its current state, or at a revision.
struct MapAt {
  std::string name;
  ReadFlags read;
};

void PrintMap(const v1::Map& map) {
  std::cout << map.name() << (map.display_name().empty() ? "" : " (" + Printable(map.display_name()) + ")") << ": "
            << map.num_frames() << " frames, " << map.num_submaps() << " submaps, revision " << map.revision() << "\n"
            << map.config().DebugString();
  TextTable table({"CLASS", "NAME", "KIND"});
  for (const v1::LabelClass& label_class : map.label_classes()) {
    table.Add({std::to_string(label_class.id()), label_class.name(), KindName(label_class.kind())});
  }
  table.Print(std::cout);
}

ExitCode RunShow(const Session& session, const MapAt& wanted) {
  return Tell(session, GetMap(session, wanted.name, wanted.read), PrintMap);
}

struct CreateOptions {
  NewMap map;
  std::string dataset, labels = "predicted";
};

ExitCode RunCreate(const Session& session, const CreateOptions& options) {
  std::unique_ptr<Dataset> dataset;
  if (!options.dataset.empty()) {
    const auto labels = ParseLabelSource(options.labels);
    if (!labels.ok()) return ReportLocalError(labels.status().message(), ExitCode::kUsage);
    auto opened = OpenDataset(options.dataset, kAnyFormat, *labels);
    if (!opened.ok()) return ReportLocalError(opened.status().message());
    dataset = std::move(*opened);
  }
  const auto request = ToRequest(options.map, dataset.get());
  if (!request.ok()) return ReportLocalError(request.status().message(), ExitCode::kUsage);
  return Tell(session, Ask(session, &v1::MapService::Stub::CreateMap, *request),
              [](const v1::CreateMapResponse& response) { std::cout << "created " << response.map().name() << "\n"; });
}

struct MapRename : EditFlags {
  std::string name, title;
};

ExitCode RunRenameMap(const Session& session, const MapRename& rename) {
  v1::UpdateMapRequest request;
  request.mutable_map()->set_name(MapName(rename.name));
  request.mutable_map()->set_display_name(rename.title);
  request.mutable_map()->set_etag(rename.etag);
  request.mutable_update_mask()->add_paths("display_name");
  rename.Sign(request);
  return Tell(session, Ask(session, &v1::MapService::Stub::UpdateMap, request), [&](const v1::UpdateMapResponse&) {
    std::cout << MapName(rename.name) << (rename.only_try ? " would be called '" : " is now called '") << rename.title
              << "'\n";
  });
}

struct MapDeletion {
  std::string name;
  bool yes = false;
};

/// Asks first, because only a backup can undo it.
ExitCode RunDeleteMap(const Session& session, const MapDeletion& deletion) {
  const std::string& name = deletion.name;
  if (!deletion.yes) {
    const auto map = GetMap(session, name);
    const bool is_damaged = map.status().code == client::StatusCode::kDataLoss;
    if (!map.ok() && !is_damaged) return ReportError(session, map.status());
    const std::string what =
        is_damaged ? ", which is damaged" : " with all its submaps (" + std::to_string(map->num_submaps()) + ")";
    const std::string question = "Delete " + MapName(name) + what + "? This cannot be undone.";
    const Status said = Confirm(question, isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0, std::cin, std::cerr);
    if (!said.ok()) return ReportLocalError(said.message(), ExitCode::kUsage);
  }
  v1::DeleteMapRequest request;
  request.set_name(MapName(name));
  return Tell(session, Ask(session, &v1::MapService::Stub::DeleteMap, request),
              [&](const v1::DeleteMapResponse&) { std::cout << "deleted " << MapName(name) << "\n"; });
}

void PrintStats(const std::string& map, const v1::GetMapStatsResponse& stats) {
  TextTable table({map, "revision " + std::to_string(stats.revision())});
  table.Add({"frames", std::to_string(stats.num_frames())});
  table.Add({"things", std::to_string(stats.num_things()) + " (" + std::to_string(stats.num_active()) + " active)"});
  table.Add({"stuff", std::to_string(stats.num_stuff())});
  table.Add({"blocks", std::to_string(stats.num_tsdf_blocks()) + " tsdf, " + std::to_string(stats.num_label_blocks()) +
                           " label"});
  table.Add({"voxels", std::to_string(stats.num_observed_voxels()) + " observed of " +
                           std::to_string(stats.num_allocated_voxels())});
  table.Add({"memory", Bytes(static_cast<double>(stats.memory_bytes())) + " (" +
                           Fixed(stats.memory_bytes_per_allocated_voxel(), 1) + " bytes a voxel)"});
  table.Add({"disk", Bytes(static_cast<double>(stats.disk_bytes()))});
  table.Print(std::cout);
}

ExitCode RunStats(const Session& session, const MapAt& wanted) {
  v1::GetMapStatsRequest request;
  request.set_name(MapName(wanted.name));
  SetRead(wanted.read, request);
  return Tell(session, Ask(session, &v1::MapService::Stub::GetMapStats, request),
              [&](const v1::GetMapStatsResponse& stats) { PrintStats(MapName(wanted.name), stats); });
}

std::string Describe(const v1::Refinement& refinement) {
  return "refined in " + Fixed(refinement.management_s() + refinement.crf_s(), 2) +
         " s: " + std::to_string(refinement.num_shared_voxels()) + " voxels that several submaps held, " +
         std::to_string(refinement.num_changed_instances()) + " given to another submap";
}

ExitCode RunFinish(const Session& session, const std::string& name) {
  const auto finished = FinishAndTell(*session.caller, MapName(name));
  if (finished.status().code == client::StatusCode::kCancelled) return ExitCode::kInterrupted;
  return Tell(session, finished, [&](const v1::FinishMappingResponse& response) {
    std::cout << MapName(name) << ": " << response.num_frames() << " frames, " << response.num_submaps()
              << " submaps, revision " << response.revision() << "; " << Describe(response.refinement()) << "\n";
  });
}

/// Adds a command with the name of a map.
void AddNamed(CLI::App& app, const char* name, const char* what, Session& session,
              ExitCode (*run)(const Session&, const std::string&)) {
  auto map = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("map", *map, "Name of the map")->required();
  command->callback([map, run, &session] { session.exit_code = run(session, *map); });
}

/// The same for a command that can read a past state of the map.
void AddNamed(CLI::App& app, const char* name, const char* what, Session& session,
              ExitCode (*run)(const Session&, const MapAt&)) {
  auto wanted = std::make_shared<MapAt>();
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("map", wanted->name, "Name of the map")->required();
  AddReadFlags(*command, wanted->read);
  command->callback([wanted, run, &session] { session.exit_code = run(session, *wanted); });
}

void AddRenameMap(CLI::App& maps, Session& session) {
  auto rename = std::make_shared<MapRename>();
  CLI::App* command = maps.add_subcommand("rename", "Give a map another title; its name stays");
  command->add_option("map", rename->name, "Name of the map")->required();
  command->add_option("title", rename->title, "Its title from now on")->required();
  AddEditFlags(*command, *rename, "the map");
  command->callback([rename, &session] { session.exit_code = RunRenameMap(session, *rename); });
}

void AddDeleteMap(CLI::App& maps, Session& session) {
  auto deletion = std::make_shared<MapDeletion>();
  CLI::App* command = maps.add_subcommand("delete", "Delete a map with all its submaps; asks first");
  command->add_option("map", deletion->name, "Name of the map")->required();
  command->add_flag("--yes,-y", deletion->yes, "Do not ask; without a terminal nothing is deleted otherwise");
  command->callback([deletion, &session] { session.exit_code = RunDeleteMap(session, *deletion); });
}

}  // namespace

void AddMapsCommands(CLI::App& app, Session& session) {
  CLI::App* maps = app.add_subcommand("maps", "List, show, create, delete, export and import maps");
  maps->require_subcommand(0, 1);
  CLI::App* list = maps->add_subcommand("list", "All maps (the default)");
  list->callback([&session] { session.exit_code = RunList(session); });
  maps->callback([maps, &session] {
    if (maps->get_subcommands().empty()) session.exit_code = RunList(session);
  });
  AddNamed(*maps, "show", "One map with its configuration and classes", session, RunShow);
  AddRenameMap(*maps, session);
  AddDeleteMap(*maps, session);
  auto options = std::make_shared<CreateOptions>();
  CLI::App* create = maps->add_subcommand("create", "Create an empty map");
  create->add_option("map", options->map.name, "Name of the new map")->required();
  AddNewMapOptions(*create, options->map);
  create->add_option("--dataset", options->dataset, "Take preset and classes from this data set");
  create->add_option("--labels", options->labels, "Classes of the labels: predicted or groundtruth")
      ->capture_default_str();
  create->callback([options, &session] { session.exit_code = RunCreate(session, *options); });
  AddMapFileCommands(*maps, session);
  AddNamed(app, "stats", "Content and cost of a map", session, RunStats);
  AddNamed(app, "finish", "Finish mapping: refine and store everything; Ctrl-C leaves the map unchanged", session,
           RunFinish);
}

}  // namespace dhpmap
