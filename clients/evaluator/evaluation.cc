// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/evaluation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clients/evaluator/false_surface.h"
#include "clients/evaluator/triangle_distance.h"

namespace dhpmap::evaluator {

Protocol ProtocolFor(double voxel_size_m) {
  Protocol protocol;
  protocol.spacing_m = 0.5 * voxel_size_m;
  protocol.d_match_m = 2 * voxel_size_m;
  protocol.geometry.threshold_m = std::max(0.05, voxel_size_m);
  return protocol;
}

Protocol ProtocolForElements(Protocol protocol, double cell_m) {
  const double share = protocol.spacing_m / cell_m;
  protocol.min_elements =
      std::max<std::int64_t>(1, std::llround(share * share * static_cast<double>(protocol.min_elements)));
  return protocol;
}

Truth::Truth(Mesh mesh, ClassMap classes, Protocol protocol)
    : mesh_(std::move(mesh)),
      classes_(std::move(classes)),
      protocol_(std::move(protocol)),
      samples_(SampleSurface(mesh_, protocol_.spacing_m)),
      labels_(TruthLabels(samples_, classes_)),
      nearest_(samples_.positions_m) {}

Truth::Truth(SurfaceSamples points, ClassMap classes, Protocol protocol)
    : classes_(std::move(classes)),
      protocol_(std::move(protocol)),
      samples_(std::move(points)),
      labels_(TruthLabels(samples_, classes_)),
      nearest_(samples_.positions_m) {}

namespace {

Scores ScoreLabels(const Truth& truth, const std::vector<ElementLabel>& predicted, const SegmentOverlap& overlap,
                   const std::map<std::uint32_t, float>& instance_scores, bool has_instances) {
  const Protocol& protocol = truth.protocol();
  Scores scores;
  scores.has_instances = has_instances;
  scores.semantics = ScoreSemantics(Pair(truth.labels(), predicted), truth.classes().classes().size());
  scores.panoptics = ScorePanoptics(overlap, truth.classes(), protocol.min_elements);
  if (!has_instances) return scores;
  for (const double iou : protocol.precision_ious) {
    scores.precisions.push_back(ScoreInstances(overlap, truth.classes(), instance_scores, iou, protocol.min_elements));
  }
  return scores;
}

WithFalseSurface ScoreWithFalse(const Truth& truth, const LabelCounts& nowhere, SemanticScore semantics,
                                SegmentOverlap& overlap) {
  WithFalseSurface scores;
  for (const auto& [label, count] : nowhere) {
    scores.num_false += count;
    overlap.predicted[label] += count;
    semantics.classes[static_cast<std::size_t>(label.class_index)].num_predicted += count;
  }
  scores.pq = ScorePanoptics(overlap, truth.classes(), truth.protocol().min_elements).all.pq;
  scores.mean_iou = MeanIou(semantics.classes);
  return scores;
}

}  // namespace

double ElementsASample(const Truth& truth, const SurfaceSamples& surface, ThreadPool& pool) {
  const double reach_m = truth.protocol().d_match_m;
  const auto num_near = [](const std::vector<Neighbour>& all) {
    return std::count_if(all.begin(), all.end(), [](const Neighbour& n) { return n.exists(); });
  };
  const auto num_elements =
      num_near(NearestSample(surface.positions_m).FindAll(truth.samples().positions_m, reach_m, pool));
  const auto num_samples = num_near(truth.nearest().FindAll(surface.positions_m, reach_m, pool));
  return num_samples == 0 ? 1.0 : static_cast<double>(num_elements) / static_cast<double>(num_samples);
}

Scores EvaluateAsked(const Truth& truth, const PointLabels& asked,
                     const std::map<std::uint32_t, float>& instance_scores, bool has_instances) {
  const std::vector<ElementLabel> labels = LabelsOf(asked.classes, asked.instances, truth.classes(), has_instances);
  return ScoreLabels(truth, labels, CountSegments(Pair(truth.labels(), labels)), instance_scores, has_instances);
}

Scores Evaluate(const Truth& truth, const LabelledSurface& surface, bool has_instances, ThreadPool& pool,
                std::vector<ElementLabel>* labels) {
  const Protocol& protocol = truth.protocol();
  const double reach_m = std::max(protocol.geometry.reach_m(), protocol.d_match_m);
  const SurfaceSamples predicted = SampleSurface(surface.mesh, protocol.spacing_m);
  std::vector<Neighbour> from_truth =
      NearestSample(predicted.positions_m).FindAll(truth.samples().positions_m, reach_m, pool);
  std::vector<Neighbour> from_predicted = truth.nearest().FindAll(predicted.positions_m, reach_m, pool);

  std::vector<ElementLabel> predicted_labels =
      PredictedLabels(from_truth, predicted, truth.classes(), protocol.d_match_m, has_instances);
  SegmentOverlap overlap = CountSegments(Pair(truth.labels(), predicted_labels));
  Scores scores = ScoreLabels(truth, predicted_labels, overlap, surface.instance_scores, has_instances);
  const LabelCounts nowhere =
      FalseSurface(from_predicted, LabelsOf(predicted.classes, predicted.instances, truth.classes(), has_instances),
                   protocol.d_match_m, truth.elements_a_sample());
  scores.with_false = ScoreWithFalse(truth, nowhere, scores.semantics, overlap);
  MeasureToTriangles(truth.samples().positions_m, surface.mesh, predicted, from_truth);
  if (!truth.mesh().triangles.empty()) {
    MeasureToTriangles(predicted.positions_m, truth.mesh(), truth.samples(), from_predicted);
  }
  scores.geometry = ScoreGeometry(from_predicted, from_truth, protocol.geometry);
  scores.geometry.covered = ShareCovered(from_truth, truth.labels(), protocol.d_match_m);
  if (labels != nullptr) *labels = std::move(predicted_labels);
  return scores;
}

}  // namespace dhpmap::evaluator
