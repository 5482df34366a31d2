// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "mapping/base/vector_clones.h"

namespace dhpmap {

/// A bounding volume hierarchy of boxes with eight children a node. Callers identify boxes by their index in the input
/// list. Leaves hold one box, or eight that are close together. Thread-compatible.
class BoxTree {
 public:
  static constexpr std::size_t kLanes = 8;

  BoxTree() = default;
  /// Finite, non-empty boxes; fewer than 2^32. O(n log n). Leaf i holds items() from i * leaf_size (1 or kLanes) on;
  /// the last leaf may hold fewer.
  explicit BoxTree(std::span<const Eigen::AlignedBox3f> boxes, std::size_t leaf_size = 1);

  /// Replaces the box of a leaf without rebuilding the tree; queries slow down with the distance from the old box. Only
  /// for leaves of one box.
  void Replace(std::size_t leaf, const Eigen::AlignedBox3f& box);

  [[nodiscard]] bool empty() const { return items_.empty(); }
  /// Bounds of all boxes; empty for none.
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }
  /// Indices of the boxes in tree order: boxes close in space are close here.
  [[nodiscard]] std::span<const std::uint32_t> items() const { return items_; }
  [[nodiscard]] std::size_t MemoryBytes() const;

  /// Stack size of a depth-first search: at most seven siblings on each level, and 8^11 > 2^32.
  static constexpr std::size_t kMostPending = 11 * kLanes;

  // For custom searches. Height 1 has leaves as children; the children of a node are kLanes * node + lane, one lower.

  /// Height of the root, which is node 0; 0 without a root.
  [[nodiscard]] std::uint32_t height() const { return height_; }
  /// Squared distances of a node's children from a point. Returns a bit for each existing child within a finite limit.
  DHPMAP_ALWAYS_INLINE unsigned ChildrenWithin(std::uint32_t height, std::uint32_t node, const Eigen::Vector3f& p,
                                               float limit2, float (&distance2)[kLanes]) const {
    return nodes_[first_node_[height - 1] + node].ChildrenWithin(p, limit2, distance2);
  }

  /// Prefetches a node.
  void Prefetch(std::uint32_t height, std::uint32_t node) const {
    const auto* first = reinterpret_cast<const char*>(&nodes_[first_node_[height - 1] + node]);
    for (std::size_t at = 0; at < sizeof(Node); at += 64) __builtin_prefetch(first + at);
  }

  /// Calls visit(leaf) for leaves that overlap `box`, in unspecified order; if it returns a bool, false ends the
  /// search.
  template <typename Visitor>
  void VisitOverlapping(const Eigen::AlignedBox3f& box, Visitor&& visit) const;

  /// Calls visit(leaf) for leaves for which may_hold(box) is true, as for all boxes around them; in unspecified order.
  template <typename Predicate, typename Visitor>
  void VisitWhere(Predicate&& may_hold, Visitor&& visit) const;

  /// Calls limit = visit(leaf) for leaves that the ray from `origin` along `direction` (finite, unit length) meets
  /// within `limit`, mostly in order of entry. The visitor may lower the limit; below 0 ends the search. May visit
  /// leaves that the ray misses by up to 0.01 mm.
  template <typename Visitor>
  void VisitAlong(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float limit, Visitor&& visit) const;

 private:
  typedef float Float8 __attribute__((vector_size(32), may_alias));
  typedef std::int32_t Int8 __attribute__((vector_size(32), may_alias));
  typedef std::uint64_t Words __attribute__((vector_size(32), may_alias));
  typedef float Float4 __attribute__((vector_size(16), may_alias));
  typedef std::int32_t Int4 __attribute__((vector_size(16), may_alias));
  typedef std::uint64_t Words2 __attribute__((vector_size(16), may_alias));
  DHPMAP_ALWAYS_INLINE static unsigned Folded(const Int4& lanes) {
    const Words2 words = reinterpret_cast<const Words2&>(lanes);
    const std::uint64_t folded = words[0] | words[1];
    return static_cast<unsigned>((folded | folded >> 32) & 0xF);
  }
  /// A ray with its reciprocal direction, all coordinates finite.
  struct Along {
    Eigen::Vector3f origin, inverse;
    float margin;  ///< for rounding

