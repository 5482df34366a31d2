// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "dhpmap/v1/submap_service.pb.h"
#include "mapping/base/result.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// Fills the next message of a stream of at most 256 KiB each; false: there is none.
using NextVoxels = std::function<bool(v1::StreamSubmapVoxelsResponse&)>;
using NextMeshPart = std::function<bool(v1::GetSubmapMeshResponse&)>;

/// The observed voxels of a submap with |distance| up to `max_abs_distance_m` (0 = all). At least one message, so that
/// the revision is known for an empty submap, too.
NextVoxels StreamVoxels(std::shared_ptr<const MapSnapshot> snapshot, SubmapId submap, double max_abs_distance_m);

/// The surface of one submap, or without one of the whole map, as a file: the map's has no gaps between submaps (see
/// ExtractMapMesh). Takes the time of meshing; NOT_FOUND.
Result<NextMeshPart> StreamMesh(const MapSnapshot& snapshot, std::optional<SubmapId> submap, v1::MeshFormat format,
                                v1::MeshColoring coloring);

}  // namespace dhpmap
