// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "mapping/map/submap.h"
#include "mapping/query/box_tree.h"
#include "mapping/query/tile_surface_slot.h"

namespace dhpmap {

/// The zero surface of a submap in its own frame, by tile (see ExtractTileSurface); tiles that nobody has asked about
/// are not made. Holds no voxels: whoever asks has the submap. Thread-safe.
class SubmapSurface {
 public:
  using SlotSource = std::function<std::shared_ptr<const TileSurfaceSlot>(const TileNeighbourhood&, TileIndex)>;

  /// Takes a look at each tile; `slot_of` gives the slots.
  SubmapSurface(const Submap& submap, const SlotSource& slot_of);

  /// Around the surface, to a block or so. Empty: there is none.
  [[nodiscard]] const Eigen::AlignedBox3d& box_m() const { return box_m_; }

  /// A surface point of the submap: `found` is in the frame of the tile, whose corner is at `corner_m`.
  struct Nearest {
    NearestSurface found;
    Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  };
  /// Looks for a point nearer to `p_submap` (finite) than `best`. Returns whether `best` has changed. `submap` is the
  /// one this was made of, at whatever pose, or a clone.
  bool ImproveNearest(const Submap& submap, const Eigen::Vector3d& p_submap, Nearest& best) const;

  /// Calls visit(const TileSurfaceSlot&) for every tile.
  template <typename Visitor>
  void ForEachSlot(Visitor&& visit) const {
    for (const Tile& tile : tiles_) visit(*tile.slot);
  }

 private:
  struct Tile {
    TileIndex index;
    Eigen::Vector3d corner_m;
    std::shared_ptr<const TileSurfaceSlot> slot;
  };

  Eigen::AlignedBox3d box_m_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();  ///< of the tree, whose floats would not do far from here
  BoxTree tree_;                                        ///< of the tiles' boxes
  std::vector<Tile> tiles_;                             ///< in the order of the tree
};

}  // namespace dhpmap