    Along(const Eigen::Vector3f& from, const Eigen::Vector3f& direction)
        : origin(from), margin(1e-5f * (1 + from.cwiseAbs().maxCoeff())) {
      constexpr float kLeast = 1e-12f;
      for (int axis = 0; axis < 3; ++axis) {
        inverse[axis] = 1 / (std::abs(direction[axis]) > kLeast ? direction[axis] : kLeast);
      }
    }
  };
  /// Bounds of eight children, side by side. Missing children have inverted, infinite bounds.
  struct alignas(32) Node {
    float low[3][kLanes];
    float high[3][kLanes];

    Node();
    void Set(std::size_t lane, const Eigen::AlignedBox3f& box);
    [[nodiscard]] Eigen::AlignedBox3f Bounds() const;
    DHPMAP_ALWAYS_INLINE unsigned ChildrenWithin(const Eigen::Vector3f& p, float limit2,
                                                 float (&distance2)[kLanes]) const {
      Float8 sum = {};
      const Int8 bits = {1, 2, 4, 8, 16, 32, 64, 128};
      for (int axis = 0; axis < 3; ++axis) {
        const float x = p[axis];
        const Float8 here = {x, x, x, x, x, x, x, x}, zero = {};
        const Float8 below = *reinterpret_cast<const Float8*>(low[axis]) - here;
        const Float8 above = here - *reinterpret_cast<const Float8*>(high[axis]);
        Float8 outside = below > above ? below : above;
        outside = outside > zero ? outside : zero;
        sum += outside * outside;
      }
      std::memcpy(distance2, &sum, sizeof(sum));
      const Int8 within = (sum <= Float8{} + limit2) & bits;
      const Words words = reinterpret_cast<const Words&>(within);
      const std::uint64_t folded = words[0] | words[1] | words[2] | words[3];
      return static_cast<unsigned>(folded | folded >> 32);
    }
    // In groups of four, which every processor supports, for callers without vector clones.
    DHPMAP_ALWAYS_INLINE unsigned ChildrenOverlapping(const Eigen::AlignedBox3f& box) const {
      unsigned lanes = 0;
      for (std::size_t first = 0; first < kLanes; first += 4) {
        Int4 overlap = {1, 2, 4, 8};
        for (int axis = 0; axis < 3; ++axis) {
          const Float4 from = Float4{} + box.min()[axis], to = Float4{} + box.max()[axis];
          overlap &= *reinterpret_cast<const Float4*>(low[axis] + first) <= to;
          overlap &= *reinterpret_cast<const Float4*>(high[axis] + first) >= from;
        }
        lanes |= Folded(overlap) << first;
      }
      return lanes;
    }
    /// Entry distances of the ray into the children's boxes. Returns a bit for each that it enters within `limit`.
    DHPMAP_ALWAYS_INLINE unsigned ChildrenAlong(const Along& ray, float limit, float (&enter)[kLanes]) const;
  };
  struct Pending {
    std::uint32_t node;
    std::uint32_t level;
  };
  template <typename Visitor>
  static bool GoesOn(Visitor& visit, std::size_t position) {
    if constexpr (std::is_same_v<std::invoke_result_t<Visitor&, std::size_t>, bool>) return visit(position);
    visit(position);
    return true;
  }

  /// Visits leaves; lanes_of(node) selects the children to descend into.
  template <typename Choice, typename Visitor>
  void Descend(Choice&& lanes_of, Visitor&& visit) const;

  /// Of an item's box.
  struct Centre {
    Eigen::Vector3f at;
    std::uint32_t item;
  };
  class Halver;
  static void Arrange(std::span<Centre> items, std::size_t child_capacity, Halver& halver);
  void BuildLevels(std::span<const Eigen::AlignedBox3f> boxes, std::size_t leaf_size);

  Eigen::AlignedBox3f bounds_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;  ///< level by level; the children of node i are 8 i to 8 i + 7 of the level below
  std::array<std::uint32_t, 11> first_node_{};  ///< of each level; the children of level 0 are leaves
  std::uint32_t height_ = 0;
};

