// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/evaluator/mapping_system.h"
#include "mapping/map/map.h"

namespace dhpmap::evaluator {

enum class SurfaceKind {
  /// Each submap is meshed by itself: where several hold a place, so many surfaces say something about it.
  kEachSubmap,
  /// The submaps on the map's grid are meshed as one field (see ExtractMapMesh), so that there are no gaps where a
  /// cell's corners are different submaps'. Submaps on grids of their own are meshed by themselves.
  kOneField,
};

/// The surface of a map of submaps, labelled with ids of submaps and their classes (what a map keeps of an object when
/// the labels of voxels are dropped); the unknown submap says neither. An instance's score is its class confidence
/// times its instance confidence.
LabelledSurface SurfaceOf(const Map& map, SurfaceKind kind);

}  // namespace dhpmap::evaluator
