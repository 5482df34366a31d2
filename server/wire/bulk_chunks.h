// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "server/app/maps/map_registry.h"
#include "server/app/queries/mesh_export.h"
#include "server/app/queries/voxel_walk.h"

namespace dhpmap {

// Bulk answers in messages of at most 256 KiB each.

/// The voxels of a walk. At least one message, so that the revision is known for an empty submap, too.
class VoxelChunks {
 public:
  explicit VoxelChunks(VoxelWalk walk) : walk_(std::move(walk)) {}
  /// Fills the next, empty message; false at the end.
  bool Next(v1::StreamSubmapVoxelsResponse& message);

 private:
  VoxelWalk walk_;
  bool has_begun_ = false;
};

/// A mesh file in the pieces of its generation.
class MeshChunks {
 public:
  explicit MeshChunks(MeshFile file) : file_(std::move(file)) {}
  /// Fills the next, empty message; false at the end.
  bool Next(v1::GetSubmapMeshResponse& message);

 private:
  MeshFile file_;
  bool has_begun_ = false;
};

/// A file of the store: a backup, or one map.
class FileChunks {
 public:
  explicit FileChunks(std::shared_ptr<StoreBackup> file) : file_(std::move(file)) {}
  /// Fills the next, empty message; false at the end. Returns errors of reading the file.
  Result<bool> Next(v1::BackupMapsResponse& message) { return NextOf(message); }
  Result<bool> Next(v1::ExportMapResponse& message) { return NextOf(message); }

 private:
  template <typename Message>
  Result<bool> NextOf(Message& message);

  std::shared_ptr<StoreBackup> file_;
  bool has_begun_ = false;
};

/// INVALID_ARGUMENT for an unknown format or colouring, or objects named where they cannot be. The submap comes from
/// the request's name: see ParseObjectName.
Result<MeshRequest> MeshRequestFromProto(const v1::GetSubmapMeshRequest& request, std::optional<SubmapId> submap);

}  // namespace dhpmap
