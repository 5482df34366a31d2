// SPDX-License-Identifier: BSD-3-Clause
// dhpmap sessions list|end: the feed sessions of a map.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <utility>

#include "clients/cli/connection.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"

namespace dhpmap {
namespace {

std::string Shown(bool is_set, std::int64_t number) { return is_set ? std::to_string(number) : "-"; }

void PrintTable(const v1::ListSessionsResponse& response) {
  TextTable table({"SESSION", "FEEDS", "LEASE_S", "TAKEN", "STORED", "FRAMES", "REFUSED", "TWICE", "POINTS", "RECEIVED",
                   "FRAMES/S"});
  for (const v1::FeedSession& of : response.sessions()) {
    table.Add({of.session().empty() ? "(none)" : of.session(), of.feeding() ? "yes" : "no",
               of.feeding() ? Fixed(of.lease_s(), 1) : "-", Shown(of.has_accepted_sequence(), of.accepted_sequence()),
               Shown(of.has_committed_sequence(), of.committed_sequence()), std::to_string(of.num_frames()),
               std::to_string(of.num_refused()), std::to_string(of.num_duplicates()), std::to_string(of.num_points()),
               Bytes(static_cast<double>(of.num_bytes())), Fixed(of.frames_per_s(), 1)});
  }
  table.Print(std::cout);
}

ExitCode RunList(const Session& session, const std::string& map) {
  v1::ListSessionsRequest request;
  request.set_parent(MapName(map));
  return Tell(session, AskForAll(session, &v1::MappingService::Stub::ListSessions, request),
              [](const auto& all) { PrintTable(all); });
}

ExitCode RunEnd(const Session& session, const std::string& map, const std::string& name) {
  v1::EndSessionRequest request;
  request.set_map(MapName(map));
  request.set_session(name);
  return Tell(session, Ask(session, &v1::MappingService::Stub::EndSession, request),
              [&](const v1::EndSessionResponse&) {
                std::cout << "ended " << (name.empty() ? "the stream without a session" : "session " + name) << "\n";
              });
}

}  // namespace

void AddSessionsCommands(CLI::App& app, Session& session) {
  CLI::App* sessions =
      app.add_subcommand("sessions", "List the feed sessions of a map with their progress, or end one");
  sessions->require_subcommand(1);
  auto options = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App* list = sessions->add_subcommand("list", "All sessions of a map");
  list->add_option("map", options->first, "Name of the map")->required();
  list->callback([options, &session] { session.exit_code = RunList(session, options->first); });
  CLI::App* end = sessions->add_subcommand("end", "End the stream of a feed session; its fused frames stay");
  end->add_option("map", options->first, "Name of the map")->required();
  end->add_option("session", options->second, "Name of the session; none: the stream that names none");
  end->callback([options, &session] { session.exit_code = RunEnd(session, options->first, options->second); });
}

}  // namespace dhpmap
