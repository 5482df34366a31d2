// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clients/evaluator/baselines/panmap_submap.h"
#include "clients/evaluator/baselines/range_view.h"
#include "mapping/base/thread_pool.h"
#include "mapping/fusion/bundler.h"
#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {

/// Panmap's class-aware projective integrator. Every voxel in view of every active submap is updated with the distance
/// measured in its direction, whatever object that is of, so submaps overlap by design. A separate count tells which
/// voxels belong to the submap.
class ProjectiveIntegrator {
 public:
  ProjectiveIntegrator(const MapConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}

  /// `assigned`: the submap of each of `segments`, 0 for none. The result does not depend on the number of threads.
  void Integrate(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                 const std::vector<SubmapId>& assigned, PanmapSubmaps& submaps);

 private:
  struct Target;
  struct Sight;
  /// Allocates the blocks that contain a point of the segment, or a position one voxel before or behind it.
  void Allocate(const SegmentBundles& segment, const Eigen::Vector3d& sensor_m, Submap& submap) const;
  [[nodiscard]] std::vector<Target> FindTargets(const PanopticFrame& frame, PanmapSubmaps& submaps) const;
  void UpdateBlock(const Sight& sight, Target& target) const;

  MapConfig config_;
  ThreadPool& pool_;
};

}  // namespace dhpmap::evaluator