unsigned BoxTree::Node::ChildrenAlong(const Along& ray, float limit, float (&enter)[kLanes]) const {
  unsigned lanes = 0;
  for (std::size_t first = 0; first < kLanes; first += 4) {
    Float4 entered = {}, left = Float4{} + limit;
    Int4 met = {1, 2, 4, 8};
    for (int axis = 0; axis < 3; ++axis) {
      const auto& from = *reinterpret_cast<const Float4*>(low[axis] + first);
      const auto& to = *reinterpret_cast<const Float4*>(high[axis] + first);
      const Float4 a = (from - ray.margin - ray.origin[axis]) * ray.inverse[axis];
      const Float4 b = (to + ray.margin - ray.origin[axis]) * ray.inverse[axis];
      const Float4 near = a < b ? a : b, far = a < b ? b : a;
      entered = near > entered ? near : entered;
      left = far < left ? far : left;
      met &= from <= to;  // is there
    }
    met &= entered <= left;
    std::memcpy(enter + first, &entered, sizeof(entered));
    lanes |= Folded(met) << first;
  }
  return lanes;
}

template <typename Choice, typename Visitor>
void BoxTree::Descend(Choice&& lanes_of, Visitor&& visit) const {
  if (nodes_.empty()) return;
  std::array<Pending, kMostPending> pending;
  std::size_t num_pending = 0;
  pending[num_pending++] = {0, height() - 1};
  while (num_pending > 0) {
    const Pending here = pending[--num_pending];
    for (unsigned lanes = lanes_of(nodes_[first_node_[here.level] + here.node]); lanes != 0; lanes &= lanes - 1) {
      const auto child =
          static_cast<std::uint32_t>(kLanes * here.node) + static_cast<unsigned>(std::countr_zero(lanes));
      if (here.level > 0) pending[num_pending++] = {child, here.level - 1};
      else if (!GoesOn(visit, static_cast<std::size_t>(child))) return;
    }
  }
}

template <typename Visitor>
void BoxTree::VisitOverlapping(const Eigen::AlignedBox3f& box, Visitor&& visit) const {
  Descend([&box](const Node& node) { return node.ChildrenOverlapping(box); }, visit);
}

template <typename Predicate, typename Visitor>
void BoxTree::VisitWhere(Predicate&& may_hold, Visitor&& visit) const {
  const auto lanes_of = [&may_hold](const Node& node) {
    unsigned lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (node.low[0][lane] > node.high[0][lane]) continue;  // not there
      const Eigen::AlignedBox3f box(Eigen::Vector3f(node.low[0][lane], node.low[1][lane], node.low[2][lane]),
                                    Eigen::Vector3f(node.high[0][lane], node.high[1][lane], node.high[2][lane]));
      if (may_hold(box)) lanes |= 1u << lane;
    }
    return lanes;
  };
  Descend(lanes_of, visit);
}

template <typename Visitor>
void BoxTree::VisitAlong(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float limit,
                         Visitor&& visit) const {
  if (nodes_.empty()) return;
  const Along ray(origin, direction);
  struct Entered {
    float at;
    Pending what;
  };
  std::array<Entered, kMostPending> pending;
  std::size_t num_pending = 0;
  pending[num_pending++] = {0, {0, height() - 1}};
  while (num_pending > 0) {
    const Entered here = pending[--num_pending];
    if (here.at > limit) continue;
    const Node& node = nodes_[first_node_[here.what.level] + here.what.node];
    float enter[kLanes];
    std::array<Entered, kLanes> children;  // the last one entered comes first
    std::size_t num_children = 0;
    for (unsigned lanes = node.ChildrenAlong(ray, limit, enter); lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      std::size_t at = num_children++;
      for (; at > 0 && children[at - 1].at < enter[lane]; --at) children[at] = children[at - 1];
      children[at] = {enter[lane], {static_cast<std::uint32_t>(kLanes) * here.what.node + lane, here.what.level - 1}};
    }
    if (here.what.level > 0) {
      for (std::size_t i = 0; i < num_children; ++i) pending[num_pending++] = children[i];
      continue;
    }
    while (num_children > 0) {
      const Entered& child = children[--num_children];
      if (child.at <= limit) limit = visit(static_cast<std::size_t>(child.what.node));
    }
  }
}

}  // namespace dhpmap
