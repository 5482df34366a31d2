// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/evaluation.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  const std::vector<Element> elements = Pair(truth.labels(), predicted_labels);
  const SegmentOverlap overlap = CountSegments(elements);

  Scores scores;
  scores.has_instances = has_instances;
  scores.semantics = ScoreSemantics(elements, truth.classes().classes().size());
  scores.panoptics = ScorePanoptics(overlap, truth.classes(), protocol.min_elements);
  if (has_instances) {
    for (const double iou : protocol.precision_ious) {
      scores.precisions.push_back(
          ScoreInstances(overlap, truth.classes(), surface.instance_scores, iou, protocol.min_elements));
    }
  }
  MeasureToTriangles(truth.samples().positions_m, surface.mesh, predicted, from_truth);
  if (!truth.mesh().triangles.empty()) {
    MeasureToTriangles(predicted.positions_m, truth.mesh(), truth.samples(), from_predicted);
  }
  scores.geometry = ScoreGeometry(from_predicted, from_truth, protocol.geometry);
  if (labels != nullptr) *labels = std::move(predicted_labels);
  return scores;
}

}  // namespace dhpmap::evaluator
