// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/query/surface_cache.h"

namespace dhpmap {

/// The point of a map's surfaces that is nearest to a place.
struct NearestSurface {
  bool is_any = false;     ///< false: none within the limit, and nothing else means anything
  std::size_t number = 0;  ///< of the submap, in MapSurfaces
  Eigen::Vector3d p_submap = Eigen::Vector3d::Zero();       ///< the place, in the submap's frame
  Eigen::Vector3d point_submap = Eigen::Vector3d::Zero();   ///< on the surface, in the submap's frame
  Eigen::Vector3d normal_submap = Eigen::Vector3d::Zero();  ///< unit, to the front
  bool is_behind = false;                                   ///< the place is behind the surface
};

/// Looks for it: of submaps, their tiles and the triangles in these always what may be nearest comes next, so that
/// little more is looked at than what there is within the distance that is found. Keeps its scratch memory from one
/// search to the next: belongs to one thread.
class NearestSearch {
 public:
  /// `is_held` says by number which submaps count; empty: all. Both outlive this.
  NearestSearch(const MapSurfaces& surfaces, const std::vector<bool>& is_held);

  /// `p_map`: finite, metres of the map frame; `limit_m`: finite. Exact to 1e-5 of the distance, by rounding.
  [[nodiscard]] NearestSurface Find(const Eigen::Vector3d& p_map, double limit_m);

 private:
  /// A tree, and the place in the frame of its boxes.
  struct Scope {
    const BoxTree* tree;
    const TriangleTree* triangles;  ///< of a tile; null: of submaps or tiles
    const SubmapSurface* submap;    ///< of tiles and triangles; null: of submaps
    Eigen::Vector3f p;
    std::uint32_t number;      ///< of the submap
    std::uint32_t tile;        ///< position in the submap's surface
    Eigen::Vector3d p_submap;  ///< of tiles and triangles
  };
  /// A node of a scope's tree, or one of its items, that has yet to be looked at.
  struct Pending {
    float distance2;
    std::uint32_t scope;
    std::uint32_t node;
    std::uint32_t height;  ///< 0: an item; a node's children are one lower
  };
  /// A triangle that is as near as any.
  struct Touch {
    const TriangleCorners* triangle;
    std::uint32_t scope;
  };

  void Run();
  void Open(const Pending& item);
  void OpenTree(const Scope& scope, float distance2);
  void Push(const Pending& pending);
  Pending Pop();
  void Try(const TriangleCorners& triangle, std::uint32_t scope);
  [[nodiscard]] NearestSurface Describe() const;

  const MapSurfaces& surfaces_;
  const std::vector<bool>& is_held_;
  Eigen::Vector3d p_map_ = Eigen::Vector3d::Zero();
  float best2_ = 0;   ///< squared distance of the nearest triangle, or of the limit
  float limit2_ = 0;  ///< within which a triangle is as near: an edge or a corner belongs to several
  std::vector<Scope> scopes_;
  std::vector<Pending> heap_;  ///< the nearest on top
  std::vector<Touch> touches_;
};

}  // namespace dhpmap
