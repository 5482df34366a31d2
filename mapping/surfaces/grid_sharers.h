// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/map/map.h"
#include "mapping/surfaces/tile_surface_slot.h"

namespace dhpmap {

/// The submaps of a state that share the map's grid (IsExclusive) and are not absent, tile by tile. The surface of each
/// also depends on the voxels of the others. Refers to the state. Immutable, thread-safe.
class GridSharers {
 public:
  /// The submaps with tiles among the 27 tiles around and including one.
  struct Around {
    struct Holder {
      std::uint32_t where = 0;  ///< of the 27, x fastest
      SubmapId submap;
      std::uint64_t part_id = 0;  ///< of its tile there
      bool operator==(const Holder&) const = default;
    };
    std::vector<Holder> holders;  ///< by where and submap

    /// Whether both have the same holders, except the submap itself.
    [[nodiscard]] bool IsAlikeFor(SubmapId submap, const Around& other) const;
  };

  /// `before`: of an earlier state of the map, which need not exist any more; null: there is none. With `before` the
  /// cost is a look at each submap and at each tile of the changed submaps; if tiles have changed, also a copy of some
  /// bytes per tile.
  GridSharers(const MapSnapshot& state, const GridSharers* before);

  [[nodiscard]] static bool Takes(const MapSnapshot& state, const Submap& submap);
  /// Null: no submap has a tile there.
  [[nodiscard]] const std::shared_ptr<const Around>& AroundOf(TileIndex tile) const;
  /// The others around a tile of a submap.
  [[nodiscard]] std::vector<TilePlace::Sharer> SharersOf(SubmapId submap, TileIndex tile) const;
  /// Whether both have the same submaps with the same tiles, and so the same neighbourhoods.
  [[nodiscard]] bool IsSameAs(const GridSharers& other) const { return tiles_ == other.tiles_; }

 private:
  struct TilePart {
    TileIndex tile;
    std::uint64_t part_id = 0;
    bool operator==(const TilePart&) const = default;
  };
  /// A submap on the grid, and its tiles by ascending index.
  struct Sharing {
    SubmapId id;
    std::weak_ptr<const Submap> submap;  ///< identifies it, even after its end
    std::shared_ptr<const std::vector<TilePart>> parts;
  };
  struct Tile {
    TileIndex index;
    std::shared_ptr<const std::vector<Around::Holder>> here;  ///< by submap; their `where` does not count
    std::shared_ptr<const Around> around;
  };
  struct Tiles {
    std::vector<Tile> tiles;      ///< tiles without holders stay as empty entries
    IndexMap<TileIndex> numbers;  ///< position in tiles
    [[nodiscard]] const Tile* Find(TileIndex tile) const {
      const std::uint32_t number = numbers.Find(tile);
      return number == IndexMap<TileIndex>::kNone ? nullptr : &tiles[number];
    }
  };
  /// A submap's changed or removed tile.
  struct Change {
    TileIndex tile;
    SubmapId submap;
    std::uint64_t part_id = 0;  ///< 0: it was removed
  };
  static std::vector<TilePart> PartsOf(const Submap& submap);
  static void AddChanges(SubmapId id, const std::vector<TilePart>& then, const std::vector<TilePart>& now,
                         std::vector<Change>& changes);
  std::vector<Change> TakeSubmaps(const GridSharers* before);
  static void Apply(std::vector<Change> changes, Tiles& tiles);
  static Around MakeAround(const Tiles& tiles, TileIndex tile);

  const MapSnapshot& state_;
  std::vector<Sharing> submaps_;  ///< by ascending id
  std::shared_ptr<const Tiles> tiles_;
};

}  // namespace dhpmap
