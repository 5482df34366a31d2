// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/box_tree.h"

#include <bit>
#include <limits>
#include <utility>

namespace dhpmap {

/// Partitions boxes by their centres along an axis, without data-dependent branches: twice as fast as std::nth_element.
class BoxTree::Halver {
 public:
  explicit Halver(std::size_t most) : low_(most + 1), high_(most + 1), others_(most + 1) {}

  /// Moves the `count` smallest of the part, at least one, to its front. On ties earlier ones come first.
  void Halve(std::span<Centre> part, std::size_t count, int axis) {
    for (std::size_t i = 0; i < part.size(); ++i) low_[i] = KeyOf(part[i].at[axis], i);
    const std::uint64_t last = Select(part.size(), count - 1);
    std::size_t num_first = 0, num_others = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Centre item = part[i];
      const bool is_first = KeyOf(item.at[axis], i) <= last;
      part[num_first] = item;
      others_[num_others] = item;
      num_first += is_first ? 1 : 0;
      num_others += is_first ? 0 : 1;
    }
    std::copy_n(others_.begin(), num_others, part.begin() + static_cast<std::ptrdiff_t>(num_first));
  }

 private:
  /// Sort key by coordinate, then by place; all keys are distinct.
  static std::uint64_t KeyOf(float coordinate, std::size_t place) {
    const auto bits = std::bit_cast<std::uint32_t>(coordinate);
    const std::uint32_t ordered = bits ^ (bits >> 31 != 0 ? 0xFFFFFFFFu : 0x80000000u);
    return std::uint64_t{ordered} << 32 | place;
  }
  /// The element with `rank` smaller ones among the first `count` of low_; destroys their order.
  std::uint64_t Select(std::size_t count, std::size_t rank) {
    std::uint64_t* keys = low_.data();
    auto num_passes_left = 2 * std::bit_width(count);
    while (count > 2) {
      if (num_passes_left-- == 0) {  // the input defeats the pivots
        std::nth_element(keys, keys + rank, keys + count);
        return keys[rank];
      }
      std::uint64_t a = keys[0], pivot = keys[count / 2], c = keys[count - 1];
      if (a > pivot) std::swap(a, pivot);
      if (pivot > c) pivot = std::max(a, c);
      std::size_t num_low = 0, num_high = 0;
      for (std::size_t i = 0; i < count; ++i) {  // writes never overtake reads, although one target is the source
        const std::uint64_t key = keys[i];
        low_[num_low] = key;
        high_[num_high] = key;
        num_low += key < pivot ? 1 : 0;
        num_high += key < pivot ? 0 : 1;
      }
      const bool is_low = rank < num_low;
      if (!is_low) rank -= num_low;
      keys = is_low ? low_.data() : high_.data();
      count = is_low ? num_low : num_high;
    }
    if (count == 1) return keys[0];
    return rank == 0 ? std::min(keys[0], keys[1]) : std::max(keys[0], keys[1]);
  }

  std::vector<std::uint64_t> low_, high_;
  std::vector<Centre> others_;
};

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
  Halver halver(boxes.size());
  Arrange(centres, capacity, halver);
  for (std::size_t i = 0; i < centres.size(); ++i) items_[i] = centres[i].item;
  BuildLevels(boxes, leaf_size);
}

/// Cuts the items into eight parts by halving three times along the longest side, so that all but the last part are
/// full trees of `child_capacity` items; then recurses into each part.
void BoxTree::Arrange(std::span<Centre> items, std::size_t child_capacity, Halver& halver) {
  if (child_capacity <= 1 && items.size() <= kLanes) return;
  const auto halve = [&](const auto& self, std::span<Centre> part, std::size_t num_children) -> void {
    if (part.size() <= child_capacity) {
      if (child_capacity > 1) Arrange(part, child_capacity / kLanes, halver);
      return;
    }
    const std::size_t half = num_children / 2 * child_capacity;
    if (half < part.size()) {
      Eigen::AlignedBox3f around;
      for (const Centre& item : part) around.extend(item.at);
      int axis = 0;
      around.sizes().maxCoeff(&axis);
      halver.Halve(part, half, axis);
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
