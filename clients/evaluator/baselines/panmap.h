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

/// Panmap: panoptic submaps that live while they are tracked. Left out, since the data sets are of one session and
/// static: its submap of free space, and change detection. It is given what is cut of segments that lie apart
/// (SplitIntoParts, with the configuration's split_gap_vox), as our own pipeline is: it is no part of its method, but
/// helps.
class Panmap final : public MappingSystem {
 public:
  explicit Panmap(const SystemSetup& setup, std::string name = "panmap");

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] bool has_instances() const override { return true; }
  Status Integrate(const PanopticFrame& frame) override;
  /// Deactivates everything and merges until nothing changes.
  void Finish() override;
  /// All submaps' own surfaces, overlapping where submaps do. An instance's score is the share of its voxels' counts
  /// that say it is of its class.
  [[nodiscard]] LabelledSurface Surface() const override;
  /// Of the submaps that have observed the point's voxel and to which it belongs, the one whose surface is nearest by
  /// that voxel says.
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
