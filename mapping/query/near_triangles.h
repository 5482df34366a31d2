// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "mapping/geometry/body.h"
#include "mapping/query/query_world.h"
#include "mapping/query/work_budget.h"

namespace dhpmap {

/// A triangle of a submap's surface, and a body that may touch it.
template <typename Shape>
struct NearTriangle {
  std::size_t number;  ///< of the submap
  double padding_m;    ///< by which it is grown
  TriangleCorners triangle;
  const Shape& body;  ///< in the frame of the triangle
  const Transform& T_map_submap;
  Eigen::Vector3d from_m;  ///< p_submap = p + from_m

  [[nodiscard]] Eigen::Vector3d InMap(const Eigen::Vector3d& p) const { return T_map_submap * (p + from_m); }
  [[nodiscard]] Eigen::Vector3d TurnedToMap(const Eigen::Vector3d& v) const { return T_map_submap.linear() * v; }
};

/// Calls visit(const NearTriangle&) for every obstacle's triangle whose box, grown by the padding of its submap,
/// intersects the box around a body in the map frame, until it returns false or `work`, if given, is spent. Includes
/// every triangle that the grown body touches. The order is unspecified.
template <typename Shape, typename Visitor>
void VisitNear(const QueryWorld& world, const Shape& body, Visitor&& visit, WorkBudget* work = nullptr) {
  const MapSurfaces& surfaces = world.surfaces();
  const SubmapIndex& index = surfaces.index();
  const auto grown_box = [](const Shape& shape, double padding_m) {
    const Eigen::AlignedBox3d box = BoundsOf(shape);
    constexpr double kRounding = 1e-6;
    const double more_m = padding_m + kRounding * (1 + box.max().cwiseAbs().cwiseMax(box.min().cwiseAbs()).maxCoeff());
    return Eigen::AlignedBox3d(box.min() - Eigen::Vector3d::Constant(more_m),
                               box.max() + Eigen::Vector3d::Constant(more_m));
  };
  const Eigen::AlignedBox3d in_map = grown_box(body, world.most_padding_m());
  index.tree().VisitOverlapping({index.InTree(in_map.min()), index.InTree(in_map.max())}, [&](std::size_t position) {
    const std::size_t number = index.tree().items()[position];
    if (!world.IsInTheWay(number)) return true;
    const SubmapIndex::Entry& entry = index.entries()[number];
    const double padding_m = world.padding_m(number);
    const Transform& T_map_submap = entry.submap().info().T_map_submap;
    const Shape in_submap = entry.IsInMapFrame() ? body : Moved(entry.T_submap_map(), body);
    const Eigen::AlignedBox3d box = grown_box(in_submap, padding_m);
    if (!box.intersects(entry.box_m())) return true;
    const SubmapSurface& surface = surfaces.surface(number);
    bool goes_on = true;
    surface.tree().VisitOverlapping({surface.InTree(box.min()), surface.InTree(box.max())}, [&](std::size_t tile) {
      constexpr int kTileWork = 64;
      goes_on = SpendOf(work, kTileWork);
      if (!goes_on) return false;
      const TriangleTree& triangles = surfaces.Triangles(number, tile);
      const Eigen::Vector3d corner_m = surface.FromTile(Eigen::Vector3f::Zero(), tile);
      const Shape in_tile = Shifted(in_submap, -corner_m);
      const Eigen::AlignedBox3f box_in_tile(surface.InTile(box.min(), tile), surface.InTile(box.max(), tile));
      triangles.tree().VisitOverlapping(box_in_tile, [&](std::size_t leaf) {
        constexpr std::size_t kLanes = TrianglePacket::kLanes;
        goes_on = SpendOf(work, 1);
        const std::size_t end = std::min((leaf + 1) * kLanes, triangles.num_triangles());
        for (std::size_t i = leaf * kLanes; i < end && goes_on; ++i) {
          const TriangleCorners t = triangles.triangle(i);
          const Eigen::AlignedBox3f around(t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2]));
          if (!around.intersects(box_in_tile) || !world.HoldsAll(triangles.NeededBy(i))) continue;
          goes_on =
              SpendOf(work, 1) && visit(NearTriangle<Shape>{number, padding_m, t, in_tile, T_map_submap, corner_m});
        }
        return goes_on;
      });
      return goes_on;
    });
    return goes_on;
  });
}

}  // namespace dhpmap
