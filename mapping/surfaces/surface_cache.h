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

/// The surfaces of all submaps of one state of a map but, mostly, those that are absent, and an index over them. Keeps
/// the state alive. Thread-safe.
class MapSurfaces {
 public:
  struct Part {
    const Submap* submap;
    SubmapId id;
    std::shared_ptr<const SubmapSurface> surface;  ///< of something
  };
  /// A thing, and a box of the map frame around all that may be inside of it.
  struct Thing {
    std::uint32_t number;
    Eigen::AlignedBox3d around_m;
  };
  /// `state` outlives this; `grid`: of it; `ledger`: see CellSlots. With those of an earlier state of the map, though
  /// that be gone, the index costs little more than what has changed since, and cells and near fields go on where
  /// nothing has.
  MapSurfaces(const MapSnapshot& state, std::unique_ptr<const GridSharers> grid, std::vector<Part> parts,
              const std::shared_ptr<SurfaceLedger>& ledger, const MapSurfaces* before = nullptr);

  [[nodiscard]] const MapSnapshot& state() const { return state_; }

  /// Entry i is of surface(i). By ascending id.
  [[nodiscard]] const SubmapIndex& index() const { return index_; }
  [[nodiscard]] const SubmapSurface& surface(std::size_t number) const { return *parts_[number].surface; }
  /// The triangles of a tile of surface(number), made if they are not there. Some are there only if other submaps are:
  /// see Holds.
  [[nodiscard]] const TriangleTree& Triangles(std::size_t number, std::size_t tile) const {
    return surface(number).Surface(state_, index_.entries()[number].submap(), tile);
  }
  /// Whether all that a triangle needs (TriangleTree::NeededBy) is there, by number; `is_there` empty: all is.
  [[nodiscard]] bool Holds(std::span<const SubmapId> needed, const std::vector<bool>& is_there) const;
  [[nodiscard]] std::size_t NumberOf(SubmapId id) const;
  [[nodiscard]] const GridSharers* grid() const { return grid_.get(); }
  /// Of a submap; null if it has none.
  [[nodiscard]] std::shared_ptr<const SubmapSurface> SurfaceOf(SubmapId id) const;
  [[nodiscard]] std::span<const Thing> things() const { return things_; }
  /// Calls visit(thing), in no order to rely on, for those whose box meets one of the map frame, until it returns
  /// false.
  template <typename Visitor>
  void VisitThings(const Eigen::AlignedBox3d& box_m, Visitor&& visit) const {
    const Eigen::AlignedBox3f box = ThingBox(box_m);
    thing_tree_.VisitOverlapping(box, [&](std::size_t leaf) {
      const Thing& thing = things_[thing_tree_.items()[leaf]];
      return !thing.around_m.intersects(box_m) || visit(thing);
    });
  }
  /// What is nearest to the places that are asked about again and again.
  [[nodiscard]] const NearbyCells& cells() const { return *cells_; }
  /// What is nearest to them but for a part of a voxel, found sooner.
  [[nodiscard]] const DistanceFields& fields() const { return *fields_; }

 private:
  static SubmapIndex IndexOf(const std::vector<Part>& parts, const MapSurfaces* before);
  static std::vector<Thing> ThingsOf(const SubmapIndex& index);
  [[nodiscard]] BoxTree TreeOfThings() const;
  /// In the frame of the tree of things, and a little more for its floats.
  [[nodiscard]] Eigen::AlignedBox3f ThingBox(const Eigen::AlignedBox3d& box_m) const;

  void GoOnFrom(const MapSurfaces* before, const std::shared_ptr<SurfaceLedger>& ledger);
  /// All in which this differs from an earlier state.
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
      Eigen::Vector3d::Zero();  ///< origin of the tree, whose floats would not do far off
  BoxTree thing_tree_;          ///< of the things' boxes
  std::shared_ptr<const NearbyCells> cells_;
  std::unique_ptr<const DistanceFields> fields_;
};

