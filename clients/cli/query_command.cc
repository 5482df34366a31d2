// SPDX-License-Identifier: BSD-3-Clause
// dhpmap query point: what is at these points?
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>

#include "clients/cli/class_names.h"
#include "clients/cli/connection.h"
#include "clients/cli/point_input.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/query_service.grpc.pb.h"

namespace dhpmap {
namespace {

constexpr int kMaxPointsACall = 1'000'000;

struct PointOptions {
  std::string map, file;
  std::vector<float> xyz_m;
};

Result<std::vector<float>> Points(const PointOptions& options) {
  if (!options.file.empty() && options.file != "-") {
    std::ifstream in(options.file);
    if (!in) return NotFound("cannot read " + options.file);
    return ReadPoints(in);
  }
  if (options.file == "-") return ReadPoints(std::cin);
  if (options.xyz_m.empty() || options.xyz_m.size() % 3 != 0) return InvalidArgument("points are X Y Z [X Y Z ...]");
  return options.xyz_m;
}

void PrintTable(const v1::QueryPointsRequest& request, const v1::QueryPointsResponse& response) {
  TextTable table(
      {"X_M", "Y_M", "Z_M", "INSTANCE", "KIND", "CLASS", "DISTANCE_M", "WEIGHT", "CLASS_CONF", "INSTANCE_CONF"});
  for (int i = 0; i < response.results_size(); ++i) {
    const v1::PointResult& result = response.results(i);
    std::vector<std::string> row;
    for (int axis = 0; axis < 3; ++axis) row.push_back(Fixed(request.xyz_m(3 * i + axis), 3));
    if (result.observed()) {
      const bool is_known = result.instance_id() != 0;
      row.insert(row.end(),
                 {std::to_string(result.instance_id()), KindName(result.kind()), is_known ? result.class_name() : "-",
                  Fixed(result.distance_m(), 4), Fixed(result.weight(), 1), Fixed(result.class_confidence(), 2),
                  Fixed(result.instance_confidence(), 2)});
    } else {
      row.insert(row.end(), {"-", "unobserved", "-", "-", "-", "-", "-"});
    }
    table.Add(std::move(row));
  }
  table.Print(std::cout);
}

ExitCode RunPoint(const Session& session, const PointOptions& options) {
  const auto xyz_m = Points(options);
  if (!xyz_m.ok()) {
    return ReportLocalError(xyz_m.status().message(),
                            xyz_m.status().code() == StatusCode::kNotFound ? ExitCode::kLocalFile : ExitCode::kUsage);
  }
  if (xyz_m->size() > 3 * static_cast<std::size_t>(kMaxPointsACall)) {
    return ReportLocalError("at most 1,000,000 points at once", ExitCode::kUsage);
  }
  v1::QueryPointsRequest request;
  request.set_map(MapName(options.map));
  request.mutable_xyz_m()->Assign(xyz_m->begin(), xyz_m->end());
  grpc::ClientContext context;
  v1::QueryPointsResponse response;
  const grpc::Status status = v1::QueryService::NewStub(Connect(session))->QueryPoints(&context, request, &response);
  if (!status.ok()) return ReportError(session, status);
  if (session.json) PrintJson(response);
  else PrintTable(request, response);
  return ExitCode::kOk;
}

}  // namespace

void AddQueryCommands(CLI::App& app, Session& session) {
  CLI::App* query = app.add_subcommand("query", "Ask a map");
  query->require_subcommand(1);
  auto options = std::make_shared<PointOptions>();
  CLI::App* point = query->add_subcommand("point", "What is at these points (metres, in the map's frame)?");
  point->add_option("map", options->map, "Name of the map")->required();
  CLI::Option* xyz = point->add_option("xyz", options->xyz_m, "X Y Z [X Y Z ...]");
  point->add_option("--file", options->file, "Read the points from a file, - for stdin")->excludes(xyz);
  point->callback([options, &session] { session.exit_code = RunPoint(session, *options); });
}

}  // namespace dhpmap
