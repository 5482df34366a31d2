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

/// A file generated while it is read: between pieces it only pins the state of the map and holds one piece. One thread
/// at a time.
class MeshFile {
 public:
  [[nodiscard]] std::int64_t revision() const { return revision_; }  ///< of its state
  [[nodiscard]] MeshFormat format() const { return format_; }
  [[nodiscard]] std::size_t num_bytes() const { return num_bytes_; }
  /// Of kGlb: files of equal etags are the same; else empty. For one submap it is independent of the pose.
  [[nodiscard]] const std::string& etag() const { return etag_; }
  /// Of kGlb: the client has that file, by one of MeshRequest::held_etags: there are no pieces.
  [[nodiscard]] bool is_held() const { return format_ == MeshFormat::kGlb && !glb_; }

  /// The next piece of 1 to 200,000 bytes. False at the end.
  bool Next(std::string& piece);

 private:
  friend Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                                     const std::stop_token& stop, const Spread& spread);
  friend Result<MeshFile> ExportGlb(const std::shared_ptr<const MapSnapshot>& map, const MeshRequest& request,
                                    GlbCache& cache, const RoomFor& room_for, const std::stop_token& stop,
                                    const Spread& spread);
  MeshFile(std::int64_t revision, MeshFormat format, MeshStream mesh, std::string head, CountedBytes reserved);
  /// `glb` null: it is held.
  MeshFile(std::int64_t revision, std::string etag, std::shared_ptr<const GlbFile> glb, CountedBytes reserved);
  bool NextOfGlb(std::string& piece);

  std::int64_t revision_;
  MeshFormat format_;
  std::optional<MeshStream> mesh_;  // not of kGlb
  std::string head_;                // until it is read; not of kGlb
  std::string etag_;                // of kGlb
  std::shared_ptr<const GlbFile> glb_;
  std::size_t num_read_bytes_ = 0;  // of kGlb
  std::size_t num_bytes_;
  Mesh piece_;
  CountedBytes piece_bytes_{MemoryKind::kMeshing};
  CountedBytes reserved_;
};

/// Approximate memory of a MeshFile besides the state of the map; 0 if there is no such submap. Reserve that much of
/// the budget for answers: it counts as MemoryKind::kReserved, because the memory itself counts as meshing.
std::size_t BytesOfExport(const MapSnapshot& map, const MeshRequest& request);

/// Counts the surface, in about half the time of generating it on one core. NOT_FOUND; CANCELLED after a `stop`
/// request. First reads evicted tiles by `spread`. Throws StatusError.
Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                            const std::stop_token& stop = {}, const Spread& spread = InPlace);

/// Likewise, of MeshFormat::kGlb alone; what `cache` has takes neither room nor time, what it has not it gets. Nor does
/// what the client has, where the state tells (GlbPlan::state_name). Passes on what `room_for` says.
Result<MeshFile> ExportGlb(const std::shared_ptr<const MapSnapshot>& map, const MeshRequest& request, GlbCache& cache,
                           const RoomFor& room_for, const std::stop_token& stop = {}, const Spread& spread = InPlace);

}  // namespace dhpmap
