// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/evaluator/baselines/panmap_settings.h"
#include "clients/evaluator/baselines/panmap_submap.h"
#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {

/// How the surface of one submap lies in another.
enum class SurfaceRelation { kApart, kMatch, kConflict };

/// Panmap's comparison: a surface point of `a` where `b` is known and has its own place supports a match if it is
/// within the tolerance of `b`'s surface, and a conflict if it lies farther behind it. In front of it, `b` may just not
/// have seen `a`'s part. Points weigh by how well both know them.
SurfaceRelation CompareSurfaces(const PanmapSubmap& a, const PanmapSubmap& b, const PanmapSettings& settings);

/// Merges what `from` has into `into`: weighted averages of the geometry, sums of the counts.
void MergeInto(const PanmapSubmap& from, const MapConfig& config, PanmapSubmap& into);

/// Merges the inactive submap `id` with inactive submaps of its class whose surfaces match, as long as there are any.
/// Returns whether there was one; the submap with the smaller id stays.
bool MergeWithInactive(SubmapId id, const MapConfig& config, const PanmapSettings& settings, PanmapSubmaps& submaps);

}  // namespace dhpmap::evaluator
