// SPDX-License-Identifier: BSD-3-Clause
// dhpmap query slice: a height band as an occupancy map for nav2.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/output_file.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/query_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct SliceCommand {
  std::string map, file;
  double min_z_m = 0.1, max_z_m = 1.5, resolution_m = 0, min_free_fraction = 0.3;
  std::vector<double> area_m;
  v1::QueryOptions::UnknownPolicy unknown = v1::QueryOptions::UNKNOWN_POLICY_UNSPECIFIED;
  WorldFlags world;
};

v1::QueryOccupancySliceRequest SliceRequest(const SliceCommand& command) {
  v1::QueryOccupancySliceRequest request;
  request.set_map(MapName(command.map));
  request.set_min_z_m(command.min_z_m);
  request.set_max_z_m(command.max_z_m);
  if (command.resolution_m != 0) request.set_resolution_m(command.resolution_m);
  request.set_min_free_fraction(command.min_free_fraction);
  if (!command.area_m.empty()) {
    request.mutable_area()->set_min_x_m(command.area_m[0]);
    request.mutable_area()->set_min_y_m(command.area_m[1]);
    request.mutable_area()->set_max_x_m(command.area_m[2]);
    request.mutable_area()->set_max_y_m(command.area_m[3]);
  }
  *request.mutable_options() = ToProto(command.world, command.map);
  request.mutable_options()->set_unknown_policy(command.unknown);
  SetRead(command.world.asker.read, request);
  return request;
}

Status WriteFile(const std::string& path, const std::string& text) {
  DHPMAP_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Open(path));
  file.Write(text);
  return file.Close();
}

ExitCode RunSlice(const Session& session, const SliceCommand& command) {
  const std::filesystem::path picture = command.file;
  const bool is_png = picture.extension() == ".png";
  if (!is_png && picture.extension() != ".pgm") {
    return ReportLocalError("--out is FILE.pgm or FILE.png; its YAML is written beside it", ExitCode::kUsage);
  }
  v1::QueryOccupancySliceRequest request = SliceRequest(command);
  request.set_format(is_png ? v1::QueryOccupancySliceRequest::PNG : v1::QueryOccupancySliceRequest::PGM);
  request.set_yaml_image_path(picture.filename().string());
  auto slice = Ask(session, &v1::QueryService::Stub::QueryOccupancySlice, request);
  if (!slice.ok()) return ReportError(session, slice.status());
  std::filesystem::path yaml = picture;
  yaml.replace_extension(".yaml");
  for (const auto& [path, text] : {std::pair(picture, &slice->data()), std::pair(yaml, &slice->yaml())}) {
    if (const Status written = WriteFile(path.string(), *text); !written.ok()) {
      return ReportLocalError(written.message());
    }
  }
  if (session.json) {
    slice->clear_data();
    PrintJson(*slice);
  } else {
    std::cout << picture.string() << ", " << yaml.string() << ": " << slice->width() << " x " << slice->height()
              << " cells of " << Fixed(slice->resolution_m(), 3) << " m, of revision " << slice->revision() << "\n";
  }
  return ExitCode::kOk;
}

}  // namespace

void AddSliceCommand(CLI::App& query, Session& session) {
  auto options = std::make_shared<SliceCommand>();
  CLI::App* slice = query.add_subcommand("slice", "Occupied, free and unknown cells from above, as a map for nav2");
  slice->add_option("map", options->map, "Name of the map")->required();
  slice->add_option("--out", options->file, "FILE.pgm or FILE.png; FILE.yaml is written next to it")->required();
  slice->add_option("--from", options->min_z_m, "Bottom of the band, in m")->capture_default_str();
  slice->add_option("--to", options->max_z_m, "Top of the band, in m")->capture_default_str();
  slice->add_option("--area", options->area_m, "MIN_X MIN_Y MAX_X MAX_Y in m; default: all that is known")->expected(4);
  slice->add_option("--resolution", options->resolution_m, "Side of a cell, in m; default: the voxels'");
  slice->add_option("--min-free-fraction", options->min_free_fraction, "Fraction of free voxels that makes a cell free")
      ->capture_default_str();
  AddUnknownFlag(*slice, options->unknown);
  AddWorldFlags(*slice, options->world);
  slice->callback([options, &session] { session.exit_code = RunSlice(session, *options); });
}

}  // namespace dhpmap
