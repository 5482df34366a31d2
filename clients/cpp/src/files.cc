// SPDX-License-Identifier: BSD-3-Clause
// Maps, surfaces and voxels as files and columns.
#include "clients/cpp/src/files.h"

#include <filesystem>
#include <fstream>
#include <utility>

#include "clients/cpp/calls/caller.h"
#include "clients/cpp/src/convert/geometry.h"
#include "dhpmap/client.h"

namespace dhpmap::client {
namespace {

constexpr std::size_t kSentAtOnce_bytes = 256 << 10;

v1::GetSubmapMeshRequest MeshRequest(const std::string& map, const MeshOptions& options) {
  using Request = v1::GetSubmapMeshRequest;
  constexpr Request::Format kFormats[] = {Request::PLY, Request::PCD, Request::GLB};
  constexpr Request::Coloring kColorings[] = {Request::SENSOR, Request::BY_CLASS, Request::BY_INSTANCE};
  Request request;
  request.set_name(options.object ? SubmapName(map, *options.object) : map);
  request.set_format(kFormats[static_cast<int>(options.format)]);
  request.set_coloring(kColorings[static_cast<int>(options.coloring)]);
  request.set_read_revision(options.revision);
  return request;
}

Status AppendVoxels(const v1::StreamSubmapVoxelsResponse& part, Voxels& voxels) {
  const auto n = static_cast<std::size_t>(part.tsdf_m_size());
  if (static_cast<std::size_t>(part.xyz_m_size()) != 3 * n || part.rgb().size() != 3 * n ||
      part.weight_size() != part.tsdf_m_size() || part.class_id_size() != part.tsdf_m_size() ||
      part.class_confidence_size() != part.tsdf_m_size()) {
    return Error(StatusCode::kInternal, "the server sent lists of different lengths");
  }
  voxels.revision = part.revision();
  for (int i = 0; i < part.tsdf_m_size(); ++i) {
    voxels.center_m.push_back({part.xyz_m(3 * i), part.xyz_m(3 * i + 1), part.xyz_m(3 * i + 2)});
    const char* rgb = part.rgb().data() + static_cast<std::ptrdiff_t>(3) * i;
    voxels.rgb.push_back(
        {static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]), static_cast<std::uint8_t>(rgb[2])});
  }
  voxels.tsdf_m.insert(voxels.tsdf_m.end(), part.tsdf_m().begin(), part.tsdf_m().end());
  voxels.weight.insert(voxels.weight.end(), part.weight().begin(), part.weight().end());
  voxels.class_id.insert(voxels.class_id.end(), part.class_id().begin(), part.class_id().end());
  voxels.class_confidence.insert(voxels.class_confidence.end(), part.class_confidence().begin(),
                                 part.class_confidence().end());
  return {};
}

/// Sends the file until the server stops accepting data.
void SendFile(std::ifstream& file, v1::ImportMapRequest first,
              grpc::ClientWriterInterface<v1::ImportMapRequest>& stream) {
  // The first message has no data, so that a name conflict costs nothing.
  v1::ImportMapRequest part = std::move(first);
  while (stream.Write(part)) {
    part.Clear();
    std::string& data = *part.mutable_data();
    data.resize(kSentAtOnce_bytes);
    file.read(data.data(), static_cast<std::streamsize>(data.size()));
    data.resize(static_cast<std::size_t>(file.gcount()));
    if (data.empty()) break;
  }
  stream.WritesDone();
}

}  // namespace

Result<FileInfo> Map::Mesh(const TakePart& take, const MeshOptions& options) const {
  const auto parts =
      caller_->Read(&v1::SubmapService::Stub::GetSubmapMesh, MeshRequest(resource_name_, options), options.deadline_s);
  return TakeFile(*parts, take);
}

Result<Voxels> Map::Voxels(std::int64_t object, const VoxelOptions& options) const {
  v1::StreamSubmapVoxelsRequest request;
  request.set_name(SubmapName(resource_name_, object));
  request.set_max_abs_tsdf_m(options.max_abs_tsdf_m);
  request.set_read_revision(options.revision);
  const auto parts = caller_->Read(&v1::SubmapService::Stub::StreamSubmapVoxels, request, options.deadline_s);
  client::Voxels voxels;
  for (v1::StreamSubmapVoxelsResponse part; parts->Next(part);) {
    if (Status status = AppendVoxels(part, voxels); !status.ok()) return status;
  }
  if (Status status = parts->Finish(); !status.ok()) return status;
  return voxels;
}

Result<FileInfo> Map::Export(const TakePart& take, double deadline_s) const {
  v1::ExportMapRequest request;
  request.set_name(resource_name_);
  const auto parts = caller_->Read(&v1::MapService::Stub::ExportMap, request, deadline_s);
  return TakeFile(*parts, take);
}

Result<FileInfo> Client::Backup(const TakePart& take, double deadline_s) const {
  const auto parts = caller_->Read(&v1::MapService::Stub::BackupMaps, v1::BackupMapsRequest(), deadline_s);
  return TakeFile(*parts, take);
}

Result<Map> Client::ImportMap(const std::string& file, std::string_view name, double deadline_s) const {
  std::error_code failed;
  const auto num_bytes = std::filesystem::file_size(file, failed);
  std::ifstream in(file, std::ios::binary);
  if (failed || !in.is_open()) return BadArgument("file", "cannot read " + file);
  v1::ImportMapRequest first;
  first.set_map_id(std::string(name.starts_with("maps/") ? name.substr(5) : name));
  first.set_total_bytes(static_cast<std::int64_t>(num_bytes));
  grpc::ClientContext context;
  caller_->Introduce(context);
  context.set_deadline(GrpcTime(Clock::now() + Seconds(deadline_s)));
  v1::ImportMapResponse response;
  const auto stream = caller_->stub<v1::MapService::Stub>().ImportMap(&context, &response);
  SendFile(in, std::move(first), *stream);
  if (Status status = caller_->StatusOf(stream->Finish()); !status.ok()) return status;
  return Map(caller_, response.map().name());
}

}  // namespace dhpmap::client
