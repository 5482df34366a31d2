// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/geometry/box_tree.h"
#include "mapping/submap/submap.h"
#include "mapping/surfaces/grid_sharers.h"
#include "mapping/surfaces/tile_surface_slot.h"

namespace dhpmap {

/// The zero surface of a submap in its own frame, by tile (see ExtractTileSurface). The surface of a tile is computed
/// at its first use. Holds no voxels: callers pass the submap. Thread-safe.
class SubmapSurface {
 public:
  using Slots = std::vector<std::shared_ptr<const TileSurfaceSlot>>;
  using SlotSource = std::function<Slots(std::span<const TilePlace>)>;

  /// Costs a look at each tile; `slots_of` returns their slots. `grid`: the submaps that share the map's grid; null:
  /// the grid is not shared. `known`: an earlier surface of the same submap, beside other submaps; slots of tiles whose
  /// neighbours have not changed are reused. Null: there is none.
  SubmapSurface(const Submap& submap, const GridSharers* grid, const SubmapSurface* known, const SlotSource& slots_of);

  ~SubmapSurface() { delete surface_box_.load(); }
  SubmapSurface(const SubmapSurface&) = delete;
  SubmapSurface& operator=(const SubmapSurface&) = delete;

  /// Whether this is the surface of `submap` beside the submaps that share the grid now.
  [[nodiscard]] bool IsOf(const Submap& submap, const GridSharers* grid) const;

  /// Whether another one has the same surfaces in the same order, and stays valid as long as this.
  [[nodiscard]] bool IsSameAs(const SubmapSurface& other) const;
  /// By position here, the position in `other`; kElsewhere: `other` does not have this surface.
  [[nodiscard]] std::vector<std::uint32_t> PositionsIn(const SubmapSurface& other) const;
  static constexpr std::uint32_t kElsewhere = 0xFFFFFFFFu;

  /// Null: there is none.
  [[nodiscard]] std::shared_ptr<const TileSurfaceSlot> SlotAt(TileIndex tile) const;

  /// Around the surface, to within about a block. Empty: there is none.
  [[nodiscard]] const Eigen::AlignedBox3d& box_m() const { return box_m_; }

  /// Of the tiles' boxes, to within about a block.
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  /// Transforms a point from the submap's frame to that of the tree.
  [[nodiscard]] Eigen::Vector3f InTree(const Eigen::Vector3d& p_submap) const {
    return (p_submap - origin_m_).cast<float>();
  }

  /// Positions in it are below this.
  [[nodiscard]] std::size_t num_tiles() const { return tiles_.size(); }
  /// The surface of the tile at a position in the tree, computed if necessary. `submap` is the submap of this surface,
  /// at any pose, or a clone; `state` has it and the submaps that share its grid. Valid as long as this.
  [[nodiscard]] const TriangleTree& Surface(const MapSnapshot& state, const Submap& submap,
                                            std::size_t position) const {
    return tiles_[position].slot->Surface(state, submap, tiles_[position].index);
  }
  /// Computes the surfaces of tiles that were used, in this state or an earlier one, since a time by the ledger's
  /// clock. Ends soon after a `stop` request.
  void PrepareUsedSince(std::uint64_t time, const MapSnapshot& state, const Submap& submap,
                        const std::stop_token& stop) const;
  /// Marks the existing surface of a tile as used, for callers that do not call Surface.
  void MarkUsed(std::size_t position) const { tiles_[position].slot->MarkUsed(); }
  /// Origin of the frame of a tile's surface, in the submap's frame.
  [[nodiscard]] const Eigen::Vector3d& Corner(std::size_t position) const { return tiles_[position].corner_m; }
  /// Transform a point from the submap's frame to that of a tile's surface, and back.
  [[nodiscard]] Eigen::Vector3d InTileExactly(const Eigen::Vector3d& p_submap, std::size_t position) const {
    return p_submap - Corner(position);
  }
  [[nodiscard]] Eigen::Vector3f InTile(const Eigen::Vector3d& p_submap, std::size_t position) const {
    return InTileExactly(p_submap, position).cast<float>();
  }
  [[nodiscard]] Eigen::Vector3d FromTile(const Eigen::Vector3f& p_tile, std::size_t position) const {
    return tiles_[position].corner_m + p_tile.cast<double>();
  }

  /// Around the whole surface, to within a few micrometres, in the submap's frame; empty: there is none. Its first call
  /// computes all missing tiles. `state` and `submap` as for Surface.
  [[nodiscard]] const Eigen::AlignedBox3d& BoxOfSurface(const MapSnapshot& state, const Submap& submap) const;

  /// Appends boxes, in the submap's frame, around the surfaces of the tiles that `other` does not have; null: of all
  /// tiles. Tight for surfaces that are already computed.
  void AppendBoxes(const SubmapSurface* other, std::vector<Eigen::AlignedBox3d>& boxes_m) const;

  /// Calls visit(const TileSurfaceSlot&) for every tile.
  template <typename Visitor>
  void ForEachSlot(Visitor&& visit) const {
    for (const Tile& tile : tiles_) visit(*tile.slot);
  }

 private:
  struct Tile {
    TileIndex index;
    Eigen::Vector3d corner_m;
    Eigen::AlignedBox3d box_m;
    std::shared_ptr<const TileSurfaceSlot> slot;
    std::shared_ptr<const GridSharers::Around> around;  ///< null: the grid is not shared
  };

  /// Null: there is none.
  [[nodiscard]] const Tile* Find(TileIndex tile) const;
  /// Whether the other submaps around a tile are unchanged.
  [[nodiscard]] static bool IsAlike(const Tile& tile, const Submap& submap, const GridSharers* grid);

  Eigen::AlignedBox3d box_m_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();  ///< of the tree; its floats are precise only near here
  BoxTree tree_;                                        ///< of the tiles' boxes
  std::vector<Tile> tiles_;                             ///< in the order of the tree
  std::vector<std::uint32_t> by_index_;                 ///< their positions, by ascending index
  mutable std::atomic<const Eigen::AlignedBox3d*> surface_box_{nullptr};  ///< owned; null: not computed yet
};

}  // namespace dhpmap
