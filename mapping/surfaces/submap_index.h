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

/// Which submaps are at or near a place. Refers to the submaps, which must outlive it. Immutable, thread-safe.
class SubmapIndex {
 public:
  /// A submap that holds something, and the way into its frame.
  class Entry {
   public:
    Entry(const Submap& submap, const Eigen::AlignedBox3d& box_m);
    [[nodiscard]] const Submap& submap() const { return *submap_; }
    /// Around what it holds, in its own frame.
    [[nodiscard]] const Eigen::AlignedBox3d& box_m() const { return box_m_; }
    /// A point of the map frame in the submap's own.
    [[nodiscard]] Eigen::Vector3d ToSubmap(const Eigen::Vector3d& p_map) const {
      return is_on_map_axes_ ? p_map : Eigen::Vector3d(T_submap_map_ * p_map);
    }

    [[nodiscard]] const Transform& T_submap_map() const { return T_submap_map_; }
    /// Whether the two frames are one.
    [[nodiscard]] bool IsInMapFrame() const { return is_on_map_axes_; }
    /// Whether the boxes of two, and their ways there, are the same. Does not look at the submaps.
    [[nodiscard]] bool IsPlacedAs(const Entry& other) const;

    /// Whether its box and its bounding sphere hold a point of its own frame.
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
  /// The same made from an index of any other submaps, which may be gone: costs a copy of it, and what lies elsewhere.
  SubmapIndex(const SubmapIndex& before, std::span<const std::shared_ptr<const Submap>> submaps);
  /// By boxes around what they hold, each in its submap's own frame; none is empty.
  explicit SubmapIndex(std::vector<Entry> entries);
  /// The same for entries of which only those with the numbers in `changed` differ from an index of as many: costs a
  /// copy, and what has changed.
  SubmapIndex(const SubmapIndex& before, std::vector<Entry> entries, std::span<const std::size_t> changed);

  /// Boxes that were put elsewhere since the tree was built; 0: it was built for this.
  [[nodiscard]] std::size_t num_replaced() const { return num_replaced_; }

  /// Those that hold something and are not absent, in the order given.
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }

  /// Calls visit(const Entry&), in the order given, for each submap whose box and bounding sphere hold the point
  /// (finite). None that has a voxel there is left out; one that has none may be visited.
  template <typename Visitor>
  void VisitAround(const Eigen::Vector3d& p_map, Visitor&& visit) const;

  /// Of the entries' boxes along the axes of the map frame; its items are the entries' numbers.
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  /// Around all entries, in the map frame; empty for none.
  [[nodiscard]] const Eigen::AlignedBox3d& box_m() const { return box_m_; }
  /// A point of the map frame in that of the tree.
  [[nodiscard]] Eigen::Vector3f InTree(const Eigen::Vector3d& p_map) const { return (p_map - origin_m_).cast<float>(); }

 private:
  static std::vector<Entry> EntriesOf(std::span<const std::shared_ptr<const Submap>> submaps);
  static SubmapIndex After(const SubmapIndex& before, std::vector<Entry> entries);
  void Build();
  /// In the map frame; and as floats in the frame of the tree, so much larger that rounding loses no voxel at the rim.
  [[nodiscard]] static Eigen::AlignedBox3d BoxInMap(const Entry& entry);
  [[nodiscard]] Eigen::AlignedBox3f BoxInTree(const Eigen::AlignedBox3d& box_m) const;

  std::vector<Entry> entries_;
  Eigen::AlignedBox3d box_m_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();  ///< of the tree, whose floats would not do far from here
  double reach_m_ = 0;                                  ///< so far from the origin the tree's floats will do
  BoxTree tree_;                                        ///< of the entries' boxes, along the axes of the map frame
  std::vector<std::uint32_t> leaf_of_;                  ///< by number
  std::size_t num_replaced_ = 0;                        ///< boxes in the tree, since it was made
};

template <typename Visitor>
void SubmapIndex::VisitAround(const Eigen::Vector3d& p_map, Visitor&& visit) const {
  const Eigen::Vector3f p = InTree(p_map);
  constexpr std::size_t kMostSorted = 64;  // of those that hold one point; more are rare
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
