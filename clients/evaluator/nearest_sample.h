// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "mapping/base/thread_pool.h"

namespace dhpmap::evaluator {

/// A nearest point, or none within the search distance.
struct Neighbour {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t index = kNone;
  float distance_m = std::numeric_limits<float>::infinity();
  [[nodiscard]] bool exists() const { return index != kNone; }
};

/// Finds nearest points with a kd-tree. The points must outlive it. Immutable, thread-safe.
class NearestSample {
 public:
  explicit NearestSample(const std::vector<Eigen::Vector3f>& points_m);
  ~NearestSample();
  NearestSample(NearestSample&&) noexcept;

  /// The nearest point within reach_m; among equally near ones, the first.
  [[nodiscard]] Neighbour Find(const Eigen::Vector3f& p_m, double reach_m) const;
  /// Find for each query, in parallel. The result does not depend on the number of threads.
  [[nodiscard]] std::vector<Neighbour> FindAll(const std::vector<Eigen::Vector3f>& queries_m, double reach_m,
                                               ThreadPool& pool) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace dhpmap::evaluator
