// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/box_tree.h"

#include <limits>

namespace dhpmap {

BoxTree::Node::Node() {
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(low[axis], kLanes, std::numeric_limits<float>::infinity());
    std::fill_n(high[axis], kLanes, -std::numeric_limits<float>::infinity());
  }
}

void BoxTree::Node::Set(std::size_t lane, const Eigen::AlignedBox3f& box) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis][lane] = box.min()[axis];
    high[axis][lane] = box.max()[axis];
  }
}

Eigen::AlignedBox3f BoxTree::Node::Bounds() const {
  Eigen::AlignedBox3f box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min()[axis] = *std::min_element(low[axis], low[axis] + kLanes);
    box.max()[axis] = *std::max_element(high[axis], high[axis] + kLanes);
  }
  return box;
}

BoxTree::BoxTree(std::span<const Eigen::AlignedBox3f> boxes, std::size_t leaf_size) : items_(boxes.size()) {
  if (boxes.empty()) return;
  for (const Eigen::AlignedBox3f& box : boxes) bounds_.extend(box);
  std::vector<Centre> centres(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) centres[i] = {boxes[i].center(), static_cast<std::uint32_t>(i)};
  std::size_t capacity = 1;  // of a child of the root
  while (capacity * kLanes < boxes.size()) capacity *= kLanes;
  Arrange(centres, capacity);
  for (std::size_t i = 0; i < centres.size(); ++i) items_[i] = centres[i].item;
  BuildLevels(boxes, leaf_size);
}

/// Cuts the items into eight parts, halving along the longest side three times, so that all but the last part are full
/// trees of `child_capacity` items; then each part likewise.
void BoxTree::Arrange(std::span<Centre> items, std::size_t child_capacity) {
  if (child_capacity <= 1 && items.size() <= kLanes) return;
  const auto halve = [&](const auto& self, std::span<Centre> part, std::size_t num_children) -> void {
    if (part.size() <= child_capacity) {
      if (child_capacity > 1) Arrange(part, child_capacity / kLanes);
      return;
    }
    const std::size_t half = num_children / 2 * child_capacity;
    if (half < part.size()) {
      Eigen::AlignedBox3f around;
      for (const Centre& item : part) around.extend(item.at);
      int axis = 0;
      around.sizes().maxCoeff(&axis);
      std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
                       [axis](const Centre& a, const Centre& b) {
                         return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.item < b.item;
                       });
    }
    const std::size_t cut = std::min(half, part.size());
    self(self, part.first(cut), num_children / 2);
    if (cut < part.size()) self(self, part.subspan(cut), num_children / 2);
  };
  halve(halve, items, kLanes);
}

void BoxTree::BuildLevels(std::span<const Eigen::AlignedBox3f> boxes, std::size_t leaf_size) {
  std::vector<Eigen::AlignedBox3f> below((items_.size() + leaf_size - 1) / leaf_size);
  for (std::size_t i = 0; i < items_.size(); ++i) below[i / leaf_size].extend(boxes[items_[i]]);
  do {
    first_node_[height_++] = static_cast<std::uint32_t>(nodes_.size());
    std::vector<Eigen::AlignedBox3f> level((below.size() + kLanes - 1) / kLanes);
    nodes_.resize(nodes_.size() + level.size());
    for (std::size_t i = 0; i < below.size(); ++i) {
      nodes_[first_node_[height_ - 1] + i / kLanes].Set(i % kLanes, below[i]);
      level[i / kLanes].extend(below[i]);
    }
    below = std::move(level);
  } while (below.size() > 1);
}

void BoxTree::Replace(std::size_t leaf, const Eigen::AlignedBox3f& box) {
  bounds_ = box;
  for (std::uint32_t level = 0; level < height_; ++level, leaf /= kLanes) {
    Node& node = nodes_[first_node_[level] + leaf / kLanes];
    node.Set(leaf % kLanes, bounds_);
    bounds_ = node.Bounds();
  }
}

std::size_t BoxTree::MemoryBytes() const {
  return items_.capacity() * sizeof(items_[0]) + nodes_.capacity() * sizeof(nodes_[0]);
}

}  // namespace dhpmap
