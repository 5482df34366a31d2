// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/map/map.h"
#include "mapping/voxels/tile_marks.h"

namespace dhpmap {

/// One submap of a state: its row, and marks of its blocks. Immutable, shared as TileMarks are.
class SubmapMarks {
 public:
  /// `before` may be null; equal parts are shared with it.
  SubmapMarks(const std::shared_ptr<const Submap>& submap, const SubmapMarks* before);

  /// `before`, with the blocks that `is_in_part` names taken from `part`, which need not have others.
  SubmapMarks(const SubmapMarks& before, const Submap& part, const std::function<bool(BlockIndex)>& is_in_part);

  [[nodiscard]] const SubmapInfo& info() const { return info_; }
  /// Around its blocks.
  [[nodiscard]] const BoundingSphere& sphere_in_map() const { return sphere_in_map_; }
  /// Whether they name exactly this row and these blocks.
  [[nodiscard]] bool IsOf(const std::shared_ptr<const Submap>& submap) const;
  /// In the order of BlockTable::tiles(); reads the list of tiles if necessary.
  [[nodiscard]] std::span<const std::shared_ptr<const TileMarks>> tiles() const { return Table().tiles(); }
  /// Null if the tile was not there. Likewise.
  [[nodiscard]] std::shared_ptr<const TileMarks> FindTile(TileIndex index) const { return Table().Find(index); }
  /// Nothing if the block was not there. Likewise.
  [[nodiscard]] std::optional<BlockMark> Find(BlockIndex index) const;

  /// Whether the tiles are known to be the same because they were not written since loading. Reads nothing.
  [[nodiscard]] bool HaveUnread(const Submap& submap) const;
  /// Whether exactly this tile was there, as far as known without reading: a tile in memory is not part of a table that
  /// was never read.
  [[nodiscard]] bool HaveTile(const TileEntry& tile) const;

 private:
  [[nodiscard]] const TileMarkTable& Table() const { return unread_ == nullptr ? table_ : unread_->Read(); }

  SubmapInfo info_;
  BoundingSphere sphere_in_map_;
  std::uint64_t submap_ = 0;  ///< see PartId; 0 if there was no whole submap object
  TileMarkTable table_;
  std::shared_ptr<const MarkLoader> unread_;  ///< used instead; null: the table is valid
};

/// Detects later changes of a state without keeping the state: only the names (PartId) of its parts stay, about 20
/// bytes a block. Immutable, thread-safe.
class StateMarks {
 public:
  /// Of an empty state: everything counts as written since.
  StateMarks() = default;
  /// With `before`, marks of an earlier state of the map, unchanged parts are shared. With `lacks_left`, the old place
  /// of MapSnapshot::leaving() counts as written since. Implicit, so that a state can be passed for a comparison.
  StateMarks(const MapSnapshot& state, const StateMarks* before = nullptr, bool lacks_left = false);

  /// A state that differs from `before` in the blocks that `is_in_part` names; there it is as `part`, which need not
  /// have others. A submap that is not in `part` no longer exists.
  StateMarks(const StateMarks& before, const MapSnapshot& part, const std::function<bool(BlockIndex)>& is_in_part);

  /// All of the map except its submaps.
  [[nodiscard]] const MapInfo& info() const { return info_; }
  [[nodiscard]] std::int64_t revision() const { return info_.revision; }
  /// Whether the old place of a moved object does not count as part of the state.
  [[nodiscard]] bool lacks_left() const { return lacks_left_; }
  [[nodiscard]] const std::map<SubmapId, std::shared_ptr<const SubmapMarks>>& submaps() const { return submaps_; }
  /// Null if there was no such submap.
  [[nodiscard]] const SubmapMarks* Find(SubmapId id) const;
  /// A submap that another is a copy of, judged by its tiles; null if there is none.
  [[nodiscard]] const SubmapMarks* FindOriginalOf(const Submap& copy) const;
  /// Whether the submap had this block with exactly these layers.
  [[nodiscard]] bool Has(SubmapId submap, const BlockEntry& entry) const;

 private:
  friend FreeSpaceChange DiffFreeSpace(const StateMarks& before, const FreeSpace& after);
  friend FreeSpaceChange DiffVacated(const StateMarks& before, const FreeSpace& after);
  struct FreeTileMark {
    TileIndex index;
    std::weak_ptr<const FreeTile> tile;
  };
  using LayerMarks = std::vector<FreeTileMark>;  ///< by ascending index
  static LayerMarks MarksOf(const FreeSpace& layer);
  static FreeSpaceChange Diff(const LayerMarks& before, const FreeSpace& after);

  MapInfo info_;
  std::map<SubmapId, std::shared_ptr<const SubmapMarks>> submaps_;
  LayerMarks free_space_, vacated_;
  bool lacks_left_ = false;
};

/// Written layers of a tile of a submap.
struct TileChange {
  TileIndex index;
  std::shared_ptr<const BlockTile> after;  ///< null: the tile was removed
  std::array<bool, kNumBlockLayers> is_written{};
  std::array<std::int32_t, kNumBlockLayers> num_before{};  ///< number of blocks that had each layer
  std::array<std::int32_t, kNumBlockLayers> num_after{};
};

/// Written tiles of a submap: the input of a tile store.
struct SubmapTileChange {
  SubmapId id;
  const Submap* after = nullptr;  ///< null: the submap was removed
  bool is_new = false;
  std::optional<SubmapId> copy_of;  ///< of a new submap: its original, against which `tiles` are compared
  std::vector<TileChange> tiles;    ///< tiles with a written layer
};
/// Everything written since the marks were made. Costs some bytes a tile, more only for changes.
std::vector<SubmapTileChange> DiffTiles(const StateMarks& before, const MapSnapshot& after);

FreeSpaceChange DiffFreeSpace(const StateMarks& before, const FreeSpace& after);
FreeSpaceChange DiffVacated(const StateMarks& before, const FreeSpace& after);

}  // namespace dhpmap
