// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "clients/evaluator/class_map.h"
#include "clients/evaluator/elements.h"
#include "clients/evaluator/geometry_score.h"
#include "clients/evaluator/instance_score.h"
#include "clients/evaluator/mapping_system.h"
#include "clients/evaluator/panoptic_score.h"
#include "clients/evaluator/semantic_score.h"

namespace dhpmap::evaluator {

/// All parameters that affect scores; printed and stored with them.
struct Protocol {
  double spacing_m = 0.02;         ///< of the samples on both surfaces
  double d_match_m = 0.08;         ///< farthest predicted sample from which a sample of the ground truth takes its
                                   ///< label
  std::int64_t min_elements = 30;  ///< smaller segments without a match do not count
  std::vector<double> precision_ious{0.3, 0.4, 0.5};
  GeometryLimits geometry;
};

/// Samples every half voxel, labels from up to two voxels away, F-score at one voxel but at least 5 cm.
Protocol ProtocolFor(double voxel_size_m);

/// The same for a ground truth of one element per cell: segments are ignored below the same area.
Protocol ProtocolForElements(Protocol protocol, double cell_m);

/// The ground truth of a data set. Refers to its own members: neither copied nor moved.
class Truth {
 public:
  /// From the surface of a map.
  Truth(Mesh mesh, ClassMap classes, Protocol protocol);
  /// From points alone (see TruthPoints): there is no surface between them to measure distances to.
  Truth(SurfaceSamples points, ClassMap classes, Protocol protocol);
  Truth(const Truth&) = delete;
  Truth& operator=(const Truth&) = delete;

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }  ///< empty if the truth consists of points
  [[nodiscard]] const SurfaceSamples& samples() const { return samples_; }
  [[nodiscard]] const std::vector<ElementLabel>& labels() const { return labels_; }
  [[nodiscard]] const NearestSample& nearest() const { return nearest_; }
  [[nodiscard]] const ClassMap& classes() const { return classes_; }
  [[nodiscard]] const Protocol& protocol() const { return protocol_; }

  /// The number of elements that a false sample counts for, equal for all systems; 1 by default.
  [[nodiscard]] double elements_a_sample() const { return elements_a_sample_; }
  void set_elements_a_sample(double elements) { elements_a_sample_ = elements; }

 private:
  Mesh mesh_;
  ClassMap classes_;
  Protocol protocol_;
  SurfaceSamples samples_;
  std::vector<ElementLabel> labels_;
  NearestSample nearest_;
  double elements_a_sample_ = 1;
};

/// The number of elements of the truth per sample of a surface, over those within protocol().d_match_m of each other.
double ElementsASample(const Truth& truth, const SurfaceSamples& surface, ThreadPool& pool);

/// Label scores that also penalise false surfaces.
struct WithFalseSurface {
  std::int64_t num_false = 0;  ///< number of elements that they count for (see FalseSurface)
  double pq = 0, mean_iou = 0;
};

/// All scores of one system on one data set.
struct Scores {
  std::string system;
  bool has_instances = true;
  SemanticScore semantics;
  PanopticScore panoptics;              ///< for a system without instances each class is one segment
  std::vector<PrecisionAt> precisions;  ///< empty for a system without instances
  WithFalseSurface with_false;
  GeometryScore geometry;
  SystemTimes times;
};

/// `labels`, if not null, receives the predicted label of each sample of the truth.
Scores Evaluate(const Truth& truth, const LabelledSurface& surface, bool has_instances, ThreadPool& pool,
                std::vector<ElementLabel>* labels);

/// The same for the system's answers at the truth's samples; without geometry.
Scores EvaluateAsked(const Truth& truth, const PointLabels& asked,
                     const std::map<std::uint32_t, float>& instance_scores, bool has_instances);

}  // namespace dhpmap::evaluator
