// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/evaluator/mapping_system.h"
#include "mapping/map/map.h"

namespace dhpmap::evaluator {

enum class SurfaceKind {
  /// Each submap is meshed separately: places held by several submaps have several surfaces.
  kEachSubmap,
  /// The submaps on the map's grid are meshed as one field (see ExtractMapMesh), so there are no gaps where the corners
  /// of a cell belong to different submaps. Submaps with their own grid are meshed separately.
  kOneField,
};

/// The surface of a map, labelled with the ids and classes of submaps (which remain when a map drops the voxels'
/// labels). The unknown submap has neither. An instance's score is its class confidence times its instance confidence.
LabelledSurface SurfaceOf(const Map& map, SurfaceKind kind);

}  // namespace dhpmap::evaluator
