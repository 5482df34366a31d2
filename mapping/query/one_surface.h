// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "mapping/surfaces/nearest_search.h"

namespace dhpmap {

/// Searches the nearest surface point of one submap at a time, in the query's frame, whose z is up. One owner, not
/// thread-safe.
class OneSurface {
 public:
  struct Found {
    Eigen::Vector3d point_m;
    double distance_m;
    double up;  ///< of the normal, from -1 to 1
  };

  OneSurface(const MapSurfaces& surfaces, const Transform& T_map_query)
      : surfaces_(surfaces),
        T_map_query_(T_map_query),
        T_query_map_(T_map_query.inverse()),
        is_held_(surfaces.index().entries().size()),
        is_there_(surfaces.index().entries().size(), true),
        search_(surfaces, is_held_, is_there_) {}
  OneSurface(const OneSurface&) = delete;
  OneSurface& operator=(const OneSurface&) = delete;

  /// The nearest point of submap `number`, in a world without submap `without`. Nothing: none within the limit.
  std::optional<Found> Nearest(std::size_t number, std::size_t without, const Eigen::Vector3d& p_m, double limit_m) {
    is_held_[number] = true;
    is_there_[without] = false;
    const NearestSurface nearest = search_.Find(T_map_query_ * p_m, limit_m);
    is_held_[number] = false;
    is_there_[without] = true;
    if (!nearest.is_any) return std::nullopt;
    const double distance_m = (nearest.p_submap - nearest.point_submap).norm();
    if (distance_m > limit_m) return std::nullopt;
    const Transform T_query_submap =
        T_query_map_ * surfaces_.index().entries()[nearest.number].submap().info().T_map_submap;
    return Found{T_query_submap * nearest.point_submap, distance_m,
                 (T_query_submap.linear() * nearest.normal_submap).z()};
  }
  [[nodiscard]] const Transform& T_map_query() const { return T_map_query_; }
  [[nodiscard]] const MapSurfaces& surfaces() const { return surfaces_; }

 private:
  const MapSurfaces& surfaces_;
  const Transform T_map_query_, T_query_map_;
  std::vector<bool> is_held_, is_there_;
  NearestSearch search_;
};

}  // namespace dhpmap
