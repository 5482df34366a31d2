// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "mapping/base/transform.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// One object of a GLB file: a node with the mesh below it.
struct GlbObject {
  std::string name;    ///< of the node; printable ASCII without quotes and backslashes
  std::string extras;  ///< of the node: a JSON object; empty: none
  Transform T_file_object = Transform::Identity();
  const Mesh* mesh = nullptr;  ///< in the object's frame; outlives the call
};

/// Binary glTF 2.0 with KHR_mesh_quantization, z up as in the map: positions as 16 bits of the mesh's largest side,
/// normals as 8 bits, colours linear as 16 bits. A vertex takes 20 bytes, a triangle 6, or 12 of a mesh with more than
/// 65,535 vertices. An object without triangles is a node without a mesh.
std::string WriteGlb(std::span<const GlbObject> objects);

}  // namespace dhpmap
