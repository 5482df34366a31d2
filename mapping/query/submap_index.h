// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mapping/map/submap.h"

namespace dhpmap {

/// Which submaps may hold a point: their bounding spheres side by side, so that a point is tested against all of them
/// in a few vector instructions each. Refers to the submaps, which must outlive it. Immutable, thread-safe.
class SubmapIndex {
 public:
  /// A submap that holds something, and the way into its frame.
  class Entry {
   public:
    explicit Entry(const Submap& submap);
    [[nodiscard]] const Submap& submap() const { return *submap_; }
    /// A point of the map frame in the submap's own.
    [[nodiscard]] Eigen::Vector3d ToSubmap(const Eigen::Vector3d& p_map) const {
      return is_on_map_axes_ ? p_map : Eigen::Vector3d(T_submap_map_ * p_map);
    }

   private:
    const Submap* submap_;
    Transform T_submap_map_;
    bool is_on_map_axes_;  ///< identity pose: no need to transform
  };

  explicit SubmapIndex(std::span<const std::shared_ptr<const Submap>> submaps);

  /// Those with a bounding sphere, in the order given.
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }

  /// Calls visit(const Entry&), in the order given, for each submap whose bounding sphere holds the point. None that
  /// has a voxel there is left out; one that has none may be visited.
  template <typename Visitor>
  void VisitAround(const Eigen::Vector3d& p_map, Visitor&& visit) const;

 private:
  std::vector<float> x_m_, y_m_, z_m_, radius2_m2_;
  std::vector<Entry> entries_;
};

template <typename Visitor>
void SubmapIndex::VisitAround(const Eigen::Vector3d& p_map, Visitor&& visit) const {
  const Eigen::Vector3f p = p_map.cast<float>();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const float dx = p.x() - x_m_[i], dy = p.y() - y_m_[i], dz = p.z() - z_m_[i];
    if (dx * dx + dy * dy + dz * dz <= radius2_m2_[i]) visit(entries_[i]);
  }
}

}  // namespace dhpmap
