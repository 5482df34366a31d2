// SPDX-License-Identifier: BSD-3-Clause
// dhpmap query point, distances, rays (collisions, trajectory: check_command.cc): objects at points, distances to
// surfaces, hits of rays.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <optional>

#include "clients/cli/class_names.h"
#include "clients/cli/connection.h"
#include "clients/cli/point_input.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/query_service.grpc.pb.h"

namespace dhpmap {
namespace {

constexpr int kMaxPointsACall = 1'000'000;

constexpr std::size_t kMostColumns = 10;

struct PointOptions {
  std::string map, file;
  std::vector<float> xyz_m;
  AskerFlags asker;  ///< for `query point`; other commands have it in their flags
};

struct DistancesOptions {
  PointOptions points;
  QueryFlags flags;
  double tolerance_vox = 0, padding_m = 0;
};

Result<std::vector<float>> ReadAll(const PointOptions& options) {
  if (!options.file.empty() && options.file != "-") {
    std::ifstream in(options.file);
    if (!in) return NotFound("cannot read " + options.file);
    return ReadPoints(in);
  }
  if (options.file == "-") return ReadPoints(std::cin);
  if (options.xyz_m.empty() || options.xyz_m.size() % 3 != 0) return InvalidArgument("points are X Y Z [X Y Z ...]");
  return options.xyz_m;
}

/// The points from the command line, a file or stdin. On an error reports it and sets `exit_code`.
std::optional<std::vector<float>> Points(const PointOptions& options, ExitCode& exit_code) {
  auto xyz_m = ReadAll(options);
  if (!xyz_m.ok()) {
    exit_code =
        ReportLocalError(xyz_m.status().message(),
                         xyz_m.status().code() == StatusCode::kNotFound ? ExitCode::kLocalFile : ExitCode::kUsage);
    return std::nullopt;
  }
  if (xyz_m->size() > 3 * static_cast<std::size_t>(kMaxPointsACall)) {
    exit_code = ReportLocalError("at most 1,000,000 points at once", ExitCode::kUsage);
    return std::nullopt;
  }
  return std::move(*xyz_m);
}

void PrintTable(const v1::QueryPointsRequest& request, const v1::QueryPointsResponse& response) {
  TextTable table(
      {"X_M", "Y_M", "Z_M", "INSTANCE", "KIND", "CLASS", "TSDF_M", "WEIGHT", "CLASS_CONF", "INSTANCE_CONF"});
  for (int i = 0; i < response.results_size(); ++i) {
    const v1::PointResult& result = response.results(i);
    std::vector<std::string> row;
    row.reserve(kMostColumns);
    for (int axis = 0; axis < 3; ++axis) row.push_back(Fixed(request.packed_points_m(3 * i + axis), 3));
    if (result.near_surface()) {
      const bool is_known = result.instance_id() != 0;
      row.insert(row.end(), {std::to_string(result.instance_id()), KindName(result.kind()),
                             is_known ? result.class_name() : "-", Fixed(result.tsdf_m(), 4), Fixed(result.weight(), 1),
                             Fixed(result.class_confidence(), 2), Fixed(result.instance_confidence(), 2)});
    } else {
      row.insert(row.end(), {"-", result.free() ? "free" : "unknown", "-", "-", "-", "-", "-"});
    }
    table.Add(std::move(row));
  }
  table.Print(std::cout);
}

ExitCode RunPoint(const Session& session, const PointOptions& options) {
  ExitCode exit_code = ExitCode::kOk;
  const auto xyz_m = Points(options, exit_code);
  if (!xyz_m) return exit_code;
  v1::QueryPointsRequest request;
  request.set_map(MapName(options.map));
  request.mutable_packed_points_m()->Assign(xyz_m->begin(), xyz_m->end());
  *request.mutable_options() = ToProto(options.asker);
  SetRead(options.asker.read, request);
  return Tell(session, Ask(session, &v1::QueryService::Stub::QueryPoints, request),
              [&](const v1::QueryPointsResponse& response) { PrintTable(request, response); });
}

void PrintTable(const v1::QueryDistancesRequest& request, const v1::QueryDistancesResponse& response) {
  TextTable table({"X_M", "Y_M", "Z_M", "STATUS", "DISTANCE_M", "GRADIENT", "NEAREST_M", "INSTANCE", "CLASS"});
  const auto vector = [](const v1::Vector3& v, int decimals) {
    return Fixed(v.x(), decimals) + " " + Fixed(v.y(), decimals) + " " + Fixed(v.z(), decimals);
  };
  for (int i = 0; i < response.results_size(); ++i) {
    const v1::DistanceResult& result = response.results(i);
    std::vector<std::string> row;
    row.reserve(kMostColumns);
    for (int axis = 0; axis < 3; ++axis) row.push_back(Fixed(request.packed_points_m(3 * i + axis), 3));
    row.push_back(v1::QueryStatus::Code_Name(result.status()));
    row.push_back(Fixed(result.distance_m(), 4));
    if (result.has_nearest_point_m()) {
      row.insert(row.end(),
                 {vector(result.gradient(), 3), vector(result.nearest_point_m(), 3),
                  std::to_string(result.instance_id()), result.class_name().empty() ? "-" : result.class_name()});
    } else {
      row.insert(row.end(), {"-", "-", "-", "-"});
    }
    table.Add(std::move(row));
  }
  table.Print(std::cout);
}

ExitCode RunDistances(const Session& session, const DistancesOptions& options) {
  ExitCode exit_code = ExitCode::kOk;
  const auto xyz_m = Points(options.points, exit_code);
  if (!xyz_m) return exit_code;
  v1::QueryDistancesRequest request;
  request.set_map(MapName(options.points.map));
  request.mutable_packed_points_m()->Assign(xyz_m->begin(), xyz_m->end());
  *request.mutable_options() = ToProto(options.flags, options.points.map);
  SetRead(options.flags.world.asker.read, request);
  if (options.padding_m != 0) request.mutable_options()->mutable_padding()->set_default_padding_m(options.padding_m);
  if (options.tolerance_vox != 0) request.mutable_options()->set_tolerance_vox(options.tolerance_vox);
  return Tell(session, Ask(session, &v1::QueryService::Stub::QueryDistances, request),
              [&](const v1::QueryDistancesResponse& response) { PrintTable(request, response); });
}

void PrintTable(const v1::CastRaysResponse& response) {
  TextTable table({"RAY", "STATUS", "DISTANCE_M", "FREE_M", "POINT_M", "INSTANCE", "CLASS"});
  for (int i = 0; i < response.results_size(); ++i) {
    const v1::RayResult& result = response.results(i);
    std::vector<std::string> row = {std::to_string(i), v1::QueryStatus::Code_Name(result.status()),
                                    Fixed(result.distance_m(), 4), Fixed(result.free_distance_m(), 4)};
    if (result.has_point_m()) {
      const v1::Vector3& p = result.point_m();
      row.insert(row.end(),
                 {Fixed(p.x(), 3) + " " + Fixed(p.y(), 3) + " " + Fixed(p.z(), 3), std::to_string(result.instance_id()),
                  result.class_name().empty() ? "-" : result.class_name()});
    } else {
      row.insert(row.end(), {"-", "-", "-"});
    }
    table.Add(std::move(row));
  }
  table.Print(std::cout);
}

ExitCode RunRays(const Session& session, const DistancesOptions& options) {
  const std::vector<float>& numbers = options.points.xyz_m;
  if (numbers.empty() || numbers.size() % 6 != 0) {
    return ReportLocalError("rays are X Y Z DX DY DZ [X Y Z DX DY DZ ...]", ExitCode::kUsage);
  }
  v1::CastRaysRequest request;
  request.set_map(MapName(options.points.map));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    (i % 6 < 3 ? request.mutable_packed_origins_m() : request.mutable_packed_directions())->Add(numbers[i]);
  }
  *request.mutable_options() = ToProto(options.flags, options.points.map);
  SetRead(options.flags.world.asker.read, request);
  return Tell(session, Ask(session, &v1::QueryService::Stub::CastRays, request),
              [&](const v1::CastRaysResponse& response) { PrintTable(response); });
}

void AddPointOptions(CLI::App& command, PointOptions& options) {
  command.add_option("map", options.map, "Name of the map")->required();
  CLI::Option* xyz = command.add_option("xyz", options.xyz_m, "X Y Z [X Y Z ...]");
  command.add_option("--file", options.file, "Read the points from a file, - for stdin")->excludes(xyz);
}

void AddDistances(CLI::App& query, Session& session) {
  auto options = std::make_shared<DistancesOptions>();
  CLI::App* distances = query.add_subcommand("distances", "Distance, gradient and nearest object of points");
  AddPointOptions(*distances, options->points);
  AddQueryFlags(*distances, options->flags);
  AddPaddingFlag(*distances, options->padding_m);
  distances
      ->add_option("--tolerance-vox", options->tolerance_vox, "Allowed overestimate, in voxels, for faster answers")
      ->capture_default_str();
  distances->callback([options, &session] { session.exit_code = RunDistances(session, *options); });
}

void AddRays(CLI::App& query, Session& session) {
  auto options = std::make_shared<DistancesOptions>();
  CLI::App* rays = query.add_subcommand("rays", "First hits of rays");
  rays->add_option("map", options->points.map, "Name of the map")->required();
  rays->add_option("rays", options->points.xyz_m, "X Y Z DX DY DZ [X Y Z DX DY DZ ...]: origins and directions")
      ->required();
  AddQueryFlags(*rays, options->flags);
  rays->callback([options, &session] { session.exit_code = RunRays(session, *options); });
}

}  // namespace

void AddQueryCommands(CLI::App& app, Session& session) {
  CLI::App* query = app.add_subcommand("query", "Ask a map");
  query->require_subcommand(1);
  auto options = std::make_shared<PointOptions>();
  CLI::App* point = query->add_subcommand("point", "Class, object and TSDF at points (metres)");
  AddPointOptions(*point, *options);
  AddAskerFlags(*point, options->asker);
  point->callback([options, &session] { session.exit_code = RunPoint(session, *options); });
  AddDistances(*query, session);
  AddRays(*query, session);
  AddSliceCommand(*query, session);
  AddGridCommand(*query, session);
  AddObjectCommands(*query, session);
  AddCheckCommands(*query, session);
}

}  // namespace dhpmap
