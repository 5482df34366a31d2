// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/ray_query.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace dhpmap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The length along the ray at which it hits the triangle from either side; infinity if it misses (Moeller and Trumbore
/// 1997). Triangles are slightly enlarged, so that no ray passes between two of them.
double MeetingOf(const TriangleCorners& triangle, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  constexpr double kMissed = std::numeric_limits<double>::infinity(), kOver = 1e-6;
  const Eigen::Vector3d a = triangle[0].cast<double>();
  const Eigen::Vector3d ab = triangle[1].cast<double>() - a, ac = triangle[2].cast<double>() - a;
  const Eigen::Vector3d across = direction.cross(ac);
  const double determinant = ab.dot(across);
  if (std::abs(determinant) < 1e-15) return kMissed;  // edge-on: it hits a neighbour
  const Eigen::Vector3d from_a = origin - a;
  const double u = from_a.dot(across) / determinant;
  if (u < -kOver || u > 1 + kOver) return kMissed;
  const Eigen::Vector3d other = from_a.cross(ab);
  const double v = direction.dot(other) / determinant;
  if (v < -kOver || u + v > 1 + kOver) return kMissed;
  const double along = ac.dot(other) / determinant;
  return along >= 0 ? along : kMissed;
}

/// The reciprocal of each coordinate, always finite.
Eigen::Vector3f InverseOf(const Eigen::Vector3d& direction) {
  constexpr double kLeast = 1e-12;
  Eigen::Vector3f inverse;
  for (int i = 0; i < 3; ++i) {
    inverse[i] = static_cast<float>(1 / (std::abs(direction[i]) > kLeast ? direction[i] : kLeast));
  }
  return inverse;
}

/// Calls visit(along_m, triangle) for triangles of a submap that the ray hits within `limit_m`, in no particular order.
/// `visit` returns the new limit, below 0 to stop. `is_there`: see NearestSearch.
template <typename Visitor>
void VisitMet(const MapSurfaces& surfaces, std::size_t number, const std::vector<bool>& is_there, const Ray& ray,
              double limit_m, Visitor&& visit) {
  const SubmapIndex::Entry& entry = surfaces.index().entries()[number];
  const Submap& submap = entry.submap();
  const SubmapSurface& surface = surfaces.surface(number);
  const Eigen::Vector3d origin = entry.ToSubmap(ray.origin_m);
  const Eigen::Vector3d direction = submap.info().T_map_submap.linear().transpose() * ray.direction;
  const Eigen::Vector3f inverse = InverseOf(direction);
  const auto limit = [&limit_m] { return static_cast<float>(limit_m); };
  surface.tree().VisitAlong(surface.InTree(origin), direction.cast<float>(), limit(), [&](std::size_t tile) {
    const TriangleTree& triangles = surfaces.Triangles(number, tile);
    const Eigen::Vector3d in_tile = surface.InTileExactly(origin, tile);
    const auto margin_m = static_cast<float>(1e-5 * (1 + in_tile.cwiseAbs().maxCoeff()));  // for rounding
    triangles.tree().VisitAlong(in_tile.cast<float>(), direction.cast<float>(), limit(), [&](std::size_t i) {
      const std::size_t first = i * TrianglePacket::kLanes;
      const std::size_t count = std::min(TrianglePacket::kLanes, triangles.num_triangles() - first);
      unsigned met = triangles.packet(i).Along(in_tile.cast<float>(), inverse, margin_m, limit());
      for (met &= (1u << count) - 1; met != 0; met &= met - 1) {
        const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(met));
        const TriangleCorners triangle = triangles.triangle(k);
        const double along_m = MeetingOf(triangle, in_tile, direction);
        if (along_m <= limit_m && surfaces.Holds(triangles.NeededBy(k), is_there)) limit_m = visit(along_m, triangle);
      }
      return limit();
    });
    return limit();
  });
}

}  // namespace

bool MeetsSubmap(const MapSurfaces& surfaces, std::size_t number, const Ray& ray, double limit_m) {
  bool is_met = false;
  VisitMet(surfaces, number, {}, ray, limit_m, [&is_met](double, const TriangleCorners&) {
    is_met = true;
    return -1.0;
  });
  return is_met;
}

RayQuery::RayQuery(std::shared_ptr<const MapSurfaces> surfaces, RayOptions options)
    : world_(std::move(surfaces), options.scope), options_(std::move(options)) {}

RayHit RayQuery::Cast(const Ray& ray) const {
  RayHit hit = FirstHit(ray);
  hit.free_m = options_.unknown_is_free ? hit.distance_m : SeenUpTo(ray, hit.distance_m);
  hit.is_unknown = hit.free_m < hit.distance_m;
  return hit;
}

RayHit RayQuery::FirstHit(const Ray& ray) const {
  RayHit hit{.distance_m = options_.max_distance_m};
  hit.point_m.setConstant(kNaN);
  hit.normal.setConstant(kNaN);
  const MapSurfaces& surfaces = world_.surfaces();
  const SubmapIndex& index = surfaces.index();
  const auto limit = [&hit] { return static_cast<float>(hit.distance_m); };
  index.tree().VisitAlong(index.InTree(ray.origin_m), ray.direction.cast<float>(), limit(), [&](std::size_t position) {
    const std::size_t number = index.tree().items()[position];
    if (!world_.Holds(number)) return limit();
    const SubmapInfo& info = index.entries()[number].submap().info();
    VisitMet(surfaces, number, world_.is_held(), ray, hit.distance_m, [&](double along_m, const TriangleCorners& t) {
      if (hit.submap != nullptr && along_m == hit.distance_m) return hit.distance_m;
      hit.submap = &info;
      hit.distance_m = along_m;
      hit.normal = info.T_map_submap.linear() * (t[1] - t[0]).cross(t[2] - t[0]).stableNormalized().cast<double>();
      return hit.distance_m;
    });
    return limit();
  });
  if (hit.submap != nullptr) hit.point_m = ray.origin_m + hit.distance_m * ray.direction;
  return hit;
}

/// Voxel traversal (Amanatides and Woo 1987).
double RayQuery::SeenUpTo(const Ray& ray, double end_m) const {
  const double size_m = world_.voxel_size_m();
  constexpr double kMostReach_vox = 1 << 30;
  if (ray.origin_m.cwiseAbs().maxCoeff() + end_m > kMostReach_vox * size_m) return 0;  // no sensor can have been there
  VoxelIndex voxel = VoxelAt(ray.origin_m, size_m);
  std::int32_t* const index[3] = {&voxel.x, &voxel.y, &voxel.z};
  Eigen::Vector3d next_m, step_m;  // along the ray: to the next voxel in each axis, and between two
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    step_m[axis] = d == 0 ? std::numeric_limits<double>::infinity() : size_m / std::abs(d);
    const double border_m = (*index[axis] + (d > 0 ? 1 : 0)) * size_m;
    next_m[axis] = d == 0 ? step_m[axis] : (border_m - ray.origin_m[axis]) / d;
  }
  double here_m = 0;
  while (here_m < end_m) {
    if (!world_.IsSeen(voxel)) return here_m;
    int axis = 0;
    here_m = next_m.minCoeff(&axis);
    next_m[axis] += step_m[axis];
    *index[axis] += ray.direction[axis] > 0 ? 1 : -1;
  }
  return end_m;
}

}  // namespace dhpmap
