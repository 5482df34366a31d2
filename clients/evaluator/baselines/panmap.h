// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/baselines/panmap_submap.h"
#include "clients/evaluator/baselines/panmap_tracker.h"
#include "clients/evaluator/baselines/projective_integrator.h"
#include "clients/evaluator/mapping_system.h"
#include "mapping/fusion/bundler.h"

namespace dhpmap::evaluator {

/// Panmap: panoptic submaps with a life cycle by tracking. Omits its free-space submap and change detection, because
/// the data sets are static, with one session. Segments are split into connected parts first (SplitIntoParts, with
/// split_gap_vox of the configuration), as in our pipeline: this is not part of its method, but helps.
class Panmap final : public MappingSystem {
 public:
  explicit Panmap(const SystemSetup& setup, std::string name = "panmap");

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] bool has_instances() const override { return true; }
  Status Integrate(const PanopticFrame& frame) override;
  /// Deactivates all submaps and merges until nothing changes.
  void Finish() override;
  /// The own surfaces of all submaps, which may overlap. An instance's score is the share of its voxels' counts that
  /// agree with its class.
  [[nodiscard]] LabelledSurface Surface() const override;
  /// The submap of a point: of those that have observed its voxel and own it, the one with the smallest distance to the
  /// surface stored there.
  [[nodiscard]] std::optional<PointLabels> LabelsAt(std::span<const Eigen::Vector3f> points_m) const override;
  [[nodiscard]] SystemTimes times() const override { return times_; }

  [[nodiscard]] const PanmapSubmaps& submaps() const { return submaps_; }

 private:
  void UpdateActivity();
  const std::vector<SegmentBundles>& Bundle(const PanopticFrame& frame);

  std::string name_;
  SystemSetup setup_;
  PanmapSettings settings_;
  ThreadPool pool_;
  Bundler bundler_;
  PanmapTracker tracker_;
  ProjectiveIntegrator integrator_;
  PanmapSubmaps submaps_;
  SubmapId next_id_{1};
  SystemTimes times_;
};

}  // namespace dhpmap::evaluator
