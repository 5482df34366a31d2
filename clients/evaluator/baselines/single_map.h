// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/evaluator/baselines/merged_rays.h"
#include "clients/evaluator/baselines/semantic_layer.h"
#include "clients/evaluator/mapping_system.h"
#include "mapping/submap/submap.h"

namespace dhpmap::evaluator {

/// One TSDF for everything, with a class at each voxel and no instances: rays merged by end voxel, as in Kimera.
class SingleMap final : public MappingSystem {
 public:
  SingleMap(std::string name, const SystemSetup& setup, std::unique_ptr<SemanticLayer> labels);

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] bool has_instances() const override { return false; }
  Status Integrate(const PanopticFrame& frame) override;
  void Finish() override { map_.UpdateBoundingSphere(); }
  /// A vertex has the class of the nearer of the two voxels between which it lies, if that has a label.
  [[nodiscard]] LabelledSurface Surface() const override;
  [[nodiscard]] std::optional<PointLabels> LabelsAt(std::span<const Eigen::Vector3f> points_m) const override;
  [[nodiscard]] SystemTimes times() const override { return times_; }

 private:
  void Fuse(const SegmentBundles& rays, const RayOrigin& origin);
  [[nodiscard]] ClassId LabelNear(const Eigen::Vector3f& vertex_m) const;

  std::string name_;
  SystemSetup setup_;
  ThreadPool pool_;
  MergedRays rays_;
  Submap map_;
  std::unique_ptr<SemanticLayer> labels_;
  SystemTimes times_;
};

}  // namespace dhpmap::evaluator
