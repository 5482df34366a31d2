// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

/// Of the surface of a part that stands apart from the rest of its thing, a greater share that was looked through at
/// least twice means that the part has left. What is observed again begins at 0, so a part that is seen has no such.
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

/// All of them, by their least block. Reads all of the submap.
std::vector<SurfacePart> FindSurfaceParts(const Submap& submap);

/// What was moved is seen where it is now, and was looked through where it was. So of a thing in several parts, those
/// that are leaving are contradicted as a whole, with what sensors did not look at. If all of them are, or there is
/// only one, nothing changes: whether the thing is absent is for UpdatePresence to say. Returns the other parts.
std::vector<SurfacePart> LetPartsLeave(SubmapId id, Map& map);

}  // namespace dhpmap
