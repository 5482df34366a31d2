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
#include "clients/cli/pages.h"
#include "clients/cli/printable.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "clients/datasets/open_dataset.h"
#include "dhpmap/v1/map_service.grpc.pb.h"

namespace dhpmap {
namespace {

std::unique_ptr<v1::MapService::Stub> Maps(const Session& session) { return v1::MapService::NewStub(Connect(session)); }

ExitCode RunList(const Session& session) {
  v1::ListMapsResponse response;
  v1::ListMapsRequest request;
  request.set_include_label_classes(true);
  const auto maps = Maps(session);
  const grpc::Status status = ReadAllPages(request, response, [&maps](auto* context, const auto& page, auto* answer) {
    return maps->ListMaps(context, page, answer);
  });
  if (!status.ok()) return ReportError(session, status);
  if (session.json) {
    PrintJson(response);
    return ExitCode::kOk;
  }
  TextTable table({"MAP", "FRAMES", "SUBMAPS", "CLASSES", "VOXEL_M", "REVISION", "TITLE"});
  for (const v1::Map& map : response.maps()) {
    table.Add({map.name().substr(5), std::to_string(map.num_frames()), std::to_string(map.num_submaps()),
               std::to_string(map.label_classes_size()), Fixed(map.config().voxel_size_m(), 3),
               std::to_string(map.revision()), map.display_name()});
  }
  table.Print(std::cout);
  return ExitCode::kOk;
}

/// A map as it is, or was at a revision.
struct MapAt {
  std::string name;
  std::int64_t read_revision = 0;
};

ExitCode RunShow(const Session& session, const MapAt& wanted) {
  v1::Map map;
  const grpc::Status status = GetMap(Connect(session), wanted.name, map, wanted.read_revision);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) {
    PrintJson(map);
    return ExitCode::kOk;
  }
  std::cout << map.name() << (map.display_name().empty() ? "" : " (" + Printable(map.display_name()) + ")") << ": "
            << map.num_frames() << " frames, " << map.num_submaps() << " submaps, revision " << map.revision() << "\n"
            << map.config().DebugString();
  TextTable table({"CLASS", "NAME", "KIND"});
  for (const v1::LabelClass& label_class : map.label_classes()) {
    table.Add({std::to_string(label_class.id()), label_class.name(), KindName(label_class.kind())});
  }
  table.Print(std::cout);
  return ExitCode::kOk;
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
  grpc::ClientContext context;
  v1::CreateMapResponse response;
  const grpc::Status status = Maps(session)->CreateMap(&context, *request, &response);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else std::cout << "created " << response.map().name() << "\n";
  return ExitCode::kOk;
}

struct MapRename : EditFlags {
  std::string name, title;
};

ExitCode RunRenameMap(const Session& session, const MapRename& rename) {
  grpc::ClientContext context;
  v1::UpdateMapRequest request;
  request.mutable_map()->set_name(MapName(rename.name));
  request.mutable_map()->set_display_name(rename.title);
  request.mutable_map()->set_etag(rename.etag);
  request.mutable_update_mask()->add_paths("display_name");
  rename.Sign(request);
  v1::UpdateMapResponse response;
  const grpc::Status status = Maps(session)->UpdateMap(&context, request, &response);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else
    std::cout << MapName(rename.name) << (rename.only_try ? " would be called '" : " is now called '") << rename.title
              << "'\n";
  return ExitCode::kOk;
}

struct MapDeletion {
  std::string name;
  bool yes = false;
};

/// Asks first: there is no way back, short of a backup.
ExitCode RunDeleteMap(const Session& session, const MapDeletion& deletion) {
  const std::string& name = deletion.name;
  if (!deletion.yes) {
    v1::Map map;
    const grpc::Status found = GetMap(Connect(session), name, map);
    const bool is_damaged = found.error_code() == grpc::StatusCode::DATA_LOSS;
    if (!found.ok() && !is_damaged) return ReportError(session, found);
    const std::string what =
        is_damaged ? ", which is damaged" : " with all its submaps (" + std::to_string(map.num_submaps()) + ")";
    const std::string question = "Delete " + MapName(name) + what + "? This cannot be undone.";
    const Status said = Confirm(question, isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0, std::cin, std::cerr);
    if (!said.ok()) return ReportLocalError(said.message(), ExitCode::kUsage);
  }
  grpc::ClientContext context;
  v1::DeleteMapRequest request;
  request.set_name(MapName(name));
  v1::DeleteMapResponse response;
  const grpc::Status status = Maps(session)->DeleteMap(&context, request, &response);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else std::cout << "deleted " << MapName(name) << "\n";
  return ExitCode::kOk;
}

ExitCode RunStats(const Session& session, const MapAt& wanted) {
  grpc::ClientContext context;
  v1::GetMapStatsRequest request;
  request.set_name(MapName(wanted.name));
  request.set_read_revision(wanted.read_revision);
  v1::GetMapStatsResponse stats;
  const grpc::Status status = Maps(session)->GetMapStats(&context, request, &stats);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) {
    PrintJson(stats);
    return ExitCode::kOk;
  }
  TextTable table({MapName(wanted.name), "revision " + std::to_string(stats.revision())});
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
  return ExitCode::kOk;
}

std::string Describe(const v1::Refinement& refinement) {
  return "refined in " + Fixed(refinement.management_s() + refinement.crf_s(), 2) +
         " s: " + std::to_string(refinement.num_shared_voxels()) + " voxels that several submaps held, " +
         std::to_string(refinement.num_changed_instances()) + " given to another submap";
}

ExitCode RunFinish(const Session& session, const std::string& name) {
  v1::FinishMappingResponse response;
  const grpc::Status status = FinishAndTell(Connect(session), MapName(name), response);
  if (status.error_code() == grpc::StatusCode::CANCELLED) return ExitCode::kInterrupted;
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else
    std::cout << MapName(name) << ": " << response.num_frames() << " frames, " << response.num_submaps()
              << " submaps, revision " << response.revision() << "; " << Describe(response.refinement()) << "\n";
  return ExitCode::kOk;
}

/// A command that takes the name of a map.
void AddNamed(CLI::App& app, const char* name, const char* what, Session& session,
              ExitCode (*run)(const Session&, const std::string&)) {
  auto map = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("map", *map, "Name of the map")->required();
  command->callback([map, run, &session] { session.exit_code = run(session, *map); });
}

/// Likewise, one that reads the map and can do so in its past.
void AddNamed(CLI::App& app, const char* name, const char* what, Session& session,
              ExitCode (*run)(const Session&, const MapAt&)) {
  auto wanted = std::make_shared<MapAt>();
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("map", wanted->name, "Name of the map")->required();
  AddRevisionFlag(*command, wanted->read_revision);
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
