// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// The point of a map's surfaces nearest to a query point.
struct NearestSurface {
  bool is_any = false;     ///< false: no surface within the limit; other members are meaningless
  std::size_t number = 0;  ///< index of the submap in MapSurfaces
  Eigen::Vector3d p_submap = Eigen::Vector3d::Zero();       ///< query point, in the submap's frame
  Eigen::Vector3d point_submap = Eigen::Vector3d::Zero();   ///< on the surface, in the submap's frame
  Eigen::Vector3d normal_submap = Eigen::Vector3d::Zero();  ///< unit, to the front
  bool is_behind = false;                                   ///< the query point is behind the surface
  /// The query point is behind the surface (or, on request, in front of it) but beyond its border: the surface ends at
  /// the nearest point, so the sign is not reliable.
  bool is_beside = false;
  const CellSight* sight = nullptr;  ///< observation state of the voxels around the query point; null: unknown
};

/// Nearest-surface search. In a cell with known nearby tiles (NearbyCells) it scans these; elsewhere it searches
/// submaps and tiles best first. Results are the same to the bit. Reuses scratch memory: one thread.
class NearestSearch {
 public:
  /// `is_held` selects by index the surfaces that count; `is_there` the submaps that exist, which affects the surfaces
  /// of others; empty: all. All arguments outlive this.
  NearestSearch(const MapSurfaces& surfaces, const std::vector<bool>& is_held, const std::vector<bool>& is_there);
  /// For all submaps.
  NearestSearch(const MapSurfaces& surfaces, const std::vector<bool>& is_held)
      : NearestSearch(surfaces, is_held, Everybody()) {}

  /// `p_map`: finite, metres of the map frame; `limit_m`: finite. Exact to 1e-5 of the distance and 1e-4 voxels, by
  /// rounding.
  [[nodiscard]] NearestSurface Find(const Eigen::Vector3d& p_map, double limit_m);

  /// The same for one submap, selected or not.
  [[nodiscard]] NearestSurface FindOf(std::size_t number, const Eigen::Vector3d& p_map, double limit_m);

  /// Whether there is a surface within `limit_m`; may include surfaces farther by 1e-5 of that and 1e-4 voxels. Stops
  /// at the first.
  [[nodiscard]] bool IsAnyWithin(const Eigen::Vector3d& p_map, double limit_m);

  /// From now on, is_beside is also computed in front of surfaces.
  void TellWhereInFrontToo() { tells_all_beside_ = true; }

  // Find in steps. Each step prefetches the memory of the next one, so that interleaving several searches hides
  // latency.

  void Start(const Eigen::Vector3d& p_map, double limit_m);
  /// Whether this was the last one.
  bool Step();
  /// After the last step.
  [[nodiscard]] NearestSurface Found();

 private:
  enum class Stage { kSlot, kCell, kTiles, kTile, kDone };
  /// The query point in the frame of a tree's boxes.
  struct Scope {
    const BoxTree* tree;          ///< of submaps or tiles
    const SubmapSurface* submap;  ///< of tiles; null: of submaps
    Eigen::Vector3f p;
    std::uint32_t number;  ///< of the submap
  };
  /// A pending node of a scope's tree, or one of its items.
  struct Pending {
    float distance2;
    std::uint32_t scope;
    std::uint32_t node;
    std::uint32_t height;  ///< 0: an item; a node's children are one lower
  };
  /// A tile's surface, and the query point in its frame.
  struct Tile {
    const TriangleTree* triangles = nullptr;
    std::uint32_t number = 0;  ///< of the submap
    std::uint32_t tile = 0;    ///< position in the submap's surface
    Eigen::Vector3f p = Eigen::Vector3f::Zero();
  };
  /// A pending node of the tile's tree, or a packet of triangles.
  struct Node {
    float distance2;
    std::uint32_t node;
    std::uint32_t height;  ///< 0: a packet
  };
  /// One of the equally near triangles.
  struct Touch {
    Tile tile;
    std::uint32_t position;
  };

  /// A squared distance enlarged by rounding, within which another triangle may be equally near.
  [[nodiscard]] float WithRounding(float distance2) const;
  static const std::vector<bool>& Everybody() {
    static const std::vector<bool> everybody;
    return everybody;
  }
  void Begin(const Eigen::Vector3d& p_map, double limit_m);
  /// For a triangle of the tile.
  [[nodiscard]] bool IsThere(std::uint32_t position) const {
    return is_there_.empty() || sees_all_ || surfaces_.Holds(tile_.triangles->NeededBy(position), is_there_);
  }
  [[nodiscard]] bool Holds(std::size_t number) const { return sees_all_ || is_held_.empty() || is_held_[number]; }

  // In a cell.
  const NearbyCell& MakeCell();
  void EnterCell();
  void GoToNextTile();
  void LeaveCell();

  // In the whole map.
  void SearchMap();
  /// Calls visit(tile) for tiles within the limit, which it may lower, nearest box first.
  template <typename Visitor>
  void VisitTiles(Visitor&& visit);
  /// The same for pending tiles.
  template <typename Visitor>
  void VisitPending(Visitor&& visit);
  void Push(const Pending& pending);
  Pending Pop();
  void PushChildren(const Pending& node);
  void OpenSubmap(std::uint32_t number, float least2);

  // In a tile.
  void EnterTile(const Tile& tile);
  /// Depth first, the nearest child first. Returns whether that was the last one.
  bool VisitNode();
  void SearchTile(const Tile& tile);

  /// For the nearest touch.
  [[nodiscard]] bool IsBeside(const Touch& nearest);

  const MapSurfaces& surfaces_;
  const std::vector<bool>&is_held_, &is_there_;
  float rounding_m_;  ///< of coordinates
  Eigen::Vector3d p_map_ = Eigen::Vector3d::Zero();
  double limit_m_ = 0;
  Stage stage_ = Stage::kDone;
  bool stops_at_any_ = false;
  bool sees_all_ = false;  ///< ignores the selection
  bool tells_all_beside_ = false;
  float best2_ = 0;   ///< squared distance of the nearest triangle, or the limit
  float limit2_ = 0;  ///< squared distance of equally near triangles: several share an edge or a corner
  NearbyCells::Slot* slot_ = nullptr;
  const NearbyCell* cell_ = nullptr;
  float way_m_ = 0;  ///< from the cell's centre
  std::size_t next_tile_ = 0;
  Tile tile_;
  std::size_t num_nodes_ = 0;
  std::vector<Scope> scopes_;
  std::vector<Pending> heap_;  ///< the nearest on top
  std::vector<Touch> touches_;
  std::vector<TriangleCorners> around_;            ///< a point of a surface
  std::array<Node, BoxTree::kMostPending> nodes_;  ///< of the tile, the nearest last
};

}  // namespace dhpmap
