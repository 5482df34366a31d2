// SPDX-License-Identifier: BSD-3-Clause
// dhpmap export ply|pcd|glb|voxels: geometry as files.
#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/cli/connection.h"
#include "clients/cli/file_download.h"
#include "clients/cli/output_file.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct ExportOptions {
  std::string map, file, coloring = "sensor";
  std::int64_t id = -1;  ///< -1: all objects
  v1::GetSubmapMeshRequest::Format format = v1::GetSubmapMeshRequest::PLY;
  double max_abs_tsdf_m = 0;
  ReadFlags read;
};

v1::GetSubmapMeshRequest::Coloring ColoringOf(const std::string& name) {
  if (name == "class") return v1::GetSubmapMeshRequest::BY_CLASS;
  return name == "instance" ? v1::GetSubmapMeshRequest::BY_INSTANCE : v1::GetSubmapMeshRequest::SENSOR;
}

ExitCode Report(const Session& session, const ExportOptions& options, std::int64_t num_bytes, std::int64_t revision) {
  if (options.file == "-") return ExitCode::kOk;
  if (session.json) {
    std::cout << "{\n  \"bytes\": " << num_bytes << ",\n  \"revision\": \"" << revision << "\"\n}\n";
  } else {
    std::cout << options.file << ": " << Bytes(static_cast<double>(num_bytes)) << " of revision " << revision << "\n";
  }
  return ExitCode::kOk;
}

ExitCode RunMesh(const Session& session, const ExportOptions& options) {
  v1::GetSubmapMeshRequest request;
  request.set_name(options.id >= 0 ? SubmapName(options.map, options.id) : MapName(options.map));
  request.set_format(options.format);
  request.set_coloring(ColoringOf(options.coloring));
  SetRead(options.read, request);
  auto file = OutputFile::Open(options.file);
  if (!file.ok()) return ReportLocalError(file.status().message());
  const auto parts = session.caller->Read(&v1::SubmapService::Stub::GetSubmapMesh, request);
  std::int64_t revision = 0;
  const ExitCode code = Download(session, *parts, "mesh", *file,
                                 [&revision](const v1::GetSubmapMeshResponse& part) { revision = part.revision(); });
  return code == ExitCode::kOk ? Report(session, options, file->num_bytes(), revision) : code;
}

std::string Rows(const v1::StreamSubmapVoxelsResponse& part) {
  std::string rows;
  for (int i = 0; i < part.tsdf_m_size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) rows += Fixed(part.xyz_m(3 * i + axis), 4) + ",";
    rows += Fixed(part.tsdf_m(i), 5) + "," + Fixed(part.weight(i), 3);
    for (int channel = 0; channel < 3; ++channel) {
      rows += ',';
      rows += std::to_string(static_cast<unsigned char>(part.rgb()[static_cast<std::size_t>(3 * i + channel)]));
    }
    rows += ',';
    rows += std::to_string(part.class_id(i)) + "," + Fixed(part.class_confidence(i), 3) + "\n";
  }
  return rows;
}

ExitCode RunVoxels(const Session& session, const ExportOptions& options) {
  v1::StreamSubmapVoxelsRequest request;
  request.set_name(SubmapName(options.map, options.id));
  request.set_max_abs_tsdf_m(options.max_abs_tsdf_m);
  SetRead(options.read, request);
  auto file = OutputFile::Open(options.file);
  if (!file.ok()) return ReportLocalError(file.status().message());
  file->Write("x_m,y_m,z_m,tsdf_m,weight,r,g,b,class_id,class_confidence\n");
  const auto parts = session.caller->Read(&v1::SubmapService::Stub::StreamSubmapVoxels, request);
  v1::StreamSubmapVoxelsResponse part;
  std::int64_t revision = 0;
  while (parts->Next(part)) {
    revision = part.revision();
    const int n = part.tsdf_m_size();
    if (part.xyz_m_size() != 3 * n || part.weight_size() != n || part.rgb().size() != 3 * static_cast<std::size_t>(n) ||
        part.class_id_size() != n || part.class_confidence_size() != n) {
      return ReportLocalError("the server sent lists of different lengths", ExitCode::kServerFailed);
    }
    file->Write(Rows(part));
  }
  if (const client::Status status = parts->Finish(); !status.ok()) return ReportError(session, status);
  const std::int64_t num_bytes = file->num_bytes();
  if (const Status closed = file->Close(); !closed.ok()) return ReportLocalError(closed.message());
  return Report(session, options, num_bytes, revision);
}

void AddMesh(CLI::App& parent, const char* name, const char* what, v1::GetSubmapMeshRequest::Format format,
             Session& session) {
  auto options = std::make_shared<ExportOptions>();
  options->format = format;
  CLI::App* command = parent.add_subcommand(name, what);
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_option("id", options->id, "Instance id of one object; default: all in one file");
  command->add_option("-o,--output", options->file, "File to write, - for stdout")->required();
  command->add_option("--color", options->coloring, "Colour of the vertices")
      ->check(CLI::IsMember({"sensor", "class", "instance"}))
      ->capture_default_str();
  AddReadFlags(*command, options->read);
  command->callback([options, &session] { session.exit_code = RunMesh(session, *options); });
}

}  // namespace

void AddExportCommands(CLI::App& app, Session& session) {
  CLI::App* parent = app.add_subcommand("export", "Write geometry to a file");
  parent->require_subcommand(1);
  AddMesh(*parent, "ply", "The surface as a PLY mesh with class and instance", v1::GetSubmapMeshRequest::PLY, session);
  AddMesh(*parent, "pcd", "The surface's vertices as a PCD cloud", v1::GetSubmapMeshRequest::PCD, session);
  AddMesh(*parent, "glb", "The surface as binary glTF, a node an object", v1::GetSubmapMeshRequest::GLB, session);
  AddOctomapCommand(*parent, session);
  auto options = std::make_shared<ExportOptions>();
  CLI::App* voxels = parent->add_subcommand("voxels", "The observed voxels of one object as CSV");
  voxels->add_option("map", options->map, "Name of the map")->required();
  voxels->add_option("id", options->id, "Instance id of the object")->required();
  voxels->add_option("-o,--output", options->file, "File to write, - for stdout")->required();
  voxels->add_option("--max-abs-tsdf", options->max_abs_tsdf_m, "Only voxels so near the surface (metres)");
  AddReadFlags(*voxels, options->read);
  voxels->callback([options, &session] { session.exit_code = RunVoxels(session, *options); });
}

}  // namespace dhpmap
