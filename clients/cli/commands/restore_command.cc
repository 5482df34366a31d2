// SPDX-License-Identifier: BSD-3-Clause
// dhpmap restore: returns a map, or one of its objects, to a past revision.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "clients/cli/connection.h"
#include "clients/cli/edit_flags.h"
#include "dhpmap/v1/edit_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct RestoreFlags : EditFlags {
  std::string map;
  std::int64_t revision = 0;
  std::int64_t id = -1;  ///< -1: the whole map
};

void PrintRestored(const char* what, const google::protobuf::RepeatedPtrField<std::string>& names) {
  if (names.empty()) return;
  std::cout << ", " << what;
  for (const std::string& name : names) std::cout << " " << name.substr(name.rfind('/') + 1);
}

ExitCode RunRestore(const Session& session, const RestoreFlags& flags) {
  v1::RestoreRevisionRequest request;
  request.set_map(MapName(flags.map));
  request.set_revision(flags.revision);
  if (flags.id >= 0) request.set_submap(SubmapName(flags.map, flags.id));
  request.set_etag(flags.etag);
  flags.Sign(request);
  return Tell(session, Ask(session, &v1::EditService::Stub::RestoreRevision, request),
              [&](const v1::RestoreRevisionResponse& response) {
                std::cout << (flags.only_try ? "would be" : "is") << " as in revision " << flags.revision;
                PrintRestored("changed", response.changed_submaps());
                PrintRestored("created", response.created_submaps());
                PrintRestored("removed", response.removed_submaps());
                std::cout << ", revision " << response.revision() << "\n";
              });
}

}  // namespace

void AddRestoreCommand(CLI::App& app, Session& session) {
  auto flags = std::make_shared<RestoreFlags>();
  CLI::App* command = app.add_subcommand("restore", "Restore a map, or one of its objects, to an earlier revision");
  command->add_option("map", flags->map, "Name of the map")->required();
  command->add_option("--revision", flags->revision, "Back to this revision")->required();
  // Otherwise a mistyped id would restore the whole map.
  command->add_option("--submap", flags->id, "Instance id of the one object; default: all of the map")
      ->check(CLI::NonNegativeNumber);
  AddEditFlags(*command, *flags, "the object, or of the map");
  command->callback([flags, &session] { session.exit_code = RunRestore(session, *flags); });
}

}  // namespace dhpmap
