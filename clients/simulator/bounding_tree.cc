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
// A split leaves at least a sixth on each side, which limits the depth to 38 for 1,000 solids and 63 for 90,000.
constexpr std::uint32_t kSmallestShare = 6;
constexpr int kMaxDepth = 64;

double SurfaceArea(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

}  // namespace

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
  node.box = FastBox(box);
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

// The surface area heuristic, over all split positions of all three axes; there are few solids.
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
  Pending at{0, fast.Enter(nodes_[0].box, static_cast<float>(max_m))};
  while (true) {
    const auto limit = static_cast<float>(best.distance_m);
    if (at.enter <= limit) {
      const Node& node = nodes_[at.node];
      if (node.count == 0) {
        Pending near{at.node + 1, fast.Enter(nodes_[at.node + 1].box, limit)};
        Pending far{node.first, fast.Enter(nodes_[node.first].box, limit)};
        if (far.enter < near.enter) std::swap(near, far);
        if (far.enter < FastRay::kNever) stack[size++] = far;
        at = near;
        if (near.enter < FastRay::kNever) continue;
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

void BoundingTree::Gather(const Pyramid& pyramid, std::vector<Candidate>& candidates) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t index = stack[--size];
    const Node& node = nodes_[index];
    const Eigen::Array4f min = node.box.min - pyramid.apex_m, max = node.box.max - pyramid.apex_m;
    const bool is_outside = std::any_of(pyramid.inward.begin(), pyramid.inward.end(),
                                        [&](const Eigen::Array4f& n) { return (n * min).max(n * max).sum() < 0; });
    if (is_outside) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      candidates.push_back({node.box, node.box.Distance(pyramid.apex_m), &solids_[i]});
    }
  }
}

BoundingTree::Nearest BoundingTree::Closest(const Eigen::Vector3d& p) const {
  Nearest best{std::numeric_limits<double>::infinity(), nullptr};
  if (nodes_.empty()) return best;
  Eigen::Array4f fast_p;
  fast_p << p.cast<float>().array(), 0.0f;
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t index = stack[--size];
    const Node& node = nodes_[index];
    if (node.box.Distance(fast_p) > std::max(best.distance_m, 0.0)) continue;
    if (node.count == 0) {
      std::uint32_t near = index + 1, far = node.first;
      if (nodes_[far].box.Distance(fast_p) < nodes_[near].box.Distance(fast_p)) std::swap(near, far);
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
