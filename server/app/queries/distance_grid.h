// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "server/app/queries/distance_lookup.h"

namespace dhpmap {

/// Nodes at corner_m + (i, j, k) * resolution_m in the query's frame, numbered with i fastest, then j, then k.
struct GridQuestion {
  DistanceQuestion distances;
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  double resolution_m = 0;
  Eigen::Matrix<std::int64_t, 3, 1> size = Eigen::Matrix<std::int64_t, 3, 1>::Ones();  ///< nodes along each axis

  [[nodiscard]] std::int64_t num_nodes() const { return size.prod(); }
};

/// Distances at the nodes of a grid, some thousand at a time: between batches it only pins the state of the map. One
/// thread at a time. The cache outlives it.
class DistanceGrid {
 public:
  DistanceGrid(std::shared_ptr<const MapView> view, SurfaceCache& cache, const GridQuestion& question)
      : view_(std::move(view)), cache_(&cache), question_(question) {}

  static constexpr std::size_t kMostInBatch = 4096;

  [[nodiscard]] const MapView& view() const { return *view_; }
  [[nodiscard]] const GridQuestion& question() const { return question_; }
  /// Number of the first node of the next batch.
  [[nodiscard]] std::int64_t next() const { return next_; }
  [[nodiscard]] bool is_done() const { return next_ == question_.num_nodes(); }
  /// The next nodes, at most kMostInBatch; valid until the next call. Requires !is_done(). CANCELLED soon after a
  /// `stop` request.
  Result<std::span<const SurfaceDistance>> NextBatch(const std::stop_token& stop);

 private:
  std::shared_ptr<const MapView> view_;
  SurfaceCache* cache_;
  GridQuestion question_;
  std::int64_t next_ = 0;
  std::vector<Eigen::Vector3d> points_m_;
  std::vector<SurfaceDistance> answers_;
};

}  // namespace dhpmap
