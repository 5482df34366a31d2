// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "tests/rig/rig.h"

namespace {

using dhpmap::rig::Stall;
using dhpmap::rig::Target;

void AddTarget(CLI::App& command, Target& target) {
  command.add_option("grpc", target.grpc_address)->required();
  command.add_option("http-port", target.http_port)->required();
  command.add_option("map", target.map_id)->required();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Attacks a map server of its own and says whether it held"};
  app.require_subcommand(1);
  bool held = true;

  dhpmap::rig::LoadOptions load;
  CLI::App* command = app.add_subcommand("load", "Quick calls and mapping beside clients that ask for much");
  command->add_option("dataset", load.dataset, "What dhpmap-simulate wrote")->required();
  command->add_option("--seconds", load.seconds)->capture_default_str();
  command->add_option("--clients", load.num_bulk_clients, "That ask for much")->capture_default_str();
  command->callback([&] { held = RunLoad(load); });

  dhpmap::rig::HostileOptions hostile;
  command = app.add_subcommand("hostile", "Memory, with clients that do not read, do not finish, or hang up");
  command->add_option("dataset", hostile.dataset, "What dhpmap-simulate wrote")->required();
  command->add_option("--only", hostile.only, "The cases whose names contain this text");
  command->callback([&] { held = RunHostile(hostile); });

  dhpmap::rig::ManyMapsOptions maps;
  command = app.add_subcommand("maps", "Threads and memory, with many maps");
  command->add_option("--maps", maps.num_maps)->capture_default_str();
  command->add_option("--idle-close", maps.idle_close_s, "s")->capture_default_str();
  command->callback([&] { held = RunManyMaps(maps); });

  dhpmap::rig::ApartmentsOptions apartments;
  command = app.add_subcommand("apartments", "Memory after mapping and deleting in turn");
  command->add_option("dataset", apartments.dataset, "What dhpmap-simulate wrote")->required();
  command->add_option("--repetitions", apartments.repetitions)->capture_default_str();
  command->callback([&] { held = RunApartments(apartments); });

  dhpmap::rig::SoakOptions soak;
  command = app.add_subcommand("soak", "Mapping, edits and every kind of query at once, for long");
  command->add_option("dataset", soak.dataset, "What dhpmap-simulate wrote")->required();
  command->add_option("--seconds", soak.seconds)->capture_default_str();
  command->add_option("--clients", soak.num_clients)->capture_default_str();
  command->add_option("--rate", soak.rate_hz, "Calls a second of each client, at most")->capture_default_str();
  command->add_option("--fps", soak.frame_rate_hz, "Frames a second; 0: as many as the server takes")
      ->capture_default_str();
  command->callback([&] { held = RunSoak(soak); });

  dhpmap::rig::DoorsOptions doors;
  command = app.add_subcommand("doors", "How long a hundred points take through each door, at rest and while mapping");
  command->add_option("dataset", doors.dataset, "What dhpmap-simulate wrote")->required();
  command->add_option("--seconds", doors.seconds, "At rest, and as long while mapping")->capture_default_str();
  command->add_option("--clients", doors.num_clients)->capture_default_str();
  command->add_option("--rate", doors.rate_hz, "Calls a second of each client, at most; 0: one after the other")
      ->capture_default_str();
  command->add_option("--fps", doors.frame_rate_hz, "Frames a second; 0: as many as the server takes")
      ->capture_default_str();
  command->callback([&] { held = RunDoors(doors); });

  dhpmap::rig::WatchersOptions watchers;
  command = app.add_subcommand("watchers", "How much slower frames are fused while others watch the map");
  command->add_option("dataset", watchers.dataset, "What dhpmap-simulate wrote")->required();
  command->add_option("--watchers", watchers.num_watchers)->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--pairs", watchers.num_pairs, "Of a run without and one with them")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([&] { held = RunWatchers(watchers); });

  dhpmap::rig::TwoFeedersOptions feeders;
  command = app.add_subcommand("two-feeders", "Whether two sessions at once make the map that one makes");
  command->add_option("dataset", feeders.dataset, "What dhpmap-simulate wrote")->required();
  command->callback([&] { held = RunTwoFeeders(feeders); });

  Target target;
  int num_clients = 1, num_calls = 1;
  Stall stall = Stall::kMeshes;
  command = app.add_subcommand("bulk-clients", "For load")->group("");
  AddTarget(*command, target);
  command->add_option("clients", num_clients)->required();
  command->callback([&] { RunBulkClients(target, num_clients); });

  command = app.add_subcommand("read-watches", "For watchers")->group("");
  AddTarget(*command, target);
  command->add_option("watches", num_calls)->required();
  command->callback([&] { held = RunReadWatches(target, num_calls); });

  command = app.add_subcommand("stalled-client", "For hostile")->group("");
  AddTarget(*command, target);
  command->add_option("stall", stall)
      ->required()
      ->transform(CLI::CheckedTransformer(std::map<std::string, Stall>{{"meshes", Stall::kMeshes},
                                                                       {"points", Stall::kPoints},
                                                                       {"query-streams", Stall::kQueryStreams},
                                                                       {"watches", Stall::kWatches}}));
  command->add_option("calls", num_calls)->required();
  command->callback([&] { RunStalledClient(target, stall, num_calls); });

  CLI11_PARSE(app, argc, argv);
  return held ? 0 : 1;
}
