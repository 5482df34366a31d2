// SPDX-License-Identifier: BSD-3-Clause
// dhpmap fleet status|move|upgrade: servers on one database, and who owns which map.
#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
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

std::string Seconds(bool is_known, double seconds) {
  if (!is_known) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << seconds << " s";
  return text.str();
}

void PrintSchema(const v1::FleetSchema& schema) {
  std::cout << "The database is at schema " << schema.in_force();
  if (schema.newest() > schema.in_force()) {
    std::cout << "; `dhpmap fleet upgrade finish` brings it to " << schema.newest() << " once all servers know that";
  }
  std::cout << ".\n";
}

void PrintServers(const v1::GetFleetResponse& fleet) {
  TextTable table({"SERVER", "ADDRESS", "VERSION", "SCHEMA", "STATE", "BEAT", "MAPS", "COPIES", "BEHIND", "ASKED"});
  for (const v1::FleetServer& server : fleet.servers()) {
    table.Add({server.name(), server.address(), server.version(),
               server.newest_schema() > 0 ? std::to_string(server.newest_schema()) : "-", StateOf(server),
               Seconds(server.has_beat_age_s(), server.beat_age_s()), std::to_string(server.num_maps()),
               server.has_num_copies() ? std::to_string(server.num_copies()) : "-",
               Seconds(server.has_copies_behind_s(), server.copies_behind_s()), server.answering() ? "this" : ""});
  }
  table.Print(std::cout);
  if (fleet.has_schema()) PrintSchema(fleet.schema());  // a server of the last release says nothing about it
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

ExitCode RunFinishUpgrade(const Session& session) {
  return Tell(session, Ask(session, &FleetStub::FinishUpgrade, v1::FinishUpgradeRequest()),
              [](const v1::FinishUpgradeResponse& finished) { PrintSchema(finished.schema()); });
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
  CLI::App* upgrade = fleet->add_subcommand("upgrade", "Servers of a newer version, which came one by one");
  upgrade->require_subcommand(1);
  CLI::App* finish = upgrade->add_subcommand(
      "finish", "Bring the database to the newest schema; older servers do not start on it after that");
  finish->callback([&session] { session.exit_code = RunFinishUpgrade(session); });
}

}  // namespace dhpmap
