// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/map/free_tile.h"
#include "mapping/query/surface_ledger.h"
#include "mapping/query/triangle_tree.h"

namespace dhpmap {

/// A tile's surface that may be the nearest to points of a cell.
struct NearbyTile {
  const TriangleTree* triangles;
  std::uint32_t number;      ///< of the submap, in MapSurfaces
  std::uint32_t tile;        ///< position in the submap's surface
  float distance_m;          ///< of the tile's surface from the cell's centre
  Eigen::Vector3d corner_m;  ///< of the tile, see SubmapSurface::InTile
  Eigen::AlignedBox3f box;   ///< around the tile's surface, in its frame
};

/// What is nearest to the points of one cell, a block of the map's grid.
struct NearbyCell {
  Eigen::Vector3d centre_m;  ///< map frame
  float complete_m;          ///< every surface that is no farther from the centre is in one of the tiles
  /// Voxels of the map's grid that sensors have looked through, or that are observed in submaps which lie as mapped.
  FreeMask seen;
  bool may_be_seen_elsewise;                        ///< by submaps that lie otherwise
  std::vector<NearbyTile> tiles;                    ///< the nearest first
  mutable std::atomic<std::uint64_t> last_used{0};  ///< by the ledger's clock, or a little before

  [[nodiscard]] std::size_t MemoryBytes() const { return sizeof(*this) + tiles.capacity() * sizeof(NearbyTile); }
};

/// The cells of one state of a map that are asked about, each made once it pays. Thread-safe; nobody waits.
class NearbyCells {
 public:
  /// Cells are of use up to so far from a surface: no less than what queries mostly ask for.
  static constexpr double kReach_m = 3.3;

  /// Around `box_m`, in the map frame; empty: no cell is ever made, nor if the box is beyond all measure. What they
  /// take is added to `bytes` while they are there.
  NearbyCells(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger);
  ~NearbyCells();
  NearbyCells(const NearbyCells&) = delete;
  NearbyCells& operator=(const NearbyCells&) = delete;

  [[nodiscard]] double side_m() const { return side_m_; }
  /// Whether, by the ledger's clock, it is time to say again that what the cell refers to is used.
  [[nodiscard]] bool IsMarkDue(const NearbyCell& cell) const {
    constexpr std::uint64_t kStep = 16;  // what is asked of a map in the meantime makes little difference
    const std::uint64_t now = ledger_->time.load(std::memory_order_relaxed);
    if (now < cell.last_used.load(std::memory_order_relaxed) + kStep) return false;
    cell.last_used.store(now, std::memory_order_relaxed);
    return true;
  }
  /// From a cell's centre to its corners.
  [[nodiscard]] double radius_m() const { return 0.8660254037844387 * side_m_; }

  /// A cell's address, or how often it was asked for.
  using Slot = std::atomic<std::uintptr_t>;
  /// Where the cell at a point (finite) is kept; null: beyond the box.
  [[nodiscard]] Slot* SlotAt(const Eigen::Vector3d& p_map) const;
  /// The cell, or null; then `is_wanted` says whether the asker should make it, having been asked for often enough.
  [[nodiscard]] const NearbyCell* Find(Slot& slot, bool& is_wanted) const;
  /// The centre of the cell at a point of the box, in the map frame, and the block of the map's grid that the cell is.
  [[nodiscard]] Eigen::Vector3d CentreAt(const Eigen::Vector3d& p_map) const;
  [[nodiscard]] BlockIndex BlockAt(const Eigen::Vector3d& p_map) const;
  /// Keeps a cell that was wanted, or the one that somebody else put there meanwhile. Valid as long as this.
  const NearbyCell& Put(Slot& slot, std::unique_ptr<const NearbyCell> cell) const;

 private:
  static constexpr int kGroupSide = 4;  // cells along an axis of a group, which is allocated as one
  using Group = std::array<Slot, std::size_t{kGroupSide} * kGroupSide * kGroupSide>;
  static constexpr std::uintptr_t kEnough = 3;  // times asked for: then to make it costs no more than was spent

  double voxel_size_m_;
  double side_m_;
  Eigen::Array3i first_ = Eigen::Array3i::Zero();  ///< block
  Eigen::Array3i num_groups_ = Eigen::Array3i::Zero();
  const std::shared_ptr<SurfaceLedger> ledger_;
  mutable std::vector<std::atomic<Group*>> groups_;
  mutable std::atomic<std::size_t> own_bytes_{0};
};

}  // namespace dhpmap
