// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// An inactive thing is absent if more than this share of its surface is contradicted.
inline constexpr double kAbsentShare = 0.6;
/// The same for a thing that was not seen since sensors looked through it: the rest of it is assumed gone, too.
inline constexpr double kAbsentShareUnseen = 0.25;

/// A thing that was seen although more than this share had been contradicted before has moved to where it was seen.
/// kAbsentShare then applies to the remaining surface.
inline constexpr double kMovedShare = 0.1;

/// Voxels of a submap within a voxel of its surface.
struct SurfaceVoxels {
  std::int64_t all = 0, contradicted = 0;
  /// Contradicted voxels of blocks without any count after or at the last observation of the submap: the thing was seen
  /// nevertheless, such as where it was moved to.
  std::int64_t settled = 0;
  std::int64_t doubted = 0;  ///< looked through at least twice, including contradicted ones
  /// The same, in blocks counted after the last observation of the submap.
  std::int64_t doubted_unseen = 0;
};
SurfaceVoxels CountSurfaceVoxels(const Submap& submap);

/// Updates which things are absent after a frame. `observed`: submaps with a segment in it; `doubted`: submaps with
/// newly counted voxels, or that became inactive. Others do not change.
///
/// An absent thing that is seen again is present at once: waiting for more views would hide an obstacle from answers.
/// If it was matched by place, all of it counts as present (Submap::DropGone) until it is looked through again. If it
/// was matched by a persistent id, it may be elsewhere, and its gone counts stay. Locked things do not change.
void UpdatePresence(const PanopticFrame& frame, std::span<const SubmapId> observed, std::span<const SubmapId> doubted,
                    Map& map);

/// The same for all things, once none is in sight.
void UpdatePresenceOfAll(Map& map);

}  // namespace dhpmap
