// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "mapping/map/submap.h"

namespace dhpmap {

/// Which submaps a query is about: the others are taken as not there.
struct QueryScope {
  std::vector<SubmapId> excluded_submaps;
  std::vector<ClassId> excluded_classes;
  std::optional<std::vector<ClassId>> classes;  ///< only these

  [[nodiscard]] bool IsAll() const { return excluded_submaps.empty() && excluded_classes.empty() && !classes; }

  /// The unknown submap has no class, and passes whatever is asked of classes: an obstacle of unknown kind is one.
  [[nodiscard]] bool Holds(const SubmapInfo& submap) const {
    const auto contains = [](const auto& list, auto id) {
      return std::find(list.begin(), list.end(), id) != list.end();
    };
    if (contains(excluded_submaps, submap.id)) return false;
    if (submap.panoptic == Panoptic::kUnknown) return true;
    return !contains(excluded_classes, submap.class_id) && (!classes || contains(*classes, submap.class_id));
  }
};

}  // namespace dhpmap
