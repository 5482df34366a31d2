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

/// A filter of submaps: all given conditions must hold. Map frame.
struct SubmapFilter {
  struct Box {
    Eigen::Vector3d min_m, max_m;
  };
  std::optional<std::vector<ClassId>> classes;  ///< one of these; never matches a submap without a class
  std::optional<Panoptic> panoptic;
  std::optional<Box> region;           ///< intersects the bounding sphere
  std::optional<BoundingSphere> near;  ///< intersects the bounding sphere

  [[nodiscard]] bool Passes(const Submap& submap) const;
  /// The same for a submap reduced to its place; near and region never match an empty sphere.
  [[nodiscard]] bool Passes(const SubmapPlace& place) const;

 private:
  [[nodiscard]] bool PassesLabels(Panoptic its_panoptic, ClassId its_class) const;
  [[nodiscard]] bool TouchesAll(const BoundingSphere& sphere) const;
};

/// Up to `max` of them, by ascending id, from the first after `after` on.
std::vector<std::shared_ptr<const Submap>> SelectSubmaps(const MapSnapshot& snapshot, const SubmapFilter& filter,
                                                         std::optional<SubmapId> after = std::nullopt,
                                                         std::size_t max = std::numeric_limits<std::size_t>::max());

}  // namespace dhpmap
