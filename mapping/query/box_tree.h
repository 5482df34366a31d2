// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dhpmap {

/// Boxes in a tree of eight children a node, for questions about a place. What the boxes hold is the caller's: it knows
/// them by their number in the list the tree was made of. Immutable, thread-safe.
class BoxTree {
 public:
  static constexpr std::size_t kLanes = 8;

  BoxTree() = default;
  /// Finite boxes, none empty; fewer than 2^32. Takes n log n.
  explicit BoxTree(std::span<const Eigen::AlignedBox3f> boxes);

  [[nodiscard]] bool empty() const { return items_.empty(); }
  /// Around all; empty for none.
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }
  /// The boxes' numbers in the order in which they lie in the tree: those close together in space are close here.
  [[nodiscard]] std::span<const std::uint32_t> items() const { return items_; }
  [[nodiscard]] std::size_t MemoryBytes() const;

  /// Calls limit2 = visit(position) for boxes whose squared distance from `p` is at most limit2, near ones mostly
  /// first; `position` is into items(). The visitor may lower the limit, and the boxes beyond it are left out. A finite
  /// limit.
  template <typename Visitor>
  void VisitNearest(const Eigen::Vector3f& p, float limit2, Visitor&& visit) const;

  /// Calls visit(position) for boxes that overlap `box`, in no order to rely on.
  template <typename Visitor>
  void VisitOverlapping(const Eigen::AlignedBox3f& box, Visitor&& visit) const;

 private:
  /// The boxes of eight children side by side. Those of children that are not there are inside out, at infinity.
  struct alignas(32) Node {
    float low[3][kLanes];
    float high[3][kLanes];

    Node();
    void Set(std::size_t lane, const Eigen::AlignedBox3f& box);
    /// Squared distances from a point.
    void Distances2(const Eigen::Vector3f& p, float (&distance2)[kLanes]) const {
      float sum[kLanes] = {};
      for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          const float below = low[axis][lane] - p[axis], above = p[axis] - high[axis][lane];
          const float outside = std::max(std::max(below, above), 0.0f);
          sum[lane] += outside * outside;
        }
      }
      for (std::size_t lane = 0; lane < kLanes; ++lane) distance2[lane] = sum[lane];
    }
  };
  struct Pending {
    float distance2;
    std::uint32_t node;
    std::uint32_t level;
  };
  /// At most seven siblings wait on each level, and 8^11 > 2^32.
  static constexpr std::size_t kMostPending = 11 * kLanes;

  void Arrange(std::span<const Eigen::AlignedBox3f> boxes, std::span<std::uint32_t> items, std::size_t child_capacity);
  void BuildLevels(std::span<const Eigen::AlignedBox3f> boxes);

  Eigen::AlignedBox3f bounds_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;  ///< level by level; the children of node i are 8 i to 8 i + 7 of the level below
  std::vector<std::size_t> first_node_;  ///< of each level; level 0 holds items
};

template <typename Visitor>
void BoxTree::VisitNearest(const Eigen::Vector3f& p, float limit2, Visitor&& visit) const {
  if (nodes_.empty()) return;
  std::array<Pending, kMostPending> pending;
  std::size_t num_pending = 0;
  pending[num_pending++] = {0, 0, static_cast<std::uint32_t>(first_node_.size() - 1)};
  while (num_pending > 0) {
    const Pending here = pending[--num_pending];
    if (here.distance2 > limit2) continue;
    float distance2[kLanes];
    nodes_[first_node_[here.level] + here.node].Distances2(p, distance2);
    // Those within the limit, the farthest first.
    std::array<Pending, kLanes> children;
    std::size_t num_children = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!(distance2[lane] <= limit2)) continue;
      std::size_t at = num_children++;
      for (; at > 0 && children[at - 1].distance2 < distance2[lane]; --at) children[at] = children[at - 1];
      children[at] = {distance2[lane], static_cast<std::uint32_t>(kLanes * here.node + lane), here.level - 1};
    }
    if (here.level > 0) {
      for (std::size_t i = 0; i < num_children; ++i) pending[num_pending++] = children[i];
      continue;
    }
    while (num_children > 0) {
      const Pending& child = children[--num_children];
      if (child.distance2 <= limit2) limit2 = visit(static_cast<std::size_t>(child.node));
    }
  }
}

template <typename Visitor>
void BoxTree::VisitOverlapping(const Eigen::AlignedBox3f& box, Visitor&& visit) const {
  if (nodes_.empty()) return;
  std::array<Pending, kMostPending> pending;
  std::size_t num_pending = 0;
  pending[num_pending++] = {0, 0, static_cast<std::uint32_t>(first_node_.size() - 1)};
  while (num_pending > 0) {
    const Pending here = pending[--num_pending];
    const Node& node = nodes_[first_node_[here.level] + here.node];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      bool overlaps = true;
      for (int axis = 0; axis < 3; ++axis) {
        overlaps &= node.low[axis][lane] <= box.max()[axis] && node.high[axis][lane] >= box.min()[axis];
      }
      if (!overlaps) continue;
      const auto child = static_cast<std::uint32_t>(kLanes * here.node + lane);
      if (here.level > 0) pending[num_pending++] = {0, child, here.level - 1};
      else visit(static_cast<std::size_t>(child));
    }
  }
}

}  // namespace dhpmap
