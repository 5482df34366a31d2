// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Of a map's frames, so many without one of a session and it has nothing in sight any longer.
inline constexpr std::int64_t kMaxSilentFrames = 1000;

/// Updates the life cycle of all things after a frame (paper II-D): observed ones become active, and confirmed once
/// they were re-observed often enough; ones without a segment for several frames become inactive. An unconfirmed thing
/// that was overlooked for as many frames although it should have been seen is dissolved into the unknown submap: its
/// geometry stays, its labels go. `observed`: ids with a segment in this frame. Returns how many were dissolved.
///
/// Frames are counted by session, so that robots do not end what others look at: a thing stays active, and is not
/// dissolved, as long as one session has it in sight. That ends when several frames of this session are without it, or
/// when it has sent none for kMaxSilentFrames. Whose frame overlooked a thing does not matter. What is locked stays,
/// what a person has edited (IsEdited) is not dissolved, and what has its middle in a region that is kept clear is not
/// overlooked: nobody is to see it there.
int UpdateActivity(const PanopticFrame& frame, const std::vector<SubmapId>& observed, Map& map);

/// Merges the geometry of a submap into the unknown submap (weighted average) and removes it. Only for submaps that
/// IsExclusive; returns false for others.
bool DissolveIntoUnknown(SubmapId id, Map& map);

/// Makes every thing inactive that nobody has locked.
void DeactivateAll(Map& map);

}  // namespace dhpmap
