// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/map/map.h"
#include "mapping/query/tile_surface_slot.h"

namespace dhpmap {

/// Which submaps of a state share the map's grid (IsExclusive) and are not absent, tile by tile: what their surfaces
/// depend on beside their own voxels. Refers to the state. Immutable, thread-safe.
class GridSharers {
 public:
  /// Who has something in the 27 tiles around one, and itself.
  struct Around {
    struct Holder {
      std::uint32_t where = 0;  ///< of the 27, x fastest
      SubmapId submap;
      std::uint64_t part_id = 0;  ///< of its tile there
      bool operator==(const Holder&) const = default;
    };
    std::vector<Holder> holders;  ///< by where and submap

    /// Whether all but the submap itself are the same in another.
    [[nodiscard]] bool IsAlikeFor(SubmapId submap, const Around& other) const;
  };

  /// Costs little more than a look at each tile. What is the same in an earlier state of the map, though that be gone,
  /// is shared with `before`; null: there is none.
  GridSharers(const MapSnapshot& state, const GridSharers* before);

  [[nodiscard]] static bool Takes(const MapSnapshot& state, const Submap& submap);
  /// Null where nobody has anything.
  [[nodiscard]] const std::shared_ptr<const Around>& AroundOf(TileIndex tile) const;
  /// The others around a tile of a submap.
  [[nodiscard]] std::vector<TilePlace::Sharer> SharersOf(SubmapId submap, TileIndex tile) const;

 private:
  struct Tile {
    TileIndex index;
    std::vector<Around::Holder> here;  ///< their `where` does not count
    std::shared_ptr<const Around> around;
  };
  [[nodiscard]] const Tile* Find(TileIndex tile) const {
    const std::uint32_t number = numbers_.Find(tile);
    return number == IndexMap<TileIndex>::kNone ? nullptr : &tiles_[number];
  }
  [[nodiscard]] Around MakeAround(TileIndex tile) const;

  const MapSnapshot& state_;
  std::vector<Tile> tiles_;
  IndexMap<TileIndex> numbers_;  ///< position in tiles_
};

}  // namespace dhpmap
