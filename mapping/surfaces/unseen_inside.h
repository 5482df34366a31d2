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

/// The unseen voxels of a block that are inside an object, for queries of the whole map (QueryWorld::TakesAllAsItIs).
/// Stored with the surfaces near the block (NearbyCell). Valid as long as those surfaces, and the things that may
/// contain voxels of the block, are the same. Immutable.
struct UnseenInside {
  /// A thing that may contain voxels of the block.
  struct Thing {
    SubmapId id;
    Transform T_submap_map;
    std::weak_ptr<const SubmapSurface> surface;
  };
  /// Voxels, by ascending linear index, up to `end`.
  struct Run {
    std::uint16_t end;
    SubmapId whose;  ///< owner of the nearest surface
  };
  double max_distance_m = 0;  ///< the largest depth behind a surface that counts as inside
  FreeMask asked{}, inside{};
  std::vector<Run> whose;  ///< owners of the voxels inside
  std::vector<Thing> things;

  /// The owner of the surface that is nearest to a voxel inside.
  [[nodiscard]] SubmapId WhoseAt(int linear) const;
  /// Whether this covers all voxels of `unseen` up to `distance_m`.
  [[nodiscard]] bool TellsOf(const FreeMask& unseen, double distance_m) const;
  [[nodiscard]] std::size_t MemoryBytes() const {
    return sizeof(*this) + whose.capacity() * sizeof(Run) + things.capacity() * sizeof(Thing);
  }
};

/// Whether both are the same things with the same surfaces at the same poses.
bool AreSame(std::span<const UnseenInside::Thing> then, std::span<const UnseenInside::Thing> now);

}  // namespace dhpmap
