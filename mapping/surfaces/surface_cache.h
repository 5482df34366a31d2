// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "mapping/surfaces/distance_fields.h"
#include "mapping/surfaces/grid_sharers.h"
#include "mapping/surfaces/nearby_cells.h"
#include "mapping/surfaces/submap_index.h"
#include "mapping/surfaces/submap_surface.h"
#include "mapping/surfaces/surface_change.h"

namespace dhpmap {

/// The surfaces of all submaps of one state of a map, mostly without absent ones, and an index over them. Keeps the
/// state alive. Thread-safe.
class MapSurfaces {
 public:
  struct Part {
    const Submap* submap;
    SubmapId id;
    std::shared_ptr<const SubmapSurface> surface;  ///< not empty
  };
  /// A thing, and a box in the map frame around all of its possible inside.
  struct Thing {
    std::uint32_t number;
    Eigen::AlignedBox3d around_m;
  };
  /// `state` outlives this; `grid` belongs to it; `ledger`: see CellSlots. Given the surfaces of an earlier state of
  /// the map, even a released one, the index costs little more than the changes, and unchanged cells and near fields
  /// are reused.
  MapSurfaces(const MapSnapshot& state, std::unique_ptr<const GridSharers> grid, std::vector<Part> parts,
              const std::shared_ptr<SurfaceLedger>& ledger, const MapSurfaces* before = nullptr);

  [[nodiscard]] const MapSnapshot& state() const { return state_; }

  /// Entry i belongs to surface(i). By ascending id.
  [[nodiscard]] const SubmapIndex& index() const { return index_; }
  [[nodiscard]] const SubmapSurface& surface(std::size_t number) const { return *parts_[number].surface; }
  /// The triangles of a tile of surface(number), computed if necessary. Some exist only together with other submaps:
  /// see Holds.
  [[nodiscard]] const TriangleTree& Triangles(std::size_t number, std::size_t tile) const {
    return surface(number).Surface(state_, index_.entries()[number].submap(), tile);
  }
  /// Whether all submaps that a triangle depends on (TriangleTree::NeededBy) exist, by number; empty `is_there`: all
  /// do.
  [[nodiscard]] bool Holds(std::span<const SubmapId> needed, const std::vector<bool>& is_there) const;
  [[nodiscard]] std::size_t NumberOf(SubmapId id) const;
  [[nodiscard]] const GridSharers* grid() const { return grid_.get(); }
  /// Surface of a submap; null if it has none.
  [[nodiscard]] std::shared_ptr<const SubmapSurface> SurfaceOf(SubmapId id) const;
  [[nodiscard]] std::span<const Thing> things() const { return things_; }
  /// Calls visit(thing), in unspecified order, for things whose box intersects one of the map frame, until it returns
  /// false.
  template <typename Visitor>
  void VisitThings(const Eigen::AlignedBox3d& box_m, Visitor&& visit) const {
    const Eigen::AlignedBox3f box = ThingBox(box_m);
    thing_tree_.VisitOverlapping(box, [&](std::size_t leaf) {
      const Thing& thing = things_[thing_tree_.items()[leaf]];
      return !thing.around_m.intersects(box_m) || visit(thing);
    });
  }
  /// Exact nearest tiles of frequently queried places.
  [[nodiscard]] const NearbyCells& cells() const { return *cells_; }
  /// Approximate distances there, within a fraction of a voxel, found sooner.
  [[nodiscard]] const DistanceFields& fields() const { return *fields_; }

 private:
  static SubmapIndex IndexOf(const std::vector<Part>& parts, const MapSurfaces* before);
  static std::vector<Thing> ThingsOf(const SubmapIndex& index);
  [[nodiscard]] BoxTree TreeOfThings() const;
  /// In the frame of the tree of things, enlarged for its floats.
  [[nodiscard]] Eigen::AlignedBox3f ThingBox(const Eigen::AlignedBox3d& box_m) const;

  void GoOnFrom(const MapSurfaces* before, const std::shared_ptr<SurfaceLedger>& ledger);
  /// All differences from an earlier state.
  [[nodiscard]] std::vector<SurfaceChange> ChangesSince(const MapSurfaces& before) const;
  [[nodiscard]] std::shared_ptr<const NearbyCells::Earlier> CellsOf(const MapSurfaces& before,
                                                                    std::span<const SurfaceChange> changes) const;

  const MapSnapshot& state_;
  const double voxel_size_m_;
  std::unique_ptr<const GridSharers> grid_;
  std::vector<Part> parts_;
  SubmapIndex index_;
  std::vector<Thing> things_;
  Eigen::Vector3d things_centre_m_ =
      Eigen::Vector3d::Zero();  ///< origin of the tree, whose floats are exact enough only nearby
  BoxTree thing_tree_;          ///< of the things' boxes
  std::shared_ptr<const NearbyCells> cells_;
  std::unique_ptr<const DistanceFields> fields_;
};

/// Cache of the surfaces of queried maps. Surfaces are computed on first use and shared by later states, moved objects
/// and clones; only written tiles are recomputed. Holds no voxels. Thread-safe: callers wait for others only if both
/// need the same tile (TileSurfaceSlot), or during the scan for tiles to evict.
class SurfaceCache {
 public:
  /// Memory limit for all surfaces; least recently used ones are evicted. Surfaces in use count, too, so release them
  /// now and then in large queries.
  explicit SurfaceCache(std::size_t limit_bytes);

