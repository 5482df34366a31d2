// SPDX-License-Identifier: BSD-3-Clause
// dhpmap undo, redo and undelete.
#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/edit_flags.h"
#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct UndoOptions : EditFlags {
  std::string map;
  int count = 0;
  std::int64_t edit = 0;
  std::int64_t id = 0;
};

void PrintObjectIds(const char* what, const google::protobuf::RepeatedPtrField<std::string>& names) {
  if (names.empty()) return;
  std::cout << what;
  for (const std::string& name : names) std::cout << " " << name.substr(name.rfind('/') + 1);
}

/// `method`: the RPC; `done`: a verb for its effect.
template <typename Request, typename Response>
ExitCode RunReversal(const Session& session, const UndoOptions& options, const char* done,
                     grpc::Status (v1::EditService::Stub::*method)(grpc::ClientContext*, const Request&, Response*)) {
  Request request;
  request.set_map(MapName(options.map));
  request.set_count(options.count);
  request.set_etag(options.etag);
  options.Sign(request);
  if (options.edit > 0) request.set_edit(MapName(options.map) + "/edits/" + std::to_string(options.edit));
  return Tell(session, Ask(session, method, request), [&](const Response& response) {
    PrintObjectIds(options.only_try ? "would be:" : done, response.edits());
    PrintObjectIds(", changed", response.changed_submaps());
    PrintObjectIds(", created", response.created_submaps());
    PrintObjectIds(", removed", response.removed_submaps());
    std::cout << ", revision " << response.revision() << "\n";
  });
}

ExitCode RunUndo(const Session& session, const UndoOptions& options) {
  return RunReversal(session, options, "undone:", &v1::EditService::Stub::UndoEdits);
}

ExitCode RunRedo(const Session& session, const UndoOptions& options) {
  return RunReversal(session, options, "done again:", &v1::EditService::Stub::RedoEdits);
}

ExitCode RunUndelete(const Session& session, const UndoOptions& options) {
  v1::UndeleteSubmapRequest request;
  request.set_name(SubmapName(options.map, options.id));
  request.set_etag(options.etag);
  options.Sign(request);
  return Tell(session, Ask(session, &v1::SubmapService::Stub::UndeleteSubmap, request),
              [&](const v1::UndeleteSubmapResponse& response) {
                std::cout << (options.only_try ? "would be: brought back " : "brought back ")
                          << response.submap().name() << ", revision " << response.revision() << "\n";
              });
}

CLI::App* Add(CLI::App& app, const char* name, const char* what, Session& session,
              ExitCode (*run)(const Session&, const UndoOptions&), std::shared_ptr<UndoOptions>& options) {
  CLI::App* command = app.add_subcommand(name, what);
  options = std::make_shared<UndoOptions>();
  command->add_option("map", options->map, "Name of the map")->required();
  AddEditFlags(*command, *options, "the map, or of the deleted object", "Author, and author of the edits");
  command->callback([options, run, &session] { session.exit_code = run(session, *options); });
  return command;
}

}  // namespace

void AddUndoCommands(CLI::App& app, Session& session) {
  std::shared_ptr<UndoOptions> options;
  for (const bool is_undo : {true, false}) {
    CLI::App* command = is_undo
                            ? Add(app, "undo", "Undo the author's last edits, or one", session, RunUndo, options)
                            : Add(app, "redo", "Redo the author's last undo, or one edit", session, RunRedo, options);
    CLI::Option* count = command->add_option("-n,--number", options->count, "So many [1]")->check(CLI::PositiveNumber);
    command->add_option("--edit", options->edit, "This edit, by its revision as `dhpmap log` tells it")
        ->excludes(count);
  }
  CLI::App* undelete = Add(app, "undelete", "Bring back a deleted object", session, RunUndelete, options);
  undelete->add_option("id", options->id, "Instance id of the object")->required();
}

}  // namespace dhpmap
