// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// How far surfaces are grown: that of a submap counts before that of its class, and that before the default. Metres,
/// finite, none negative.
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

/// What a query takes as the world.
struct QueryScope {
  std::vector<SubmapId> excluded_submaps;
  std::vector<ClassId> excluded_classes;
  std::optional<std::vector<ClassId>> classes;   ///< only these
  std::optional<std::vector<SubmapId>> submaps;  ///< only these
  /// On a robot, and no longer where they are: what was in them counts as seen, and free, unless
  /// keeps_attached_unknown.
  std::vector<SubmapId> attached;
  /// There, but not in the way of whoever asks: neither their surfaces nor their inside (QueryWorld::IsInTheWay). What
  /// they have observed is seen, and what others have of a surface beside them stays as it is.
  std::vector<SubmapId> may_touch;
  SurfacePadding padding;
  /// What was last looked through so long before the newest look at the map is not known to be free.
  std::optional<double> max_free_age_s;
  /// Whether what objects have left that an edit has moved or deleted (MapSnapshot::vacated) is free, as long as nobody
  /// has seen anything there; and the place of what is left out of the world: QueryWorld::IsLeft.
  bool vacated_is_free = false;
  bool keeps_attached_unknown = false;  ///< whether what is attached leaves a place that nobody knows
  /// Also submaps that are absent, but for what of them was looked through: see SurfaceCache::Of.
  bool with_absent = false;

  /// Whether every submap is there.
  [[nodiscard]] bool IsAll() const {
    return excluded_submaps.empty() && excluded_classes.empty() && !classes && !submaps && attached.empty();
  }

  /// The unknown submap has no class, and passes whatever is asked of classes: an obstacle of unknown kind is one.
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
