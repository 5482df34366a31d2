// SPDX-License-Identifier: BSD-3-Clause
// dhpmap fleet status|move: servers on one database, and who owns which map.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "clients/cli/connection.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/fleet_service.grpc.pb.h"

namespace dhpmap {
namespace {

using FleetStub = v1::FleetService::Stub;

std::string StateOf(const v1::FleetServer& server) {
  if (!server.alive()) return "dead";
  return server.draining() ? "draining" : "alive";
}

void PrintServers(const v1::GetFleetResponse& fleet) {
  TextTable table({"SERVER", "ADDRESS", "VERSION", "STATE", "MAPS", "ASKED"});
  for (const v1::FleetServer& server : fleet.servers()) {
    table.Add({server.name(), server.address(), server.version(), StateOf(server), std::to_string(server.num_maps()),
               server.answering() ? "this" : ""});
  }
  table.Print(std::cout);
}

void PrintOwners(const v1::ListMapOwnersResponse& maps) {
  TextTable table({"MAP", "OWNER", "ADDRESS", "EPOCH"});
  for (const v1::MapOwner& owner : maps.owners()) {
    table.Add({owner.map(), owner.server().empty() ? "-" : owner.server(),
               owner.address().empty() ? "-" : owner.address(), std::to_string(owner.epoch())});
  }
  table.Print(std::cout);
}

ExitCode RunStatus(const Session& session, bool includes_maps) {
  const auto fleet = Ask(session, &FleetStub::GetFleet, v1::GetFleetRequest());
  const ExitCode told = Tell(session, fleet, PrintServers);
  if (told != ExitCode::kOk || !includes_maps) return told;
  if (!session.json) std::cout << "\n";
  return Tell(session, AskForAll(session, &FleetStub::ListMapOwners, v1::ListMapOwnersRequest()), PrintOwners);
}

ExitCode RunMove(const Session& session, const std::string& map, const std::string& server) {
  v1::MoveMapRequest request;
  request.set_map(MapName(map));
  request.set_server(server);
  return Tell(session, Ask(session, &FleetStub::MoveMap, request), [](const v1::MoveMapResponse& moved) {
    const v1::MapOwner& owner = moved.owner();
    std::cout << owner.map() << " is owned by " << owner.server() << " at " << owner.address() << ", epoch "
              << owner.epoch() << "\n";
  });
}

}  // namespace

void AddFleetCommands(CLI::App& app, Session& session) {
  CLI::App* fleet = app.add_subcommand("fleet", "Servers on one PostgreSQL database: who they are, who owns which map");
  fleet->require_subcommand(1);
  struct Options {
    bool includes_maps = false;
    std::string map, server;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* status = fleet->add_subcommand("status", "The servers, and the dead ones that still own maps");
  status->add_flag("--maps", options->includes_maps, "Also list all maps with their owners");
  status->callback([options, &session] { session.exit_code = RunStatus(session, options->includes_maps); });
  CLI::App* move = fleet->add_subcommand("move", "Hand a map over to another server; its streams find it there");
  move->add_option("map", options->map, "Name of the map")->required();
  move->add_option("server", options->server, "Address or id of the server, as of `fleet status`")->required();
  move->callback([options, &session] { session.exit_code = RunMove(session, options->map, options->server); });
}

}  // namespace dhpmap
