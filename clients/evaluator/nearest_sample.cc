// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/nearest_sample.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

namespace dhpmap::evaluator {
namespace {

/// Adapts points to nanoflann.
struct PointCloud {
  const std::vector<Eigen::Vector3f>& points_m;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points_m.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points_m[index][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // let the tree compute it
  }
};

/// A nanoflann result set: the nearest point within a distance. Accepts equally near points, so that the choice between
/// them does not depend on the tree.
class NearestWithin {
 public:
  using DistanceType = float;
  explicit NearestWithin(float reach2_m2) : best2_m2_(reach2_m2) {}

  [[nodiscard]] bool full() const { return index_ != Neighbour::kNone; }
  [[nodiscard]] std::size_t size() const { return full() ? 1 : 0; }
  [[nodiscard]] float worstDist() const { return std::nextafter(best2_m2_, std::numeric_limits<float>::infinity()); }
  bool addPoint(float distance2_m2, std::uint32_t index) {
    if (distance2_m2 < best2_m2_ || (distance2_m2 == best2_m2_ && index < index_)) {
      best2_m2_ = distance2_m2;
      index_ = index;
    }
    return true;
  }
  [[nodiscard]] Neighbour Get() const { return full() ? Neighbour{index_, std::sqrt(best2_m2_)} : Neighbour{}; }

 private:
  float best2_m2_;
  std::uint32_t index_ = Neighbour::kNone;
};

}  // namespace

struct NearestSample::Tree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointCloud>, PointCloud, 3,
                                                    std::uint32_t>;
  explicit Tree(const std::vector<Eigen::Vector3f>& points_m) : cloud{points_m}, index(3, cloud) {}
  PointCloud cloud;
  Index index;
};

NearestSample::NearestSample(const std::vector<Eigen::Vector3f>& points_m)
    : tree_(std::make_unique<const Tree>(points_m)) {}
NearestSample::~NearestSample() = default;
NearestSample::NearestSample(NearestSample&&) noexcept = default;

Neighbour NearestSample::Find(const Eigen::Vector3f& p_m, double reach_m) const {
  if (tree_->cloud.points_m.empty()) return {};
  NearestWithin nearest(static_cast<float>(reach_m * reach_m));
  tree_->index.findNeighbors(nearest, p_m.data(), nanoflann::SearchParams());
  return nearest.Get();
}

std::vector<Neighbour> NearestSample::FindAll(const std::vector<Eigen::Vector3f>& queries_m, double reach_m,
                                              ThreadPool& pool) const {
  constexpr std::size_t kChunk = 4096;
  std::vector<Neighbour> found(queries_m.size());
  pool.ParallelFor((queries_m.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(queries_m.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) found[i] = Find(queries_m[i], reach_m);
  });
  return found;
}

}  // namespace dhpmap::evaluator
