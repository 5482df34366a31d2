// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Distance by which surfaces are grown, in metres, finite, not negative. The padding of a submap takes precedence over
/// that of its class, and that over the default.
struct SurfacePadding {
  double default_m = 0;
  std::vector<std::pair<ClassId, double>> classes;
  std::vector<std::pair<SubmapId, double>> submaps;

  [[nodiscard]] double Of(const SubmapInfo& submap) const {
    const auto find = [](const auto& list, auto id) {
      return std::find_if(list.begin(), list.end(), [id](const auto& item) { return item.first == id; });
    };
    if (const auto found = find(submaps, submap.id); found != submaps.end()) return found->second;
    if (submap.panoptic == Panoptic::kUnknown) return default_m;
    const auto found = find(classes, submap.class_id);
    return found != classes.end() ? found->second : default_m;
  }
};

/// The world of a query: which submaps it contains, and how it treats their surfaces and unseen space.
struct QueryScope {
  std::vector<SubmapId> excluded_submaps;
  std::vector<ClassId> excluded_classes;
  std::optional<std::vector<ClassId>> classes;   ///< only these
  std::optional<std::vector<SubmapId>> submaps;  ///< only these
  /// Carried by the robot, so no longer at their place: that place counts as seen and free, unless
  /// keeps_attached_unknown.
  std::vector<SubmapId> attached;
  /// In the world, but not obstacles of this query: neither their surfaces nor their inside (QueryWorld::IsInTheWay).
  /// Their observed voxels count as seen. Surfaces of other submaps beside them are unchanged.
  std::vector<SubmapId> may_touch;
  SurfacePadding padding;
  /// Free space last seen more than this before the newest view of the map counts as unknown.
  std::optional<double> max_free_age_s;
  /// Whether space is free that moved or deleted objects occupied (MapSnapshot::vacated) and that no sensor has seen
  /// since. The same applies to the places of excluded submaps: QueryWorld::IsLeft.
  bool vacated_is_free = false;
  bool keeps_attached_unknown = false;  ///< whether attached submaps leave unknown instead of free space
  /// Includes absent submaps, except surface that sensors have looked through: see SurfaceCache::Of.
  bool with_absent = false;

  /// Whether the world contains every submap.
  [[nodiscard]] bool IsAll() const {
    return excluded_submaps.empty() && excluded_classes.empty() && !classes && !submaps && attached.empty();
  }

  /// The unknown submap has no class and passes every class filter: an obstacle of unknown kind is still an obstacle.
  [[nodiscard]] bool Holds(const SubmapInfo& submap) const {
    const auto contains = [](const auto& list, auto id) {
      return std::find(list.begin(), list.end(), id) != list.end();
    };
    if (contains(excluded_submaps, submap.id) || contains(attached, submap.id)) return false;
    if (submaps && !contains(*submaps, submap.id)) return false;
    if (submap.panoptic == Panoptic::kUnknown) return true;
    return !contains(excluded_classes, submap.class_id) && (!classes || contains(*classes, submap.class_id));
  }
};

}  // namespace dhpmap
