// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/geometry/triangle_tree.h"
#include "mapping/surfaces/cell_sight.h"
#include "mapping/surfaces/cell_slots.h"
#include "mapping/surfaces/unseen_inside.h"

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

/// The surfaces that may be the nearest to points of one cell.
struct NearbyCell {
  Eigen::Vector3d centre_m;  ///< map frame
  float complete_m;          ///< every surface up to this distance from the centre is in one of the tiles
  CellSight sight;
  std::vector<NearbyTile> tiles;                    ///< the nearest first
  mutable std::atomic<std::uint64_t> last_used{0};  ///< by the ledger's clock, or a little earlier
  /// Owned; constant once computed. Null: not computed yet.
  mutable std::atomic<const UnseenInside*> unseen_inside{nullptr};

  NearbyCell() = default;
  ~NearbyCell() { delete unseen_inside.load(); }
  NearbyCell(const NearbyCell&) = delete;
  NearbyCell& operator=(const NearbyCell&) = delete;

  [[nodiscard]] std::size_t MemoryBytes() const {
    const UnseenInside* unseen = unseen_inside.load();
    return sizeof(*this) + tiles.capacity() * sizeof(NearbyTile) + sight.others.capacity() * sizeof(sight.others[0]) +
           (unseen == nullptr ? 0 : unseen->MemoryBytes());
  }
};

/// Access to the observations of a state of a map in a block of its grid (LookOf).
struct StateLook {
  std::function<CellSight(BlockIndex)> sight;
  std::function<std::vector<UnseenInside::Thing>(BlockIndex)> things;  ///< ThingsAround
};

/// The cached cells of one state of a map. A cell is computed once it has been requested often enough to pay off.
/// Thread-safe; lookups do not wait.
class NearbyCells : public CellGrid<NearbyCell> {
 public:
  /// The cells of the previous state, and how their submaps and tiles correspond to those of this state.
  struct Earlier {
    static constexpr std::uint32_t kGone = 0xFFFFFFFFu;
    struct Part {
      std::uint32_t number = kGone;      ///< present number of the submap; kGone: it was removed or moved
      bool is_same = false;              ///< all tiles have the same positions
      std::vector<std::uint32_t> tiles;  ///< else by earlier position the present one; kGone: another surface, or none
    };
    std::shared_ptr<const NearbyCells> cells;  ///< of the same voxel size
    std::vector<Part> parts;                   ///< by earlier number
    std::vector<Eigen::AlignedBox3d> new_m;    ///< around all new surfaces, in the map frame
  };

  /// `earlier`: null, if there is none.
  NearbyCells(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger,
              std::shared_ptr<const Earlier> earlier = nullptr)
      : CellGrid(box_m, voxel_size_m, std::move(ledger), kEnough),
        has_earlier_(earlier != nullptr),
        earlier_(std::move(earlier)) {}

  /// Copies the cell at a point from the previous state into the slot, if there is one and nothing near it has changed
  /// since; else null. `look`: of this state.
  const NearbyCell* TakeOver(const StateLook& look, Slot& slot, const Eigen::Vector3d& p_map) const;
  /// The cached cell at a point, taken over from the previous state if necessary; null: none.
  [[nodiscard]] const NearbyCell* FindOrTakeOver(const StateLook& look, const Eigen::Vector3d& p_map) const;
  /// Stores `unseen` in the cell at a point, if there is a cell without one.
  void Keep(const Eigen::Vector3d& p_map, std::unique_ptr<const UnseenInside> unseen) const;
  /// Ends taking over: a later state has followed this one.
  void LeaveEarlier() const DHPMAP_EXCLUDES(mutex_);

  /// Whether, by the ledger's clock, the tiles of the cell should be marked as used again.
  [[nodiscard]] bool IsMarkDue(const NearbyCell& cell) const {
    constexpr std::uint64_t kStep = 16;  // coarse enough to be cheap; eviction needs no exact times
    const std::uint64_t now = ledger().time.load(std::memory_order_relaxed);
    if (now < cell.last_used.load(std::memory_order_relaxed) + kStep) return false;
    cell.last_used.store(now, std::memory_order_relaxed);
    return true;
  }

 private:
  static constexpr std::uintptr_t kEnough = 3;  // requests: computing the cell then costs no more than they did

  [[nodiscard]] std::shared_ptr<const Earlier> FindEarlier() const DHPMAP_EXCLUDES(mutex_);

  mutable std::atomic<bool> has_earlier_;
  mutable Mutex mutex_;  // not std::atomic<std::shared_ptr>: GCC 12's does not order its loads before later stores
  mutable std::shared_ptr<const Earlier> earlier_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
