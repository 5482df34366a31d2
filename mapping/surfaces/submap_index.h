// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mapping/geometry/box_tree.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Spatial index of submaps. Refers to the submaps, which must outlive it. Immutable, thread-safe.
class SubmapIndex {
 public:
  /// A non-empty submap and the transform into its frame.
  class Entry {
   public:
    Entry(const Submap& submap, const Eigen::AlignedBox3d& box_m);
    [[nodiscard]] const Submap& submap() const { return *submap_; }
    /// Bounds of its content, in its own frame.
    [[nodiscard]] const Eigen::AlignedBox3d& box_m() const { return box_m_; }
    /// Transforms a point of the map frame into the submap's.
    [[nodiscard]] Eigen::Vector3d ToSubmap(const Eigen::Vector3d& p_map) const {
      return is_on_map_axes_ ? p_map : Eigen::Vector3d(T_submap_map_ * p_map);
    }

    [[nodiscard]] const Transform& T_submap_map() const { return T_submap_map_; }
    /// Whether the two frames are the same.
    [[nodiscard]] bool IsInMapFrame() const { return is_on_map_axes_; }
    /// Whether boxes and transforms are equal. Does not access the submaps.
    [[nodiscard]] bool IsPlacedAs(const Entry& other) const;

    /// Whether its box and its bounding sphere contain a point of its own frame.
    [[nodiscard]] bool MayHold(const Eigen::Vector3d& p_submap) const {
      const BoundingSphere& sphere = submap_->bounding_sphere();
      constexpr double kRounding = 1 + 1e-9;
      return box_m_.contains(p_submap) &&
             (p_submap - sphere.center_m).squaredNorm() <= kRounding * sphere.radius_m * sphere.radius_m;
    }

   private:
    const Submap* submap_;
    Transform T_submap_map_;
    bool is_on_map_axes_;
    Eigen::AlignedBox3d box_m_;
  };

  /// By the submaps' bounding spheres.
  explicit SubmapIndex(std::span<const std::shared_ptr<const Submap>> submaps);
  /// The same derived from an index of other submaps, which may be gone: costs a copy of it, and the differences.
  SubmapIndex(const SubmapIndex& before, std::span<const std::shared_ptr<const Submap>> submaps);
  /// By the boxes of the entries, each in its submap's own frame; none is empty.
  explicit SubmapIndex(std::vector<Entry> entries);
  /// The same for entries that differ from an index of equal size only at the numbers in `changed`: costs a copy, and
  /// the changes.
  SubmapIndex(const SubmapIndex& before, std::vector<Entry> entries, std::span<const std::size_t> changed);

  /// Boxes replaced since the tree was built; 0 for a new tree.
  [[nodiscard]] std::size_t num_replaced() const { return num_replaced_; }

  /// Non-empty, present submaps, in the order given.
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }

  /// Calls visit(const Entry&), in the order given, for each submap whose box and bounding sphere contain the point
  /// (finite): all submaps with a voxel there, and possibly others.
  template <typename Visitor>
  void VisitAround(const Eigen::Vector3d& p_map, Visitor&& visit) const;

  /// Tree of the entries' axis-aligned boxes in the map frame; its items are the entries' numbers.
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  /// Bounds of all entries, in the map frame; empty for none.
  [[nodiscard]] const Eigen::AlignedBox3d& box_m() const { return box_m_; }
  /// Transforms a point of the map frame into that of the tree.
  [[nodiscard]] Eigen::Vector3f InTree(const Eigen::Vector3d& p_map) const { return (p_map - origin_m_).cast<float>(); }

 private:
  static std::vector<Entry> EntriesOf(std::span<const std::shared_ptr<const Submap>> submaps);
  static SubmapIndex After(const SubmapIndex& before, std::vector<Entry> entries);
  void Build();
  /// In the map frame; and as floats in the frame of the tree, enlarged so that rounding loses no voxel at the rim.
  [[nodiscard]] static Eigen::AlignedBox3d BoxInMap(const Entry& entry);
  [[nodiscard]] Eigen::AlignedBox3f BoxInTree(const Eigen::AlignedBox3d& box_m) const;

  std::vector<Entry> entries_;
  Eigen::AlignedBox3d box_m_;
  Eigen::Vector3d origin_m_ =
      Eigen::Vector3d::Zero();          ///< origin of the tree, whose floats are exact enough only nearby
  double reach_m_ = 0;                  ///< distance from the origin up to which floats suffice
  BoxTree tree_;                        ///< of the entries' boxes, along the axes of the map frame
  std::vector<std::uint32_t> leaf_of_;  ///< by number
  std::size_t num_replaced_ = 0;        ///< boxes in the tree, since it was made
};

template <typename Visitor>
void SubmapIndex::VisitAround(const Eigen::Vector3d& p_map, Visitor&& visit) const {
  const Eigen::Vector3f p = InTree(p_map);
  constexpr std::size_t kMostSorted = 64;  // submaps at one point; more are rare
  std::size_t found[kMostSorted];
  std::size_t num_found = 0;
  tree_.VisitOverlapping({p, p}, [&](std::size_t position) {
    const std::size_t number = tree_.items()[position];
    if (num_found < kMostSorted) found[num_found] = number;
    ++num_found;
  });
  const auto try_one = [&](const Entry& entry) {
    if (entry.MayHold(entry.ToSubmap(p_map))) visit(entry);
  };
  if (num_found > kMostSorted) {
    for (const Entry& entry : entries_) try_one(entry);
    return;
  }
  std::sort(found, found + num_found);
  for (std::size_t i = 0; i < num_found; ++i) try_one(entries_[found[i]]);
}

}  // namespace dhpmap
