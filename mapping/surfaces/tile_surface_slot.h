// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/geometry/triangle_tree.h"
#include "mapping/map/map.h"
#include "mapping/mesh/tile_surface.h"
#include "mapping/surfaces/surface_ledger.h"

namespace dhpmap {

/// A tile of a submap, with the tiles of other submaps that share its grid.
struct TilePlace {
  struct Sharer {
    SubmapId id;
    TileNeighbourhood around;
  };
  TileIndex tile;
  SubmapId owner;
  TileNeighbourhood around;
  std::vector<Sharer> sharers;  ///< by ascending id
};

/// The surface of one tile of a submap, computed at its first use, from any map, clone or state with the same surface
/// voxels there; labels may differ. Identifies these voxels by name and does not keep them alive. Thread-safe: threads
/// that need the same surface wait for one of them to compute it (a fraction of a millisecond, once its blocks are in
/// memory). No thread waits for one with a higher nice value, which may be descheduled, or for Prepare: then the
/// surface is computed twice.
class TileSurfaceSlot {
 public:
  /// `last_used`: of the slot that it replaces.
  TileSurfaceSlot(const TilePlace& place, double voxel_size_m, std::shared_ptr<SurfaceLedger> ledger,
                  std::uint64_t last_used = 0);
  ~TileSurfaceSlot();
  TileSurfaceSlot(const TileSurfaceSlot&) = delete;
  TileSurfaceSlot& operator=(const TileSurfaceSlot&) = delete;

  /// Whether this is the surface of exactly these voxels.
  [[nodiscard]] bool IsOf(const TilePlace& place, double voxel_size_m) const;

  /// `submap` has the tile, and other submaps of `state` share it, with the voxels of this slot. Valid as long as the
  /// slot.
  [[nodiscard]] const TriangleTree& Surface(const MapSnapshot& state, const Submap& submap, TileIndex tile) const {
    MarkUsed();
    const TriangleTree* ready = ready_.load(std::memory_order_acquire);
    return ready != nullptr ? *ready : MakeInTurn(state, submap, tile);
  }
  /// Computes the surface in advance, if necessary. Arguments as for Surface.
  void Prepare(const MapSnapshot& state, const Submap& submap, TileIndex tile) const {
    if (ready_.load(std::memory_order_acquire) == nullptr) (void)Make(state, submap, tile);
  }
  /// Null: not computed yet. Valid as long as the slot.
  [[nodiscard]] const TriangleTree* IfMade() const { return ready_.load(std::memory_order_acquire); }
  /// Marks it as used now.
  void MarkUsed() const {
    if (const std::uint64_t now = ledger_->time.load(std::memory_order_relaxed);
        last_used_.load(std::memory_order_relaxed) != now) {
      last_used_.store(now, std::memory_order_relaxed);
    }
  }
  /// 0: not computed yet.
  [[nodiscard]] std::size_t bytes() const;

  /// By the ledger's clock; 0: never.
  [[nodiscard]] std::uint64_t last_used() const { return last_used_.load(std::memory_order_relaxed); }

 private:
  /// Names of the layers of a block that define its surface.
  struct Layers {
    SubmapId owner;  ///< of the block; the submap's own blocks come first, with 0 unless the tile is shared
    bool is_shared = false;
    std::uint8_t where = 0;  ///< in TileNames
    std::uint64_t tsdf = 0, gone = 0;
    bool operator==(const Layers&) const = default;
  };
  static std::vector<Layers> LayersOf(const TilePlace& place);
  const TriangleTree& MakeInTurn(const MapSnapshot& state, const Submap& submap, TileIndex tile) const
      DHPMAP_EXCLUDES(makers_, nice_makers_);
  const TriangleTree& Make(const MapSnapshot& state, const Submap& submap, TileIndex tile) const;

  const std::vector<std::uint64_t> tiles_;  ///< see PartId; if these are the same, so are blocks
  const std::vector<Layers> layers_;
  const double voxel_size_m_;
  const std::shared_ptr<SurfaceLedger> ledger_;
  mutable std::atomic<std::uint64_t> last_used_;
  mutable Mutex makers_, nice_makers_;                       ///< held while a thread computes it
  mutable std::atomic<const TriangleTree*> ready_{nullptr};  ///< owned
};

}  // namespace dhpmap
