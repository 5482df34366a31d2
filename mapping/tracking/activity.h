// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// After this many frames of the map without one of a session, that session has nothing in sight.
inline constexpr std::int64_t kMaxSilentFrames = 1000;

/// Updates the life cycle of all things after a frame (paper II-D). Observed things become active, and confirmed after
/// enough observations. Things without a segment for several frames become inactive. An unconfirmed thing that was
/// overlooked for as many frames, although it should have been visible, is dissolved into the unknown submap: its
/// geometry stays, its labels are dropped. `observed`: ids with a segment in this frame. Returns how many were
/// dissolved.
///
/// Sessions count frames separately, so that one robot does not deactivate things in another's view: a thing stays
/// active, and is not dissolved, while one session has it in sight. A session loses sight of it after several of its
/// own frames without it, or after kMaxSilentFrames without any. Overlooking counts for frames of any session. Locked
/// things do not change, edited things (IsEdited) are not dissolved, and things with their middle in an ignored region
/// are never overlooked, because frames have no points there.
int UpdateActivity(const PanopticFrame& frame, const std::vector<SubmapId>& observed, Map& map);

/// Merges the geometry of a submap into the unknown submap (weighted average) and removes it. Only for submaps that
/// IsExclusive; returns false for others.
bool DissolveIntoUnknown(SubmapId id, Map& map);

/// Makes every thing inactive that is not locked.
void DeactivateAll(Map& map);

}  // namespace dhpmap
