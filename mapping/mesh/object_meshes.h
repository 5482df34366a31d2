// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/mesh/mesh.h"
#include "mapping/mesh/mesh_sources.h"

namespace dhpmap {

/// The surface of one object, in metres of the object's own frame.
struct ObjectMesh {
  SubmapId id;
  Mesh mesh;
};

/// The surfaces of `wanted`, in its order. Those that share the map's grid are cut from the one surface that
/// ExtractMapMesh makes of it: each of its triangles belongs to the submap that most of its corners have (of none, to
/// the smallest id), so that together they have neither gaps nor overlaps, and each is the same whichever others are
/// wanted. What is absent or was placed by somebody is meshed by itself; its surface does not change with its pose.
/// Costs the blocks of `wanted` and one block around them. Empty after a `stop` requested meanwhile.
std::vector<ObjectMesh> ExtractObjectMeshes(const MapSnapshot& map, std::span<const Submap* const> wanted,
                                            MeshColoring coloring, const std::stop_token& stop = {});
/// Likewise; `sources`: MeshSourcesOf the same.
std::vector<ObjectMesh> ExtractObjectMeshes(const MapSnapshot& map, std::span<const Submap* const> wanted,
                                            const MeshSources& sources, MeshColoring coloring,
                                            const std::stop_token& stop = {});

}  // namespace dhpmap
