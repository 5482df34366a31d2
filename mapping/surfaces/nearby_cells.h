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

/// What is nearest to the points of one cell.
struct NearbyCell {
  Eigen::Vector3d centre_m;  ///< map frame
  float complete_m;          ///< every surface that is no farther from the centre is in one of the tiles
  CellSight sight;
  std::vector<NearbyTile> tiles;                    ///< the nearest first
  mutable std::atomic<std::uint64_t> last_used{0};  ///< by the ledger's clock, or a little before
  /// Its own, which never changes; null: nobody has asked.
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

/// What a state of a map shows of a block of its grid (LookOf).
struct StateLook {
  std::function<CellSight(BlockIndex)> sight;
  std::function<std::vector<UnseenInside::Thing>(BlockIndex)> things;  ///< ThingsAround
};

/// The cells of one state of a map that are asked about, each made once it pays. Thread-safe; nobody waits.
class NearbyCells : public CellGrid<NearbyCell> {
 public:
  /// Those of the state before, and what has become of what they know.
  struct Earlier {
    static constexpr std::uint32_t kGone = 0xFFFFFFFFu;
    struct Part {
      std::uint32_t number = kGone;      ///< what a submap's number is now; kGone: it is not there, or elsewhere
      bool is_same = false;              ///< all tiles are where they were
      std::vector<std::uint32_t> tiles;  ///< else by position then, that now; kGone: another surface, or none
    };
    std::shared_ptr<const NearbyCells> cells;  ///< of the same voxel size
    std::vector<Part> parts;                   ///< by number then
    std::vector<Eigen::AlignedBox3d> new_m;    ///< around all surfaces that were not there, in the map frame
  };

  /// `earlier`: null, if there is none.
  NearbyCells(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger,
              std::shared_ptr<const Earlier> earlier = nullptr)
      : CellGrid(box_m, voxel_size_m, std::move(ledger), kEnough),
        has_earlier_(earlier != nullptr),
        earlier_(std::move(earlier)) {}

  /// The cell at a point that is kept in the slot, from the state before, if it had one and nothing near it has changed
  /// since; else null. `look`: of this state.
  const NearbyCell* TakeOver(const StateLook& look, Slot& slot, const Eigen::Vector3d& p_map) const;
  /// What is kept of the cell at a point, also if that is taken over now; null: nothing.
  [[nodiscard]] const NearbyCell* FindOrTakeOver(const StateLook& look, const Eigen::Vector3d& p_map) const;
  /// Keeps it in the cell at a point, if there is one, and that has none.
  void Keep(const Eigen::Vector3d& p_map, std::unique_ptr<const UnseenInside> unseen) const;
  /// From here on nothing is taken over: a later state comes after this one.
  void LeaveEarlier() const DHPMAP_EXCLUDES(mutex_);

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

  [[nodiscard]] std::shared_ptr<const Earlier> FindEarlier() const DHPMAP_EXCLUDES(mutex_);

  mutable std::atomic<bool> has_earlier_;
  mutable Mutex mutex_;  // not std::atomic<std::shared_ptr>: GCC 12's does not order its loads before later stores
  mutable std::shared_ptr<const Earlier> earlier_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap
