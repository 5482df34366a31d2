// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/evaluator/baselines/panmap_settings.h"
#include "clients/evaluator/baselines/panmap_submap.h"
#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {

/// How the surface of one submap lies in another.
enum class SurfaceRelation { kApart, kMatch, kConflict };

/// Panmap's comparison: each surface point of `a` where `b` is known supports a match if `b`'s distance there is within
/// the tolerance and the place is `b`'s own, and a conflict if `b`'s distance is beyond it. Points weigh by how well
/// both know them.
SurfaceRelation CompareSurfaces(const PanmapSubmap& a, const PanmapSubmap& b, const PanmapSettings& settings);

/// Merges what `from` has into `into`: weighted averages of the geometry, sums of the counts.
void MergeInto(const PanmapSubmap& from, const MapConfig& config, PanmapSubmap& into);

/// Merges the inactive submap `id` with inactive submaps of its class whose surfaces match, as long as there are any.
/// Returns whether there was one; the submap with the smaller id stays.
bool MergeWithInactive(SubmapId id, const MapConfig& config, const PanmapSettings& settings, PanmapSubmaps& submaps);

}  // namespace dhpmap::evaluator
