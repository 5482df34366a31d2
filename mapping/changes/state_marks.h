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
  /// `before` may be null; what is the same is shared with it.
  SubmapMarks(const std::shared_ptr<const Submap>& submap, const SubmapMarks* before);

  /// Of `before`, with the blocks that `is_in_part` names as they are in `part`, which need not have any others.
  SubmapMarks(const SubmapMarks& before, const Submap& part, const std::function<bool(BlockIndex)>& is_in_part);

  [[nodiscard]] const SubmapInfo& info() const { return info_; }
  /// Around its blocks.
  [[nodiscard]] const BoundingSphere& sphere_in_map() const { return sphere_in_map_; }
  /// Whether it is this very row, with these very blocks.
  [[nodiscard]] bool IsOf(const std::shared_ptr<const Submap>& submap) const;
  /// In the order of BlockTable::tiles(); reads which there are if nobody has.
  [[nodiscard]] std::span<const std::shared_ptr<const TileMarks>> tiles() const { return Table().tiles(); }
  /// Null if the tile was not there. Likewise.
  [[nodiscard]] std::shared_ptr<const TileMarks> FindTile(TileIndex index) const { return Table().Find(index); }
  /// Nothing if the block was not there. Likewise.
  [[nodiscard]] std::optional<BlockMark> Find(BlockIndex index) const;

  /// Whether they are known to be the same tiles without a look at them: nobody has written to them since they were
  /// loaded. Reads nothing.
  [[nodiscard]] bool HaveUnread(const Submap& submap) const;
  /// Whether this very tile was there, as far as that is known without reading anything: somebody has the tile, so
  /// where it is of a table that nobody has read it is no part of it.
  [[nodiscard]] bool HaveTile(const TileEntry& tile) const;

 private:
  [[nodiscard]] const TileMarkTable& Table() const { return unread_ == nullptr ? table_ : unread_->Read(); }

  SubmapInfo info_;
  BoundingSphere sphere_in_map_;
  std::uint64_t submap_ = 0;  ///< see PartId; 0: of none that there was as a whole
  TileMarkTable table_;
  std::shared_ptr<const MarkLoader> unread_;  ///< instead; null: the table is right
};

/// Tells later what of a state was written since, without keeping the state: parts are told apart by their identity,
/// and only their names stay, some 20 bytes a block. Immutable, thread-safe.
class StateMarks {
 public:
  /// Of nothing: everything was written since.
  StateMarks() = default;
  /// With `before`, marks of an earlier state of the map, what was not written since then is shared with them instead
  /// of being marked anew. With `lacks_left` what MapSnapshot::leaving() has left counts as written since. Converts:
  /// who only compares with a state can be given the state.
  StateMarks(const MapSnapshot& state, const StateMarks* before = nullptr, bool lacks_left = false);

  /// Of a state that differs from that of `before` in the blocks of submaps that `is_in_part` names, where it is as
  /// `part`, which need not have any others. A submap that is not in `part` is no longer there.
  StateMarks(const StateMarks& before, const MapSnapshot& part, const std::function<bool(BlockIndex)>& is_in_part);

  /// All of the map but its submaps.
  [[nodiscard]] const MapInfo& info() const { return info_; }
  [[nodiscard]] std::int64_t revision() const { return info_.revision; }
  /// Whether the state has left something that does not count as its own.
  [[nodiscard]] bool lacks_left() const { return lacks_left_; }
  [[nodiscard]] const std::map<SubmapId, std::shared_ptr<const SubmapMarks>>& submaps() const { return submaps_; }
  /// Null if there was no such submap.
  [[nodiscard]] const SubmapMarks* Find(SubmapId id) const;
  /// A submap of which another is a copy, as far as its tiles tell; null if there is none.
  [[nodiscard]] const SubmapMarks* FindOriginalOf(const Submap& copy) const;
  /// Whether the submap had this block, with these very layers.
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

/// What was written of a tile of a submap, by layer.
struct TileChange {
  TileIndex index;
  std::shared_ptr<const BlockTile> after;  ///< null: the tile is no longer there
  std::array<bool, kNumBlockLayers> is_written{};
  std::array<std::int32_t, kNumBlockLayers> num_before{};  ///< blocks that had each layer
  std::array<std::int32_t, kNumBlockLayers> num_after{};
};

/// What was written of a submap, tile by tile: what a store of tiles works from.
struct SubmapTileChange {
  SubmapId id;
  const Submap* after = nullptr;  ///< null: the submap was removed
  bool is_new = false;
  std::optional<SubmapId> copy_of;  ///< of one that is new: what it was cloned from, which `tiles` compare it with
  std::vector<TileChange> tiles;    ///< those of which some layer was written
};
/// What was written since the marks were made. Costs some bytes a tile, and more only for what was.
std::vector<SubmapTileChange> DiffTiles(const StateMarks& before, const MapSnapshot& after);

FreeSpaceChange DiffFreeSpace(const StateMarks& before, const FreeSpace& after);
FreeSpaceChange DiffVacated(const StateMarks& before, const FreeSpace& after);

}  // namespace dhpmap
