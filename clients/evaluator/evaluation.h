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

/// All numbers that decide a score; printed and stored with it.
struct Protocol {
  double spacing_m = 0.02;         ///< of the samples on both surfaces
  double d_match_m = 0.08;         ///< a sample of the ground truth takes no label from farther away
  std::int64_t min_elements = 30;  ///< smaller segments that match nothing count nowhere
  std::vector<double> precision_ious{0.3, 0.4, 0.5};
  GeometryLimits geometry;
};

/// Samples every half voxel, labels from up to two voxels away, F-score at one voxel but at least 5 cm.
Protocol ProtocolFor(double voxel_size_m);

/// The same for a truth of one element a cell: segments are ignored below the same area.
Protocol ProtocolForElements(Protocol protocol, double cell_m);

/// A data set's truth, which systems are compared with. Refers to itself: neither copied nor moved.
class Truth {
 public:
  /// The surface of a map.
  Truth(Mesh mesh, ClassMap classes, Protocol protocol);
  /// Points alone (see TruthPoints): there is no surface between them to measure to.
  Truth(SurfaceSamples points, ClassMap classes, Protocol protocol);
  Truth(const Truth&) = delete;
  Truth& operator=(const Truth&) = delete;

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }  ///< empty if the truth is points
  [[nodiscard]] const SurfaceSamples& samples() const { return samples_; }
  [[nodiscard]] const std::vector<ElementLabel>& labels() const { return labels_; }
  [[nodiscard]] const NearestSample& nearest() const { return nearest_; }
  [[nodiscard]] const ClassMap& classes() const { return classes_; }
  [[nodiscard]] const Protocol& protocol() const { return protocol_; }

  /// How many elements false surface of a sample counts for, the same for all systems; 1 unless it is set.
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

/// How many elements of the truth there are for a sample of a surface, where both are within protocol().d_match_m of
/// each other.
double ElementsASample(const Truth& truth, const SurfaceSamples& surface, ThreadPool& pool);

/// Label scores when surfaces where there are none are wrong, too.
struct WithFalseSurface {
  std::int64_t num_false = 0;  ///< elements that they count for (see FalseSurface)
  double pq = 0, mean_iou = 0;
};

/// Everything that is measured of one system on one data set.
struct Scores {
  std::string system;
  bool has_instances = true;
  SemanticScore semantics;
  PanopticScore panoptics;              ///< a system without instances: of each class, all is one segment
  std::vector<PrecisionAt> precisions;  ///< empty for a system without instances
  WithFalseSurface with_false;
  GeometryScore geometry;
  SystemTimes times;
};

/// `labels`, if not null, receives the predicted label of each sample of the truth.
Scores Evaluate(const Truth& truth, const LabelledSurface& surface, bool has_instances, ThreadPool& pool,
                std::vector<ElementLabel>* labels);

/// The same of what a system says of the truth's samples when it is asked there; geometry is not judged.
Scores EvaluateAsked(const Truth& truth, const PointLabels& asked,
                     const std::map<std::uint32_t, float>& instance_scores, bool has_instances);

}  // namespace dhpmap::evaluator
