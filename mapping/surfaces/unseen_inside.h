// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/ids.h"
#include "mapping/base/transform.h"
#include "mapping/free/free_tile.h"

namespace dhpmap {

class SubmapSurface;

/// Which voxels of a block that nobody has seen are inside of something all the same, to who takes all of the map
/// (QueryWorld::TakesAllAsItIs). Kept with what is near to the block (NearbyCell): as long as that is the same, and
/// what may be inside of things there, so is this. Immutable.
struct UnseenInside {
  /// A thing of which some of the block may be the inside.
  struct Thing {
    SubmapId id;
    Transform T_submap_map;
    std::weak_ptr<const SubmapSurface> surface;
  };
  /// Voxels, by ascending linear index, up to `end`.
  struct Run {
    std::uint16_t end;
    SubmapId whose;  ///< the nearest surface is
  };
  double max_distance_m = 0;  ///< so far behind a surface at most
  FreeMask asked{}, inside{};
  std::vector<Run> whose;  ///< of the voxels inside
  std::vector<Thing> things;

  /// Whose surface is nearest to a voxel inside.
  [[nodiscard]] SubmapId WhoseAt(int linear) const;
  /// Whether it tells of all of these voxels.
  [[nodiscard]] bool TellsOf(const FreeMask& unseen, double distance_m) const;
  [[nodiscard]] std::size_t MemoryBytes() const {
    return sizeof(*this) + whose.capacity() * sizeof(Run) + things.capacity() * sizeof(Thing);
  }
};

/// Whether those are the same things with the same surfaces at the same places.
bool AreSame(std::span<const UnseenInside::Thing> then, std::span<const UnseenInside::Thing> now);

}  // namespace dhpmap