/// Surfaces of the maps that are asked about, made when they are first wanted and kept for later states, moved objects
/// and clones: only tiles that were written since are made again. Holds no voxels. Thread-safe; nobody waits while
/// others make surfaces, but for the same tile (see TileSurfaceSlot), or free them. What is evicted is looked up in a
/// walk over what is known, for which they wait.
class SurfaceCache {
 public:
  /// What surfaces may take in all; those that were not wanted for longest go first. What a caller still holds counts,
  /// too, so who asks for much lets go in between.
  explicit SurfaceCache(std::size_t limit_bytes);

  /// The surfaces of a state. The first to ask for it takes a look at what is new in it. `with_absent`: also those of
  /// absent submaps, but for what of them was looked through.
  std::shared_ptr<const MapSurfaces> Of(const std::shared_ptr<const MapSnapshot>& state, bool with_absent = false)
      DHPMAP_EXCLUDES(mutex_);

  /// Whether somebody has asked about a map of this name in the last two seconds.
  [[nodiscard]] bool IsWanted(const std::string& map) const DHPMAP_EXCLUDES(mutex_);
  /// Makes again what a state changes of what was asked for lately, so that who asks next finds it there. Nothing, for
  /// a map that is not wanted. Ends soon after `stop` is requested.
  void Freshen(const std::shared_ptr<const MapSnapshot>& state, const std::stop_token& stop) DHPMAP_EXCLUDES(mutex_);

  /// What was made for the map of this name alone goes when nobody uses it any longer; asked for again, it is made
  /// anew.
  void Forget(const std::string& map) DHPMAP_EXCLUDES(mutex_);

  /// What surfaces take now.
  [[nodiscard]] std::size_t bytes() const { return ledger_->bytes; }
  /// What the cells of the states that are asked about take, in the same limit.
  [[nodiscard]] std::size_t cell_bytes() const { return ledger_->cell_bytes; }
  /// Tiles whose surface is there or was asked for, of any state.
  [[nodiscard]] std::size_t num_tiles() const DHPMAP_EXCLUDES(mutex_);

 private:
  using Slot = std::shared_ptr<const TileSurfaceSlot>;
  template <typename Key, typename Value>
  struct Known {
    std::weak_ptr<const Key> key;  // its address is the key as long as it is there
    std::shared_ptr<const Value> value;
  };

  using Clock = std::chrono::steady_clock;
  /// Made before the mutex is taken, so that it goes after that is free again.
  using Forgotten = std::vector<std::shared_ptr<const void>>;

  std::shared_ptr<const MapSurfaces> Find(const std::shared_ptr<const MapSnapshot>& state, bool with_absent)
      DHPMAP_EXCLUDES(mutex_);
  std::shared_ptr<const MapSurfaces> Make(const MapSnapshot& state, bool with_absent, const MapSurfaces* before)
      DHPMAP_EXCLUDES(mutex_);
  /// `grid`: null, if it shares it with nobody. `before`: of an earlier state of the submap; null: there was none.
  std::shared_ptr<const SubmapSurface> SurfaceOf(const std::shared_ptr<const Submap>& submap, const GridSharers* grid,
                                                 const std::shared_ptr<const SubmapSurface>& before)
      DHPMAP_EXCLUDES(mutex_);
  SubmapSurface::Slots SlotsOf(std::span<const TilePlace> places, double voxel_size_m, const SubmapSurface* before)
      DHPMAP_EXCLUDES(mutex_);
  struct States;
  // What they forget they leave to the caller, to be freed without the mutex.
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
  /// Of all submaps but those that are absent, and of all.
  struct States {
    std::unordered_map<const MapSnapshot*, Known<MapSnapshot, MapSurfaces>> known;
    std::unordered_map<std::string, std::shared_ptr<const MapSurfaces>> latest;  // by map
    /// Which of those known are of a map, that asked for last at the end. Some may be gone.
    std::unordered_map<std::string, std::deque<const MapSnapshot*>> asked;
  };
  std::array<States, 2> states_ DHPMAP_GUARDED_BY(mutex_);
  std::unordered_map<std::string, Clock::time_point> asked_ DHPMAP_GUARDED_BY(mutex_);  // last, by map
  bool is_evicting_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::uint64_t num_evictions_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t sweep_at_ DHPMAP_GUARDED_BY(mutex_) = 64;  // so many slots and submaps
};

}  // namespace dhpmap
