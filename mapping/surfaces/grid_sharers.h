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

  /// `before`: of an earlier state of the map, though that be gone; null: there is none. With it costs a look at each
  /// submap, one at each tile of those that are others than they were, and, where any of these changed, a copy of some
  /// bytes a tile.
  GridSharers(const MapSnapshot& state, const GridSharers* before);

  [[nodiscard]] static bool Takes(const MapSnapshot& state, const Submap& submap);
  /// Null where nobody has anything.
  [[nodiscard]] const std::shared_ptr<const Around>& AroundOf(TileIndex tile) const;
  /// The others around a tile of a submap.
  [[nodiscard]] std::vector<TilePlace::Sharer> SharersOf(SubmapId submap, TileIndex tile) const;
  /// Whether another one knows of the same submaps with the same tiles: then all around is alike, too.
  [[nodiscard]] bool IsSameAs(const GridSharers& other) const { return tiles_ == other.tiles_; }

 private:
  struct TilePart {
    TileIndex tile;
    std::uint64_t part_id = 0;
    bool operator==(const TilePart&) const = default;
  };
  /// A submap that takes part, and its tiles by ascending index.
  struct Sharing {
    SubmapId id;
    std::weak_ptr<const Submap> submap;  ///< tells it from all others, though it be gone
    std::shared_ptr<const std::vector<TilePart>> parts;
  };
  struct Tile {
    TileIndex index;
    std::shared_ptr<const std::vector<Around::Holder>> here;  ///< by submap; their `where` does not count
    std::shared_ptr<const Around> around;
  };
  struct Tiles {
    std::vector<Tile> tiles;      ///< those that nobody has anything in any longer are left empty
    IndexMap<TileIndex> numbers;  ///< position in tiles
    [[nodiscard]] const Tile* Find(TileIndex tile) const {
      const std::uint32_t number = numbers.Find(tile);
      return number == IndexMap<TileIndex>::kNone ? nullptr : &tiles[number];
    }
  };
  /// What of a tile is another's, or no longer there.
  struct Change {
    TileIndex tile;
    SubmapId submap;
    std::uint64_t part_id = 0;  ///< 0: it has nothing there any longer
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