  /// The surfaces of a state. The first call for a state examines its changes. `with_absent` includes absent submaps,
  /// except surface that was looked through.
  std::shared_ptr<const MapSurfaces> Of(const std::shared_ptr<const MapSnapshot>& state, bool with_absent = false)
      DHPMAP_EXCLUDES(mutex_);

  /// Whether a map of this name was queried in the last two seconds.
  [[nodiscard]] bool IsWanted(const std::string& map) const DHPMAP_EXCLUDES(mutex_);
  /// Recomputes recently used surfaces that the state changes, ahead of the next query. No effect for a map that is not
  /// wanted. Ends soon after a `stop` request.
  void Freshen(const std::shared_ptr<const MapSnapshot>& state, const std::stop_token& stop) DHPMAP_EXCLUDES(mutex_);

  /// Drops all surfaces that only the map of this name uses, once they are unused; later queries recompute them.
  void Forget(const std::string& map) DHPMAP_EXCLUDES(mutex_);

  /// Present memory of surfaces.
  [[nodiscard]] std::size_t bytes() const { return ledger_->bytes; }
  /// Present memory of the cells of queried states, within the same limit.
  [[nodiscard]] std::size_t cell_bytes() const { return ledger_->cell_bytes; }
  /// Tiles with a surface, or with one in progress, over all states.
  [[nodiscard]] std::size_t num_tiles() const DHPMAP_EXCLUDES(mutex_);

 private:
  using Slot = std::shared_ptr<const TileSurfaceSlot>;
  template <typename Key, typename Value>
  struct Known {
    std::weak_ptr<const Key> key;  // its address is the key while it exists
    std::shared_ptr<const Value> value;
  };

  using Clock = std::chrono::steady_clock;
  /// Declared before the lock, so that it is destroyed after unlocking.
  using Forgotten = std::vector<std::shared_ptr<const void>>;

  std::shared_ptr<const MapSurfaces> Find(const std::shared_ptr<const MapSnapshot>& state, bool with_absent)
      DHPMAP_EXCLUDES(mutex_);
  std::shared_ptr<const MapSurfaces> Make(const MapSnapshot& state, bool with_absent, const MapSurfaces* before)
      DHPMAP_EXCLUDES(mutex_);
  /// `grid`: null if it shares none. `before`: surface of an earlier state of the submap, or null.
  std::shared_ptr<const SubmapSurface> SurfaceOf(const std::shared_ptr<const Submap>& submap, const GridSharers* grid,
                                                 const std::shared_ptr<const SubmapSurface>& before)
      DHPMAP_EXCLUDES(mutex_);
  SubmapSurface::Slots SlotsOf(std::span<const TilePlace> places, double voxel_size_m, const SubmapSurface* before)
      DHPMAP_EXCLUDES(mutex_);
  struct States;
  // Evicted objects are returned, to be freed without the mutex.
  void Remember(States& states, const std::shared_ptr<const MapSnapshot>& state,
                const std::shared_ptr<const MapSurfaces>& made, Forgotten& forgotten) DHPMAP_REQUIRES(mutex_);
  void DropOldStates(Forgotten& forgotten) DHPMAP_REQUIRES(mutex_);
  void Sweep(Forgotten& forgotten) DHPMAP_REQUIRES(mutex_);
  void ForgetStates(Forgotten& forgotten) DHPMAP_REQUIRES(mutex_);
  void Evict() DHPMAP_EXCLUDES(mutex_);
  void DropUnused() DHPMAP_EXCLUDES(mutex_);

  const std::size_t limit_bytes_;
  const std::shared_ptr<SurfaceLedger> ledger_ = std::make_shared<SurfaceLedger>();
  mutable Mutex mutex_;
  using SlotsByTile = std::unordered_map<const BlockTile*, Known<BlockTile, TileSurfaceSlot>>;
  SlotsByTile slots_ DHPMAP_GUARDED_BY(mutex_);  // by the tile in the middle
  std::unordered_map<const Submap*, Known<Submap, SubmapSurface>> submaps_ DHPMAP_GUARDED_BY(mutex_);
  /// For all present submaps, and for all.
  struct States {
    std::unordered_map<const MapSnapshot*, Known<MapSnapshot, MapSurfaces>> known;
    std::unordered_map<std::string, std::shared_ptr<const MapSurfaces>> latest;  // by map
    /// Known states of a map, the most recently queried last. Some may be gone.
    std::unordered_map<std::string, std::deque<const MapSnapshot*>> asked;
  };
  std::array<States, 2> states_ DHPMAP_GUARDED_BY(mutex_);
  std::unordered_map<std::string, Clock::time_point> asked_ DHPMAP_GUARDED_BY(mutex_);  // last, by map
  bool is_evicting_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::uint64_t num_evictions_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t sweep_at_ DHPMAP_GUARDED_BY(mutex_) = 64;  // number of slots and submaps at which to sweep
};

}  // namespace dhpmap
