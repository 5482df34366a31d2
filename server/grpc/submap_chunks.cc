// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/submap_chunks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mapping/io/pcd.h"
#include "mapping/io/ply.h"
#include "mapping/mesh/map_mesh.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMaxChunkBytes = 256 * 1024;
constexpr std::size_t kBytesPerVoxel = 12 + 4 + 4 + 3 + 3 + 4;  // a class id is up to three bytes
constexpr int kVoxelsPerMessage =
    static_cast<int>((kMaxChunkBytes - 1024) / kBytesPerVoxel / kBlockVoxels) * kBlockVoxels;
static_assert(kVoxelsPerMessage >= kBlockVoxels, "a message holds whole blocks");

/// Walks the blocks of a submap and writes their voxels to messages.
class VoxelCursor {
 public:
  VoxelCursor(std::shared_ptr<const MapSnapshot> snapshot, SubmapId submap, double max_abs_distance_m)
      : snapshot_(std::move(snapshot)),
        submap_(*snapshot_->Find(submap)),
        max_abs_distance_m_(max_abs_distance_m),
        next_(submap_.blocks().entries().begin()),
        end_(submap_.blocks().entries().end()) {}

  bool Next(v1::StreamSubmapVoxelsResponse& message) {
    const bool is_first = !std::exchange(has_begun_, true);
    while (next_ != end_ && message.distance_m_size() + kBlockVoxels <= kVoxelsPerMessage) Append(*next_++, message);
    message.set_revision(snapshot_->revision());
    return is_first || message.distance_m_size() > 0;
  }

 private:
  void Append(const BlockEntry& block, v1::StreamSubmapVoxelsResponse& message) const {
    if (block.tsdf == nullptr) return;
    const TsdfBlock& tsdf = *block.tsdf;
    for (int i = 0; i < kBlockVoxels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!tsdf.IsObserved(i)) continue;
      if (max_abs_distance_m_ > 0 && std::abs(tsdf.distance_m[at]) > max_abs_distance_m_) continue;
      const SubmapInfo& info = submap_.info();
      const Eigen::Vector3d p = info.T_map_submap * VoxelCentre(VoxelIn(block.index, i), info.voxel_size_m);
      for (const double value : {p.x(), p.y(), p.z()}) message.add_xyz_m(static_cast<float>(value));
      message.add_distance_m(tsdf.distance_m[at]);
      message.add_weight(tsdf.weight[at]);
      const Color& color = tsdf.color[at];
      for (const std::uint8_t channel : {color.r, color.g, color.b}) {
        message.mutable_rgb()->push_back(static_cast<char>(channel));
      }
      const BestLabel label = block.labels ? block.labels->BestClass(i) : BestLabel{};
      const bool has_class = info.panoptic != Panoptic::kUnknown;
      message.add_class_id(label.count > 0 ? label.id : has_class ? info.class_id.value : 0u);
      message.add_class_confidence(label.share);
    }
  }

  std::shared_ptr<const MapSnapshot> snapshot_;
  const Submap& submap_;
  double max_abs_distance_m_;
  BlockTable::Range::Iterator next_, end_;
  bool has_begun_ = false;
};

MeshColoring ColoringFromProto(v1::MeshColoring coloring) {
  switch (coloring) {
    case v1::BY_CLASS: return MeshColoring::kClass;
    case v1::BY_INSTANCE: return MeshColoring::kInstance;
    default: return MeshColoring::kSensor;
  }
}

Result<Mesh> MeshOf(const MapSnapshot& snapshot, std::optional<SubmapId> wanted, MeshColoring coloring) {
  if (wanted) {
    const Submap* submap = snapshot.Find(*wanted);
    if (submap == nullptr) {
      return NotFound("submap " + std::to_string(wanted->value) + " does not exist").WithReason("SUBMAP_NOT_FOUND");
    }
    return ExtractMesh(*submap, *snapshot.info().label_set, coloring);
  }
  ThreadPool here(1);  // an export takes a core at most from mapping
  return ExtractMapMesh(snapshot, coloring, here);
}

}  // namespace

NextVoxels StreamVoxels(std::shared_ptr<const MapSnapshot> snapshot, SubmapId submap, double max_abs_distance_m) {
  auto cursor = std::make_shared<VoxelCursor>(std::move(snapshot), submap, max_abs_distance_m);
  return [cursor](v1::StreamSubmapVoxelsResponse& message) { return cursor->Next(message); };
}

Result<NextMeshPart> StreamMesh(const MapSnapshot& snapshot, std::optional<SubmapId> submap, v1::MeshFormat format,
                                v1::MeshColoring coloring) {
  if (!v1::MeshFormat_IsValid(format) || !v1::MeshColoring_IsValid(coloring)) {
    return InvalidArgument("the mesh cannot be made like this")
        .WithReason("BAD_MESH_REQUEST")
        .WithViolation(v1::MeshFormat_IsValid(format) ? "coloring" : "format", "is not a known value");
  }
  DHPMAP_ASSIGN_OR_RETURN(const Mesh mesh, MeshOf(snapshot, submap, ColoringFromProto(coloring)));
  auto file = std::make_shared<std::string>();
  if (format == v1::PCD) {
    DHPMAP_ASSIGN_OR_RETURN(*file, WritePcd(mesh));
  } else {
    *file = WritePly(mesh);
  }
  const char* content_type = format == v1::PCD ? "application/x-pcd" : "application/x-ply";
  const std::int64_t revision = snapshot.revision();
  std::size_t offset = 0;
  bool is_first = true;
  return NextMeshPart([=](v1::GetSubmapMeshResponse& message) mutable {
    if (!is_first && offset == file->size()) return false;
    message.set_revision(revision);
    if (is_first) {
      message.set_content_type(content_type);
      message.set_total_bytes(static_cast<std::int64_t>(file->size()));
    }
    is_first = false;
    message.set_data(file->substr(offset, kMaxChunkBytes - 1024));
    offset += message.data().size();
    return true;
  });
}

}  // namespace dhpmap
