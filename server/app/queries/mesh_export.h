// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "mapping/base/memory_count.h"
#include "mapping/base/result.h"
#include "mapping/base/spread.h"
#include "mapping/map/map.h"
#include "mapping/mesh/mesh_stream.h"
#include "server/app/queries/glb_cache.h"
#include "server/app/queries/mesh_request.h"

namespace dhpmap {

/// Takes room for so many bytes, or says that there is none.
using RoomFor = std::function<Status(std::size_t num_bytes)>;

/// A file that is made while it is read: a reader that waits keeps the state of the map and one piece, no more. Belongs
/// to one thread at a time.
class MeshFile {
 public:
  [[nodiscard]] std::int64_t revision() const { return revision_; }  ///< that it shows
  [[nodiscard]] MeshFormat format() const { return format_; }
  [[nodiscard]] std::size_t num_bytes() const { return num_bytes_; }
  /// Of kGlb: the same for the same bytes; else empty. A file of one submap does not change with its pose.
  [[nodiscard]] std::string etag() const { return glb_ ? glb_->etag : std::string(); }

  /// The next piece, of 1 to 200,000 bytes. False: there is none.
  bool Next(std::string& piece);

 private:
  friend Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                                     const std::stop_token& stop, const Spread& spread);
  friend Result<MeshFile> ExportGlb(const std::shared_ptr<const MapSnapshot>& map, const MeshRequest& request,
                                    GlbCache& cache, const RoomFor& room_for, const std::stop_token& stop,
                                    const Spread& spread);
  MeshFile(std::int64_t revision, MeshFormat format, MeshStream mesh, std::string head, CountedBytes reserved);
  MeshFile(std::int64_t revision, std::shared_ptr<const GlbFile> glb, CountedBytes reserved);
  bool NextOfGlb(std::string& piece);

  std::int64_t revision_;
  MeshFormat format_;
  std::optional<MeshStream> mesh_;  // not of kGlb
  std::string head_;                // until it is read; not of kGlb
  std::shared_ptr<const GlbFile> glb_;
  std::size_t num_read_bytes_ = 0;  // of kGlb
  std::size_t num_bytes_;
  Mesh piece_;
  CountedBytes piece_bytes_{MemoryKind::kMeshing};
  CountedBytes reserved_;
};

/// What a MeshFile keeps beside the state of the map, more or less; 0 if there is no such submap. Who makes one takes
/// so much of the budget for answers: it is noted as MemoryKind::kReserved, since what is kept is counted as meshing.
std::size_t BytesOfExport(const MapSnapshot& map, const MeshRequest& request);

/// Counts the surface, which takes one core about half the time of making it. NOT_FOUND; CANCELLED after a `stop`
/// requested meanwhile. What is on the disk is read by `spread` first. Throws StatusError.
Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                            const std::stop_token& stop = {}, const Spread& spread = InPlace);

/// Likewise, of MeshFormat::kGlb alone; what `cache` has takes neither room nor time, what it has not it gets. Passes
/// on what `room_for` says.
Result<MeshFile> ExportGlb(const std::shared_ptr<const MapSnapshot>& map, const MeshRequest& request, GlbCache& cache,
                           const RoomFor& room_for, const std::stop_token& stop = {}, const Spread& spread = InPlace);

}  // namespace dhpmap
