// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mapping/surfaces/distance_fields.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// The cached distance field of the cell at a point, which owns that slot; computed if it pays or another state has it.
/// Null: none, or not yet. Valid as long as the surfaces. Thread-safe.
[[nodiscard]] const FieldCell* FindFieldCell(const MapSurfaces& surfaces, DistanceFields::Slot& slot,
                                             const Eigen::Vector3d& p_map);

}  // namespace dhpmap
