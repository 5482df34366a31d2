// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "clients/evaluator/baselines/semantic_layer.h"
#include "mapping/base/status.h"
#include "mapping/fusion/bundler.h"
#include "mapping/fusion/integrator.h"

namespace dhpmap::evaluator {

/// A frame in Kimera's merged mode: one ray for each voxel that contains points, regardless of their segments, with the
/// frequencies of the points' labels.
class MergedRays {
 public:
  MergedRays(const IntegrationConfig& config, ThreadPool& pool) : geometry_(config, pool), labelled_(config, pool) {}

  /// Computes the rays on the grid of the map frame. The frame must be valid. Results are valid until the next call.
  /// RESOURCE_EXHAUSTED, FRAME_TOO_LARGE: see CheckIsWhole; then there are no rays.
  [[nodiscard]] Status Assign(const PanopticFrame& frame, double voxel_size_m);

  /// All points as one segment; null if no point is in range.
  [[nodiscard]] const SegmentBundles* rays() const { return rays_; }
  /// The labels of one of rays()->bundles, by ascending class; empty if all its points are of unknown class.
  [[nodiscard]] std::span<const LabelFrequency> LabelsOf(std::size_t bundle) const {
    return std::span(labels_).subspan(first_label_[bundle], first_label_[bundle + 1] - first_label_[bundle]);
  }

 private:
  void CountLabels(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments);

  Bundler geometry_;
  Bundler labelled_;
  const SegmentBundles* rays_ = nullptr;
  std::vector<LabelFrequency> labels_;
  std::vector<std::size_t> first_label_;  // for each bundle, and the end
};

/// Observes the labels of each ray in every voxel that IntegrateSegment labels with that ray.
void ObserveLabels(const MergedRays& rays, const RayOrigin& origin, const MapConfig& config, SemanticLayer& layer);

}  // namespace dhpmap::evaluator
