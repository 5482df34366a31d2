// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/ids.h"
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
  std::string held_etags = {};  ///< of kGlb: etags of the files that the client has, with commas between them
};

}  // namespace dhpmap
