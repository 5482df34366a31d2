// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/object_shape.h"

#include <algorithm>
#include <array>

namespace dhpmap {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Calls visit(triangle) for each triangle, in the frame of the query.
template <typename Visitor>
void ForEachTriangle(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map, Visitor&& visit) {
  const Submap& submap = surfaces.index().entries()[number].submap();
  const SubmapSurface& surface = surfaces.surface(number);
  const Transform T_query_submap = T_query_map * submap.info().T_map_submap;
  for (std::size_t tile = 0; tile < surface.tree().items().size(); ++tile) {
    const TriangleTree& triangles = surfaces.Triangles(number, tile);
    for (std::size_t i = 0; i < triangles.num_triangles(); ++i) {
      Triangle triangle;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle[corner] = T_query_submap * surface.FromTile(triangles.triangle(i)[corner], tile);
      }
      visit(triangle);
    }
  }
}

/// Clips a convex polygon at the planes of the box (Sutherland and Hodgman 1974). True if any of it remains.
bool IsTriangleIn(const Triangle& triangle, const Eigen::AlignedBox3d& box) {
  Eigen::AlignedBox3d around;
  for (const Eigen::Vector3d& corner : triangle) around.extend(corner);
  if (!box.intersects(around)) return false;
  std::vector<Eigen::Vector3d> polygon(triangle.begin(), triangle.end()), left;
  for (int plane = 0; plane < 6 && !polygon.empty(); ++plane) {
    const int axis = plane / 2;
    const auto inside_m = [&](const Eigen::Vector3d& p) {
      return plane % 2 == 0 ? p[axis] - box.min()[axis] : box.max()[axis] - p[axis];
    };
    left.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double of_a = inside_m(a), of_b = inside_m(b);
      if (of_a >= 0) left.push_back(a);
      if ((of_a >= 0) != (of_b >= 0)) left.push_back(a + of_a / (of_a - of_b) * (b - a));
    }
    polygon.swap(left);
  }
  return !polygon.empty();
}

}  // namespace

Eigen::AlignedBox3d SurfaceBox(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map) {
  Eigen::AlignedBox3d box;
  ForEachTriangle(surfaces, number, T_query_map, [&box](const Triangle& triangle) {
    for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
  });
  return box;
}

std::vector<Eigen::Vector3d> SurfacePoints(const MapSurfaces& surfaces, std::size_t number,
                                           const Transform& T_query_map, std::size_t most) {
  std::vector<Eigen::Vector3d> points;
  ForEachTriangle(surfaces, number, T_query_map, [&points](const Triangle& triangle) {
    points.push_back((triangle[0] + triangle[1] + triangle[2]) / 3);
  });
  if (points.size() <= most) return points;
  std::vector<Eigen::Vector3d> chosen;
  chosen.reserve(most);
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(points[i * points.size() / most]);
  return chosen;
}

bool SurfaceIsIn(const MapSurfaces& surfaces, std::size_t number, const Transform& T_query_map,
                 const Eigen::AlignedBox3d& box) {
  const SubmapIndex::Entry& entry = surfaces.index().entries()[number];
  const Transform T_query_submap = T_query_map * entry.submap().info().T_map_submap;
  if (!box.intersects(entry.box_m().transformed(T_query_submap))) return false;
  bool is_in = false;
  ForEachTriangle(surfaces, number, T_query_map,
                  [&](const Triangle& triangle) { is_in = is_in || IsTriangleIn(triangle, box); });
  return is_in;
}

}  // namespace dhpmap
