// SPDX-License-Identifier: BSD-3-Clause
// dhpmap edit move|clone|delete|relabel|rename.
#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/cli/class_names.h"
#include "clients/cli/connection.h"
#include "clients/cli/new_map.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct EditOptions {
  std::string map, text;
  std::int64_t id = 0;
  std::vector<double> to_m, by_m, rotation;
  [[nodiscard]] std::string name() const { return SubmapName(map, id); }
  [[nodiscard]] bool has_pose() const { return !to_m.empty() || !by_m.empty() || !rotation.empty(); }
};

std::unique_ptr<v1::SubmapService::Stub> Submaps(const Session& session) {
  return v1::SubmapService::NewStub(Connect(session));
}

grpc::Status GetSubmap(v1::SubmapService::Stub& stub, const std::string& name, v1::Submap& submap) {
  grpc::ClientContext context;
  v1::GetSubmapRequest request;
  request.set_name(name);
  v1::GetSubmapResponse response;
  const grpc::Status status = stub.GetSubmap(&context, request, &response);
  submap = response.submap();
  return status;
}

/// `pose` with the options' changes made to it.
void ChangePose(const EditOptions& options, v1::Pose& pose) {
  v1::Vector3& t = *pose.mutable_translation_m();
  const std::vector<double>& to = options.to_m;
  const std::vector<double>& by = options.by_m;
  if (!to.empty()) t.set_x(to[0]), t.set_y(to[1]), t.set_z(to[2]);
  if (!by.empty()) t.set_x(t.x() + by[0]), t.set_y(t.y() + by[1]), t.set_z(t.z() + by[2]);
  if (options.rotation.empty()) return;
  v1::Quaternion& q = *pose.mutable_rotation();
  q.set_x(options.rotation[0]);
  q.set_y(options.rotation[1]);
  q.set_z(options.rotation[2]);
  q.set_w(options.rotation[3]);
}

template <typename Response>
ExitCode Done(const Session& session, const grpc::Status& status, const Response& response, const std::string& text) {
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else std::cout << text << ", revision " << response.revision() << "\n";
  return ExitCode::kOk;
}

ExitCode Update(const Session& session, v1::SubmapService::Stub& stub, const v1::Submap& submap, const char* field,
                const std::string& text) {
  v1::UpdateSubmapRequest request;
  *request.mutable_submap() = submap;
  request.mutable_update_mask()->add_paths(field);
  grpc::ClientContext context;
  v1::UpdateSubmapResponse response;
  const grpc::Status status = stub.UpdateSubmap(&context, request, &response);
  return Done(session, status, response, text);
}

ExitCode RunMove(const Session& session, const EditOptions& options) {
  if (!options.has_pose()) return ReportLocalError("say where: --to, --by or --rotation", ExitCode::kUsage);
  const auto stub = Submaps(session);
  v1::Submap submap;  // its etag guards the change against others made meanwhile
  const grpc::Status status = GetSubmap(*stub, options.name(), submap);
  if (!status.ok()) return ReportError(session, status);
  ChangePose(options, *submap.mutable_map_from_submap());
  return Update(session, *stub, submap, "map_from_submap", "moved " + options.name());
}

ExitCode RunClone(const Session& session, const EditOptions& options) {
  const auto stub = Submaps(session);
  v1::CloneSubmapRequest request;
  request.set_name(options.name());
  request.set_display_name(options.text);
  if (options.has_pose()) {
    v1::Submap submap;
    const grpc::Status status = GetSubmap(*stub, options.name(), submap);
    if (!status.ok()) return ReportError(session, status);
    ChangePose(options, *submap.mutable_map_from_submap());
    *request.mutable_map_from_submap() = submap.map_from_submap();
  }
  grpc::ClientContext context;
  v1::CloneSubmapResponse response;
  const grpc::Status status = stub->CloneSubmap(&context, request, &response);
  return Done(session, status, response, "cloned to " + response.submap().name());
}

ExitCode RunDelete(const Session& session, const EditOptions& options) {
  v1::DeleteSubmapRequest request;
  request.set_name(options.name());
  grpc::ClientContext context;
  v1::DeleteSubmapResponse response;
  const grpc::Status status = Submaps(session)->DeleteSubmap(&context, request, &response);
  return Done(session, status, response, "deleted " + options.name());
}

ExitCode RunRelabel(const Session& session, const EditOptions& options) {
  v1::Map map;
  const grpc::Status status = GetMap(Connect(session), options.map, map);
  if (!status.ok()) return ReportError(session, status);
  const auto label_class = FindClass(map, options.text);
  if (!label_class.ok()) return ReportLocalError(label_class.status().message(), ExitCode::kNotFound);
  v1::Submap submap;
  submap.set_name(options.name());
  submap.set_class_id(static_cast<std::int32_t>(label_class->id()));
  return Update(session, *Submaps(session), submap, "class_id",
                "relabelled " + options.name() + " to " + label_class->name());
}

ExitCode RunRename(const Session& session, const EditOptions& options) {
  v1::Submap submap;
  submap.set_name(options.name());
  submap.set_display_name(options.text);
  return Update(session, *Submaps(session), submap, "display_name", "renamed " + options.name());
}

/// A command on one object.
CLI::App* AddEdit(CLI::App& edit, const char* name, const char* what, const std::shared_ptr<EditOptions>& options,
                  Session& session, ExitCode (*run)(const Session&, const EditOptions&)) {
  CLI::App* command = edit.add_subcommand(name, what);
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_option("id", options->id, "Instance id of the object")->required();
  command->callback([options, run, &session] { session.exit_code = run(session, *options); });
  return command;
}

void AddPoseOptions(CLI::App& command, EditOptions& options) {
  CLI::Option* to =
      command.add_option("--to", options.to_m, "New translation X Y Z of the object's pose (metres)")->expected(3);
  command.add_option("--by", options.by_m, "Shift by X Y Z (metres)")->expected(3)->excludes(to);
  command.add_option("--rotation", options.rotation, "New rotation as quaternion X Y Z W")->expected(4);
}

}  // namespace

void AddEditCommands(CLI::App& app, Session& session) {
  CLI::App* edit = app.add_subcommand("edit", "Change one object of a map");
  edit->require_subcommand(1);
  auto options = std::make_shared<EditOptions>();
  AddPoseOptions(*AddEdit(*edit, "move", "Change its pose", options, session, RunMove), *options);
  CLI::App* clone = AddEdit(*edit, "clone", "Copy it under a new instance id", options, session, RunClone);
  AddPoseOptions(*clone, *options);
  clone->add_option("--name", options->text, "Display name of the copy");
  AddEdit(*edit, "delete", "Delete it", options, session, RunDelete);
  AddEdit(*edit, "relabel", "Give it another class of its kind", options, session, RunRelabel)
      ->add_option("class", options->text, "Name or id of the class")
      ->required();
  AddEdit(*edit, "rename", "Give it a display name", options, session, RunRename)
      ->add_option("name", options->text, "The new display name")
      ->required();
}

}  // namespace dhpmap
