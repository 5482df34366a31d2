// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/bulk_chunks.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dhpmap {
namespace {

constexpr std::size_t kMaxChunkBytes = 256 * 1024;
constexpr std::size_t kBytesPerVoxel = 12 + 4 + 4 + 3 + 10 + 4;  // a class id takes up to three bytes, no class ten
constexpr int kVoxelsPerMessage =
    static_cast<int>((kMaxChunkBytes - 1024) / kBytesPerVoxel / kBlockVoxels) * kBlockVoxels;
static_assert(kVoxelsPerMessage >= kBlockVoxels, "a message holds whole blocks");

void Append(const ObservedVoxel& voxel, v1::StreamSubmapVoxelsResponse& message) {
  for (int axis = 0; axis < 3; ++axis) message.add_xyz_m(static_cast<float>(voxel.centre_m[axis]));
  message.add_tsdf_m(voxel.distance_m);
  message.add_weight(voxel.weight);
  for (const std::uint8_t channel : {voxel.color.r, voxel.color.g, voxel.color.b}) {
    message.mutable_rgb()->push_back(static_cast<char>(channel));
  }
  message.add_class_id(voxel.class_id);
  message.add_class_confidence(voxel.class_confidence);
}

const char* ContentType(MeshFormat format) {
  switch (format) {
    case MeshFormat::kPcd: return "application/x-pcd";
    case MeshFormat::kGlb: return "model/gltf-binary";
    case MeshFormat::kPly: break;
  }
  return "application/x-ply";
}

MeshFormat FormatFromProto(v1::GetSubmapMeshRequest::Format format) {
  switch (format) {
    case v1::GetSubmapMeshRequest::PCD: return MeshFormat::kPcd;
    case v1::GetSubmapMeshRequest::GLB: return MeshFormat::kGlb;
    default: return MeshFormat::kPly;
  }
}

Status BadMeshRequest(const char* field, const char* why) {
  return std::move(InvalidArgument("the mesh cannot be made like this").WithReason("BAD_MESH_REQUEST"))
      .WithViolation(field, why);
}

/// The objects named by a request for a whole map.
Result<std::vector<SubmapId>> OnlyFromProto(const v1::GetSubmapMeshRequest& request, bool is_of_map) {
  constexpr int kMost = 1000;
  if (request.instance_ids_size() == 0) return std::vector<SubmapId>();
  if (!is_of_map || request.format() != v1::GetSubmapMeshRequest::GLB) {
    return BadMeshRequest("instance_ids", "is for a whole map as GLB alone");
  }
  if (request.instance_ids_size() > kMost) return BadMeshRequest("instance_ids", "names more than 1,000");
  std::vector<SubmapId> only;
  for (const std::int64_t id : request.instance_ids()) {
    if (id < 0 || id > std::numeric_limits<std::uint32_t>::max()) return BadMeshRequest("instance_ids", "is no id");
    only.emplace_back(static_cast<std::uint32_t>(id));
  }
  std::sort(only.begin(), only.end());
  only.erase(std::unique(only.begin(), only.end()), only.end());
  return only;
}

MeshColoring ColoringFromProto(v1::GetSubmapMeshRequest::Coloring coloring) {
  switch (coloring) {
    case v1::GetSubmapMeshRequest::BY_CLASS: return MeshColoring::kClass;
    case v1::GetSubmapMeshRequest::BY_INSTANCE: return MeshColoring::kInstance;
    default: return MeshColoring::kSensor;
  }
}

}  // namespace

bool VoxelChunks::Next(v1::StreamSubmapVoxelsResponse& message) {
  const bool is_first = !std::exchange(has_begun_, true);
  while (!walk_.is_done() && message.tsdf_m_size() + kBlockVoxels <= kVoxelsPerMessage) {
    for (const ObservedVoxel& voxel : walk_.NextBlock()) Append(voxel, message);
  }
  message.set_revision(walk_.revision());
  return is_first || message.tsdf_m_size() > 0;
}

bool MeshChunks::Next(v1::GetSubmapMeshResponse& message) {
  const bool is_first = !std::exchange(has_begun_, true);
  // Parts that the client has already are named without data.
  if (!file_.Next(*message.mutable_data()) && !(is_first && file_.is_held())) return false;
  message.set_revision(file_.revision());
  if (is_first) {
    message.set_content_type(ContentType(file_.format()));
    message.set_total_bytes(static_cast<std::int64_t>(file_.num_bytes()));
    message.set_etag(file_.etag());
  }
  return true;
}

template <typename Message>
Result<bool> FileChunks::NextOf(Message& message) {
  constexpr std::size_t kBytesPerMessage = 256u << 10;
  const bool is_first = !std::exchange(has_begun_, true);
  DHPMAP_ASSIGN_OR_RETURN(*message.mutable_data(), file_->Read(kBytesPerMessage));
  if (is_first) {
    message.set_content_type("application/vnd.sqlite3");
    message.set_total_bytes(file_->size_bytes());
  }
  return is_first || !message.data().empty();
}
template Result<bool> FileChunks::NextOf(v1::BackupMapsResponse& message);
template Result<bool> FileChunks::NextOf(v1::ExportMapResponse& message);

Result<MeshRequest> MeshRequestFromProto(const v1::GetSubmapMeshRequest& request, std::optional<SubmapId> submap) {
  const bool is_format_known = v1::GetSubmapMeshRequest::Format_IsValid(request.format());
  if (!is_format_known || !v1::GetSubmapMeshRequest::Coloring_IsValid(request.coloring())) {
    return BadMeshRequest(is_format_known ? "coloring" : "format", "is not a known value");
  }
  DHPMAP_ASSIGN_OR_RETURN(std::vector<SubmapId> only, OnlyFromProto(request, !submap));
  return MeshRequest{.submap = submap,
                     .only = std::move(only),
                     .coloring = ColoringFromProto(request.coloring()),
                     .format = FormatFromProto(request.format())};
}

}  // namespace dhpmap
