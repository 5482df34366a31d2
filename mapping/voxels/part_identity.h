// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/voxels/block_tile.h"

namespace dhpmap {

// Parts of states are compared by name (PartId), not by content.

// See PartId; 0 where there is no part.
inline std::uint64_t PartIdOf(const BlockTile* tile) { return tile != nullptr ? tile->part_id() : 0; }
template <typename Layer>
std::uint64_t PartIdOf(const Layer* layer) {
  return layer != nullptr ? layer->part_id.value() : 0;
}
inline std::uint64_t PartIdOf(std::uint64_t name) { return name; }
template <typename Part>
std::uint64_t PartIdOf(const std::shared_ptr<const Part>& part) {
  return PartIdOf(part.get());
}

/// Each is a part, or the name of one.
template <typename Old, typename Now>
bool IsSamePart(const Old& old, const Now& now) {
  return PartIdOf(old) == PartIdOf(now);
}

/// Keeps a name alive by a pointer: no other object gets it meanwhile.
template <typename Part>
bool IsSameObject(const std::weak_ptr<const Part>& old, const std::shared_ptr<const Part>& now) {
  return !old.owner_before(now) && !now.owner_before(old);
}

/// Whether there was a part at all; it need not be alive.
template <typename Part>
bool WasThere(const Part& old) {
  return PartIdOf(old) != 0;
}

}  // namespace dhpmap
