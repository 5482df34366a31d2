// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// A thing of whose surface more is contradicted, and which has settled, is absent.
inline constexpr double kAbsentShare = 0.6;
/// The same of one that nobody has seen since sensors looked through it: what they did not look at goes with the rest.
inline constexpr double kAbsentShareUnseen = 0.25;

/// One that was seen although more than this share of it had been contradicted before was moved, and is where it was
/// seen: of all else, kAbsentShare has to be contradicted.
inline constexpr double kMovedShare = 0.1;

/// Voxels of a submap within a voxel of its surface.
struct SurfaceVoxels {
  std::int64_t all = 0, contradicted = 0;
  /// Of the contradicted, those of blocks against which nothing was counted after the submap was last observed, nor
  /// with it: it was seen all the same, such as where it was moved to.
  std::int64_t settled = 0;
  std::int64_t doubted = 0;  ///< looked through at least twice, the contradicted among them
  /// The same in blocks that were so after the submap was last observed.
  std::int64_t doubted_unseen = 0;
};
SurfaceVoxels CountSurfaceVoxels(const Submap& submap);

/// Says after a frame which things are absent, and which have come back. `observed`: the submaps with a segment in it;
/// `doubted`: those of which voxels were counted as looked through, or which settled. The others stay as they were.
///
/// An absent thing that is seen again is present at once: to wait until it was seen from all around would keep an
/// obstacle out of the answers. If it was matched by its place, all of it is taken to be there again (Submap::DropGone)
/// until it is looked through; if by a persistent id, it may be elsewhere, and what was looked through stays so. What
/// is locked stays as it is.
void UpdatePresence(const PanopticFrame& frame, std::span<const SubmapId> observed, std::span<const SubmapId> doubted,
                    Map& map);

/// The same for all things, when none is seen any longer.
void UpdatePresenceOfAll(Map& map);

}  // namespace dhpmap
