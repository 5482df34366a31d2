// SPDX-License-Identifier: BSD-3-Clause
// dhpmap query search, relations: finds objects, and what is on, in or next to an object.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <utility>

#include "clients/cli/connection.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/query_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct SearchCommand {
  std::string map, name_part;
  std::vector<std::string> class_names;
  std::vector<double> near_m, box_m;
  double max_distance_m = 0;
  int limit = 100;
  AskerFlags asker;
};

struct RelationsCommand {
  std::string map;
  std::int64_t id = -1;  ///< -1: all objects
  std::vector<std::string> kinds;
  double max_gap_m = 0.5;
  AskerFlags asker;
};

v1::SearchSubmapsRequest SearchRequest(const SearchCommand& command) {
  v1::SearchSubmapsRequest request;
  request.set_map(MapName(command.map));
  request.set_name_part(command.name_part);
  *request.mutable_options() = ToProto(command.asker);
  SetRead(command.asker.read, request);
  request.mutable_options()->mutable_class_names()->Assign(command.class_names.begin(), command.class_names.end());
  if (!command.near_m.empty()) SetVector(command.near_m.data(), *request.mutable_near_point_m());
  if (command.max_distance_m != 0) request.mutable_options()->set_max_distance_m(command.max_distance_m);
  if (!command.box_m.empty()) {
    SetVector(command.box_m.data(), *request.mutable_region()->mutable_min_m());
    SetVector(command.box_m.data() + 3, *request.mutable_region()->mutable_max_m());
  }
  request.set_page_size(std::min(command.limit, 1000));
  return request;
}

std::string Coordinates(const v1::Vector3& v) {
  return Fixed(v.x(), 2) + " " + Fixed(v.y(), 2) + " " + Fixed(v.z(), 2);
}

void PrintTable(const v1::SearchSubmapsResponse& response) {
  TextTable table({"ID", "NAME", "DISTANCE_M", "NEAREST_M", "BOX_MIN_M", "BOX_MAX_M"});
  for (const v1::SubmapMatch& match : response.matches()) {
    const bool is_near = match.has_nearest_point_m();
    table.Add({std::to_string(match.submap().instance_id()), match.submap().display_name(),
               is_near ? Fixed(match.distance_m(), 3) : "-", is_near ? Coordinates(match.nearest_point_m()) : "-",
               Coordinates(match.box().min_m()), Coordinates(match.box().max_m())});
  }
  table.Print(std::cout);
}

ExitCode RunSearch(const Session& session, const SearchCommand& command) {
  v1::SearchSubmapsResponse response;
  const auto add = [&](v1::SearchSubmapsResponse& page) {
    response.set_revision(page.revision());
    for (v1::SubmapMatch& match : *page.mutable_matches()) {
      if (response.matches_size() < command.limit) *response.add_matches() = std::move(match);
    }
    return response.matches_size() < command.limit;
  };
  const client::Status status = client::ForEachPage(*session.caller, &v1::QueryService::Stub::SearchSubmaps,
                                                    SearchRequest(command), add, client::Again::kNo);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else PrintTable(response);
  return ExitCode::kOk;
}

v1::Relation::Kind KindOf(const std::string& name) {
  if (name == "on") return v1::Relation::ON;
  return name == "in" ? v1::Relation::IN : v1::Relation::NEXT_TO;
}

void PrintTable(const v1::QueryRelationsResponse& response) {
  TextTable table({"SUBJECT", "RELATION", "OBJECT", "SUPPORT", "ENCLOSURE", "GAP_M"});
  for (const v1::Relation& relation : response.relations()) {
    const bool is_on = relation.kind() == v1::Relation::ON, is_in = relation.kind() == v1::Relation::IN;
    table.Add({relation.subject_display_name(),
               is_on   ? "on"
               : is_in ? "in"
                       : "next to",
               relation.object_display_name(), is_on ? Fixed(relation.support(), 2) : "-",
               is_in ? Fixed(relation.enclosure(), 2) : "-", Fixed(relation.gap_m(), 3)});
  }
  table.Print(std::cout);
}

ExitCode RunRelations(const Session& session, const RelationsCommand& command) {
  v1::QueryRelationsRequest request;
  request.set_map(MapName(command.map));
  if (command.id >= 0) request.set_submap(SubmapName(command.map, command.id));
  for (const std::string& kind : command.kinds) request.add_kinds(KindOf(kind));
  request.set_max_gap_m(command.max_gap_m);
  *request.mutable_options() = ToProto(command.asker);
  SetRead(command.asker.read, request);
  return Tell(session, AskForAll(session, &v1::QueryService::Stub::QueryRelations, request),
              [](const v1::QueryRelationsResponse& response) { PrintTable(response); });
}

}  // namespace

void AddObjectCommands(CLI::App& query, Session& session) {
  auto wanted = std::make_shared<SearchCommand>();
  CLI::App* search = query.add_subcommand("search", "Find objects by class, name, region or distance");
  search->add_option("map", wanted->map, "Name of the map")->required();
  search->add_option("--name", wanted->name_part, "Part of the display name");
  search->add_option("--class", wanted->class_names, "Names of classes; unknown objects stay");
  search->add_option("--near", wanted->near_m, "X Y Z in m: the nearest first")->expected(3);
  search->add_option("--max-distance", wanted->max_distance_m, "From there, in m; default: any");
  search->add_option("--box", wanted->box_m, "MIN_X MIN_Y MIN_Z MAX_X MAX_Y MAX_Z in m: some of the surface is in it")
      ->expected(6);
  search->add_option("--limit", wanted->limit, "So many at most")->check(CLI::PositiveNumber)->capture_default_str();
  AddAskerFlags(*search, wanted->asker);
  search->callback([wanted, &session] { session.exit_code = RunSearch(session, *wanted); });

  auto asked = std::make_shared<RelationsCommand>();
  CLI::App* relations = query.add_subcommand("relations", "Pairs of objects that are on, in or next to each other");
  relations->add_option("map", asked->map, "Name of the map")->required();
  relations->add_option("id", asked->id, "Id of one object; default: of all");
  relations->add_option("--kind", asked->kinds, "Only these")->check(CLI::IsMember({"on", "in", "next-to"}));
  relations->add_option("--max-gap", asked->max_gap_m, "Maximum gap of next to, in m")->capture_default_str();
  AddAskerFlags(*relations, asked->asker);
  relations->callback([asked, &session] { session.exit_code = RunRelations(session, *asked); });
}

}  // namespace dhpmap
