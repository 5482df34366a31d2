// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clients/evaluator/baselines/panmap_submap.h"
#include "clients/evaluator/baselines/range_view.h"
#include "mapping/base/thread_pool.h"
#include "mapping/fusion/bundler.h"
#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {

/// Panmap's class-aware projective integrator. Every voxel in view of every active submap takes the distance of what
/// the sensor saw in its direction, whatever that belongs to: submaps overlap by design. Which voxels are the submap's
/// own is counted beside it.
class ProjectiveIntegrator {
 public:
  ProjectiveIntegrator(const MapConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}

  /// `assigned`: the submap of each of `segments`, 0 for none. The same result for any number of threads.
  void Integrate(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                 const std::vector<SubmapId>& assigned, PanmapSubmaps& submaps);

 private:
  struct Target;
  struct Sight;
  /// Allocates the blocks that hold a point of the segment, or the places one voxel before and behind it.
  void Allocate(const SegmentBundles& segment, const Eigen::Vector3d& sensor_m, Submap& submap) const;
  [[nodiscard]] std::vector<Target> FindTargets(const PanopticFrame& frame, PanmapSubmaps& submaps) const;
  void UpdateBlock(const Sight& sight, Target& target) const;

  MapConfig config_;
  ThreadPool& pool_;
};

}  // namespace dhpmap::evaluator
