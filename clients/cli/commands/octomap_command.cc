// SPDX-License-Identifier: BSD-3-Clause
// dhpmap export octomap: occupied and free space as an OctoMap file.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "clients/cli/connection.h"
#include "clients/cli/new_map.h"
#include "clients/cli/octomap_file.h"
#include "clients/cli/output_file.h"
#include "clients/cli/progress_bar.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct OctomapOptions {
  std::string map, file;
  double resolution_m = 0;        ///< 0: the voxels'
  std::vector<double> heights_m;  ///< from, to; empty: of all surfaces
  ReadFlags read;
};

struct Heights {
  double low_m = std::numeric_limits<double>::infinity(), high_m = -std::numeric_limits<double>::infinity();
};

/// The height range of all surfaces: from boxes where known, else from bounding spheres.
Heights HeightsOf(const google::protobuf::RepeatedPtrField<v1::Submap>& submaps) {
  Heights all;
  const auto reach = [&all](double middle_m, double half_m) {
    all = {std::min(all.low_m, middle_m - half_m), std::max(all.high_m, middle_m + half_m)};
  };
  for (const v1::Submap& submap : submaps) {
    const v1::OrientedBox& box = submap.oriented_box();
    if (submap.has_oriented_box()) {
      reach(box.pose().translation_m().z(), box.size_m().z() / 2);
    } else if (submap.has_bounding_sphere()) {
      reach(submap.bounding_sphere().center_m().z(), submap.bounding_sphere().radius_m());
    }
  }
  return all;
}

/// Completes missing options from one state of the map.
client::Status Complete(const Session& session, OctomapOptions& options) {
  const auto map = GetMap(session, options.map, options.read);
  if (!map.ok()) return map.status();
  options.read = {.revision = map->revision()};
  if (options.resolution_m == 0) options.resolution_m = map->config().voxel_size_m();
  if (!options.heights_m.empty()) return {};
  v1::ListSubmapsRequest request;
  request.set_parent(MapName(options.map));
  SetRead(options.read, request);
  const auto all = AskForAll(session, &v1::SubmapService::Stub::ListSubmaps, request);
  if (!all.ok()) return all.status();
  const Heights heights = HeightsOf(all->submaps());
  if (heights.low_m <= heights.high_m) options.heights_m = {heights.low_m, heights.high_m};
  return {};
}

/// Adds the cells of a layer: a slice as thick as a cell.
Status AddLayer(const v1::QueryOccupancySliceResponse& slice, int layer, OctomapFile& octomap) {
  const auto cell_of = [&slice](double outer_m) {
    return static_cast<int>(std::lround(outer_m / slice.resolution_m()));
  };
  const int first_x = cell_of(slice.origin_m().x()), first_y = cell_of(slice.origin_m().y());
  if (slice.cells().size() != static_cast<std::size_t>(slice.width()) * static_cast<std::size_t>(slice.height())) {
    return DataLoss("the server sent a slice that is not as large as it says");
  }
  std::size_t i = 0;
  for (int y = 0; y < slice.height(); ++y) {
    for (int x = 0; x < slice.width(); ++x, ++i) {
      constexpr char kFree = 0, kOccupied = 100;
      if (slice.cells()[i] != kFree && slice.cells()[i] != kOccupied) continue;
      DHPMAP_RETURN_IF_ERROR(octomap.Add(first_x + x, first_y + y, layer, slice.cells()[i] == kOccupied));
    }
  }
  return Status::Ok();
}

/// kOk if all layers were read. Reports errors.
ExitCode ReadLayers(const Session& session, const OctomapOptions& options, OctomapFile& octomap) {
  if (options.heights_m.empty()) return ExitCode::kOk;  // the map is empty
  const double low = std::floor(options.heights_m[0] / options.resolution_m);
  const double high = std::ceil(options.heights_m[1] / options.resolution_m);
  if (!(low >= -OctomapFile::kReach && high <= OctomapFile::kReach)) {
    return ReportLocalError("OctoMap takes 32,768 layers to each side of the origin: take a larger resolution",
                            ExitCode::kUsage);
  }
  ProgressBar bar(static_cast<std::size_t>(std::max(0.0, high - low)), "layers");
  for (int layer = static_cast<int>(low); layer < static_cast<int>(high); ++layer) {
    v1::QueryOccupancySliceRequest request;
    request.set_map(MapName(options.map));
    request.set_min_z_m(layer * options.resolution_m);
    request.set_max_z_m((layer + 1) * options.resolution_m);
    request.set_resolution_m(options.resolution_m);
    SetRead(options.read, request);
    const auto slice = Ask(session, &v1::QueryService::Stub::QueryOccupancySlice, request);
    if (!slice.ok()) return ReportError(session, slice.status());
    if (const Status added = AddLayer(*slice, layer, octomap); !added.ok()) return ReportLocalError(added.message());
    bar.Show(static_cast<std::size_t>(layer - static_cast<int>(low) + 1), "");
  }
  return ExitCode::kOk;
}

ExitCode RunOctomap(const Session& session, OctomapOptions options) {
  auto file = OutputFile::Open(options.file);
  if (!file.ok()) return ReportLocalError(file.status().message());
  if (const client::Status status = Complete(session, options); !status.ok()) return ReportError(session, status);
  OctomapFile octomap;
  if (const ExitCode code = ReadLayers(session, options, octomap); code != ExitCode::kOk) return code;
  file->Write(octomap.Bytes(options.resolution_m));
  if (const Status closed = file->Close(); !closed.ok()) return ReportLocalError(closed.message());
  if (options.file == "-") return ExitCode::kOk;
  if (session.json) {
    std::cout << "{\n  \"cells\": " << octomap.num_cells() << ",\n  \"occupied\": " << octomap.num_occupied()
              << ",\n  \"revision\": \"" << options.read.revision << "\"\n}\n";
  } else {
    std::cout << options.file << ": " << octomap.num_occupied() << " occupied and "
              << octomap.num_cells() - octomap.num_occupied() << " free cells of " << Fixed(options.resolution_m, 3)
              << " m, of revision " << options.read.revision << "\n";
  }
  return ExitCode::kOk;
}

}  // namespace

void AddOctomapCommand(CLI::App& parent, Session& session) {
  auto options = std::make_shared<OctomapOptions>();
  CLI::App* command = parent.add_subcommand("octomap", "Occupied and free space as an OctoMap file (.bt)");
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_option("-o,--output", options->file, "File to write, - for stdout")->required();
  command->add_option("--resolution", options->resolution_m, "Side of a cell, in m; default: the voxels'")
      ->check(CLI::Range(0.001, 100.0));
  command->add_option("--heights", options->heights_m, "FROM TO in m; default: those of all surfaces")->expected(2);
  AddReadFlags(*command, options->read);
  command->callback([options, &session] { session.exit_code = RunOctomap(session, *options); });
}

}  // namespace dhpmap
