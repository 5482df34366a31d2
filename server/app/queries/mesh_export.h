// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/base/memory_count.h"
#include "mapping/base/result.h"
#include "mapping/base/spread.h"
#include "mapping/map/map.h"
#include "mapping/mesh/mesh_stream.h"

namespace dhpmap {

enum class MeshFormat {
  kPly,  ///< binary; vertices with normal, colour, class, instance
  kPcd,  ///< binary; the vertices as a point cloud
  kGlb,  ///< binary glTF, each object for itself, see ExtractObjectMeshes; made whole
};

/// Which surface, and as what.
struct MeshRequest {
  std::optional<SubmapId> submap;  ///< empty: all objects in one mesh, without gaps between them (ExtractMapMesh)
  std::vector<SubmapId> only;      ///< of kGlb without a submap: these, of which those that are not there are left out
  MeshColoring coloring = MeshColoring::kSensor;
  MeshFormat format = MeshFormat::kPly;
};

/// A file that is made while it is read: a reader that waits keeps the state of the map and one piece, no more. Belongs
/// to one thread at a time.
class MeshFile {
 public:
  [[nodiscard]] std::int64_t revision() const { return revision_; }  ///< that it shows
  [[nodiscard]] MeshFormat format() const { return format_; }
  [[nodiscard]] std::size_t num_bytes() const { return num_bytes_; }
  /// Of kGlb: the same for the same bytes; else empty. A file of one submap does not change with its pose.
  [[nodiscard]] const std::string& etag() const { return etag_; }

  /// The next piece, of 1 to 200,000 bytes. False: there is none.
  bool Next(std::string& piece);

 private:
  friend Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                                     const std::stop_token& stop, const Spread& spread);
  MeshFile(std::int64_t revision, MeshFormat format, MeshStream mesh, std::string head, CountedBytes reserved);
  MeshFile(std::int64_t revision, std::string glb, CountedBytes reserved);
  bool NextOfGlb(std::string& piece);

  std::int64_t revision_;
  MeshFormat format_;
  std::optional<MeshStream> mesh_;  // not of kGlb
  std::string head_;                // until it is read; of kGlb the whole file
  std::size_t num_read_bytes_ = 0;  // of kGlb
  std::size_t num_bytes_;
  std::string etag_;
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

}  // namespace dhpmap
