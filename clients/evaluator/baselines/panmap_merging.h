// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/evaluator/baselines/panmap_settings.h"
#include "clients/evaluator/baselines/panmap_submap.h"
#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {

/// Relation of one submap's surface to another's.
enum class SurfaceRelation { kApart, kMatch, kConflict };

/// Panmap's comparison. A surface point of `a` counts where `b` is observed and owns the place: as a match within the
/// tolerance of `b`'s surface, as a conflict if it lies farther behind it. In front of it, `b` may just not have seen
/// that part of `a`. Points are weighted by the weights of both submaps.
SurfaceRelation CompareSurfaces(const PanmapSubmap& a, const PanmapSubmap& b, const PanmapSettings& settings);

/// Merges `from` into `into`: weighted averages of the geometry, sums of the counts.
void MergeInto(const PanmapSubmap& from, const MapConfig& config, PanmapSubmap& into);

/// Merges the inactive submap `id` with inactive submaps of its class whose surfaces match, until none is left. Returns
/// whether it merged any; the submap with the smaller id remains.
bool MergeWithInactive(SubmapId id, const MapConfig& config, const PanmapSettings& settings, PanmapSubmaps& submaps);

}  // namespace dhpmap::evaluator
