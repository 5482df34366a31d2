// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// A separate part of a thing has left if more than this share of its surface was looked through at least twice. A new
/// observation resets the count, so a part that is still seen has no such voxels.
inline constexpr double kLeavingShare = 0.4;

/// Blocks of a submap that hold a part of its surface and touch each other.
struct SurfacePart {
  std::vector<BlockIndex> blocks;  ///< ascending
  std::int64_t num_voxels = 0;     ///< within a voxel of the surface
  std::int64_t num_doubted = 0;    ///< of these, looked through at least twice

  [[nodiscard]] bool IsLeaving() const {
    return static_cast<double>(num_doubted) > kLeavingShare * static_cast<double>(num_voxels);
  }
};

/// All parts, by their smallest block. Reads the whole submap.
std::vector<SurfacePart> FindSurfaceParts(const Submap& submap);

/// Removes the old place of a thing that has moved in the world: it is seen at its new place, and sensors look through
/// the old one. If a thing has several parts, every part that IsLeaving is contradicted as a whole, including surface
/// that no sensor has looked through. If all parts are leaving, or there is only one, nothing changes: UpdatePresence
/// decides whether the thing is absent. Returns the remaining parts.
std::vector<SurfacePart> LetPartsLeave(SubmapId id, Map& map);

}  // namespace dhpmap
