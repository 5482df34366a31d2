// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/query/cell_sight.h"
#include "mapping/query/cell_slots.h"
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

/// What is nearest to the points of one cell.
struct NearbyCell {
  Eigen::Vector3d centre_m;  ///< map frame
  float complete_m;          ///< every surface that is no farther from the centre is in one of the tiles
  CellSight sight;
  std::vector<NearbyTile> tiles;                    ///< the nearest first
  mutable std::atomic<std::uint64_t> last_used{0};  ///< by the ledger's clock, or a little before

  [[nodiscard]] std::size_t MemoryBytes() const {
    return sizeof(*this) + tiles.capacity() * sizeof(NearbyTile) + sight.others.capacity() * sizeof(sight.others[0]);
  }
};

/// The cells of one state of a map that are asked about, each made once it pays. Thread-safe; nobody waits.
class NearbyCells : public CellGrid<NearbyCell> {
 public:
  NearbyCells(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger)
      : CellGrid(box_m, voxel_size_m, std::move(ledger), kEnough) {}

  /// Whether, by the ledger's clock, it is time to say again that what the cell refers to is used.
  [[nodiscard]] bool IsMarkDue(const NearbyCell& cell) const {
    constexpr std::uint64_t kStep = 16;  // what is asked of a map in the meantime makes little difference
    const std::uint64_t now = ledger().time.load(std::memory_order_relaxed);
    if (now < cell.last_used.load(std::memory_order_relaxed) + kStep) return false;
    cell.last_used.store(now, std::memory_order_relaxed);
    return true;
  }

 private:
  static constexpr std::uintptr_t kEnough = 3;  // times asked for: then to make it costs no more than was spent
};

}  // namespace dhpmap
