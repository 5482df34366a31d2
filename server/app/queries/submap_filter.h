// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "mapping/changes/map_change.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// Which submaps to list: those that pass every condition given. Map frame.
struct SubmapFilter {
  struct Box {
    Eigen::Vector3d min_m, max_m;
  };
  std::optional<std::vector<ClassId>> classes;  ///< one of these; a submap without a class passes none
  std::optional<Panoptic> panoptic;
  std::optional<Box> region;           ///< touched by the bounding sphere
  std::optional<BoundingSphere> near;  ///< touched by the bounding sphere

  [[nodiscard]] bool Passes(const Submap& submap) const;
  /// The same of one of which no more is known; no near or region passes an empty sphere.
  [[nodiscard]] bool Passes(const SubmapPlace& place) const;

 private:
  [[nodiscard]] bool PassesLabels(Panoptic its_panoptic, ClassId its_class) const;
  [[nodiscard]] bool TouchesAll(const BoundingSphere& sphere) const;
};

/// Up to `max` of them, by ascending id, from the first behind `after` on.
std::vector<std::shared_ptr<const Submap>> SelectSubmaps(const MapSnapshot& snapshot, const SubmapFilter& filter,
                                                         std::optional<SubmapId> after = std::nullopt,
                                                         std::size_t max = std::numeric_limits<std::size_t>::max());

}  // namespace dhpmap
