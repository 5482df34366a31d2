// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/bounding_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace dhpmap::simulator {
namespace {

constexpr std::uint32_t kLeafSize = 1;
// A split leaves at least a sixth on each side, which bounds the depth at 38 for a thousand solids and 63 for 90 000.
constexpr std::uint32_t kSmallestShare = 6;
constexpr int kMaxDepth = 64;
constexpr float kMargin_m = 1e-4f;  // covers the rounding of bounds to float
constexpr float kNever = std::numeric_limits<float>::infinity();

double SurfaceArea(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

}  // namespace

struct BoundingTree::FastRay {
  Eigen::Array4f origin = Eigen::Array4f::Zero(), inverse;
  explicit FastRay(const Ray& ray) {
    origin.head<3>() = ray.origin_m.cast<float>();
    for (int i = 0; i < 3; ++i) {
      const auto d = static_cast<float>(ray.direction[i]);
      inverse[i] = 1.0f / (std::abs(d) > 1e-12f ? d : 1e-12f);  // finite, so that 0 * inverse is not NaN
    }
    inverse[3] = static_cast<float>(2 * kFar_m);  // the fourth lane, bounds 0 and 1, is the interval [0, 2 kFar_m]
  }
  /// Where the ray enters the box, or infinity if not before max_m.
  [[nodiscard]] float Enter(const Node& node, float max_m) const {
    const Eigen::Array4f t0 = (node.min - origin) * inverse, t1 = (node.max - origin) * inverse;
    const float enter = t0.min(t1).maxCoeff(), leave = std::min(t0.max(t1).minCoeff(), max_m);
    return enter <= leave ? enter : kNever;
  }
};

/// Lower bound of the distance from p to what a node holds, 0 inside.
double BoundingTree::DistanceToNode(const Node& node, const Eigen::Vector3d& p) {
  const Eigen::Array3d below = node.min.head<3>().cast<double>() - p.array();
  const Eigen::Array3d above = p.array() - node.max.head<3>().cast<double>();
  return below.max(above).max(0.0).matrix().norm();
}

BoundingTree::BoundingTree(std::vector<Solid> solids) : solids_(std::move(solids)) {
  for (const Solid& solid : solids_) bounds_.push_back(solid.Bounds());
  nodes_.reserve(2 * solids_.size());
  if (!solids_.empty()) Build(0, static_cast<std::uint32_t>(solids_.size()));
  bounds_.clear();
  bounds_.shrink_to_fit();
}

std::uint32_t BoundingTree::Build(std::uint32_t begin, std::uint32_t end) {
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = begin; i < end; ++i) box.extend(bounds_[i]);
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.min << box.min().cast<float>().array() - kMargin_m, 0.0f;
  node.max << box.max().cast<float>().array() + kMargin_m, 1.0f;
  if (end - begin <= kLeafSize) {
    node.first = begin;
    node.count = end - begin;
    return index;
  }
  node.count = 0;
  const std::uint32_t middle = Partition(begin, end);
  Build(begin, middle);
  const std::uint32_t right = Build(middle, end);
  nodes_[index].first = right;
  return index;
}

// The split of least surface area heuristic over all positions of all three axes; there are few solids.
std::uint32_t BoundingTree::Partition(std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t count = end - begin;
  double best_cost = std::numeric_limits<double>::infinity();
  std::uint32_t best_left = count / 2;
  std::vector<std::uint32_t> order(count), best_order;
  for (int axis = 0; axis < 3; ++axis) {
    std::iota(order.begin(), order.end(), begin);
    std::stable_sort(order.begin(), order.end(), [this, axis](std::uint32_t a, std::uint32_t b) {
      return bounds_[a].center()[axis] < bounds_[b].center()[axis];
    });
    std::vector<double> right_area(count);
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = count; i-- > 1;) right_area[i] = SurfaceArea(box.extend(bounds_[order[i]]));
    box.setEmpty();
    const std::uint32_t least = std::max(1u, count / kSmallestShare);
    for (std::uint32_t left = 1; left <= count - least; ++left) {
      box.extend(bounds_[order[left - 1]]);
      if (left < least) continue;
      const double cost = SurfaceArea(box) * left + right_area[left] * (count - left);
      if (cost >= best_cost) continue;
      best_cost = cost;
      best_left = left;
      best_order = order;
    }
  }
  std::vector<Solid> solids;
  std::vector<Eigen::AlignedBox3d> bounds;
  for (std::uint32_t i : best_order) {
    solids.push_back(solids_[i]);
    bounds.push_back(bounds_[i]);
  }
  std::copy(solids.begin(), solids.end(), solids_.begin() + begin);
  std::copy(bounds.begin(), bounds.end(), bounds_.begin() + begin);
  return begin + best_left;
}

BoundingTree::Hit BoundingTree::Cast(const Ray& ray, double max_m) const {
  Hit best{max_m, nullptr};
  if (nodes_.empty()) return best;
  const FastRay fast(ray);
  struct Pending {
    std::uint32_t node;
    float enter;
  };
  std::array<Pending, kMaxDepth> stack;
  std::size_t size = 0;
  Pending at{0, fast.Enter(nodes_[0], static_cast<float>(max_m))};
  while (true) {
    const auto limit = static_cast<float>(best.distance_m);
    if (at.enter <= limit) {
      const Node& node = nodes_[at.node];
      if (node.count == 0) {
        Pending near{at.node + 1, fast.Enter(nodes_[at.node + 1], limit)};
        Pending far{node.first, fast.Enter(nodes_[node.first], limit)};
        if (far.enter < near.enter) std::swap(near, far);
        if (far.enter < kNever) stack[size++] = far;
        at = near;
        if (near.enter < kNever) continue;
      } else {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          const std::optional<double> t = solids_[i].Intersect(ray, best.distance_m);
          if (t && *t < best.distance_m) best = {*t, &solids_[i]};
        }
      }
    }
    if (size == 0) return best;
    at = stack[--size];
  }
}

BoundingTree::Nearest BoundingTree::Closest(const Eigen::Vector3d& p) const {
  Nearest best{std::numeric_limits<double>::infinity(), nullptr};
  if (nodes_.empty()) return best;
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t index = stack[--size];
    const Node& node = nodes_[index];
    if (DistanceToNode(node, p) > std::max(best.distance_m, 0.0)) continue;
    if (node.count == 0) {
      std::uint32_t near = index + 1, far = node.first;
      if (DistanceToNode(nodes_[far], p) < DistanceToNode(nodes_[near], p)) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const double distance = solids_[i].Distance(p);
      if (distance < best.distance_m) best = {distance, &solids_[i]};
    }
  }
  return best;
}

}  // namespace dhpmap::simulator
