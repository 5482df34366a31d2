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

/// The surfaces of `wanted`, in its order. Those on the map's grid are cut from the surface of ExtractMapMesh: each
/// triangle belongs to the submap with most of its corners (ties: the smallest id), so that together they have neither
/// gaps nor overlaps, and each is independent of the selection. Absent submaps and those placed by an edit are meshed
/// separately; their surface does not depend on the pose. Linear in the blocks of `wanted` and their neighbours. Empty
/// after a `stop` request.
std::vector<ObjectMesh> ExtractObjectMeshes(const MapSnapshot& map, std::span<const Submap* const> wanted,
                                            MeshColoring coloring, const std::stop_token& stop = {});
/// Likewise; `sources`: MeshSourcesOf the same.
std::vector<ObjectMesh> ExtractObjectMeshes(const MapSnapshot& map, std::span<const Submap* const> wanted,
                                            const MeshSources& sources, MeshColoring coloring,
                                            const std::stop_token& stop = {});

}  // namespace dhpmap
