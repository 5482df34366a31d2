// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/elements.h"

#include <gtest/gtest.h>

#include "clients/evaluator/false_surface.h"
#include "tests/unit/clients/evaluator/labelled_elements.h"

namespace dhpmap::evaluator {
namespace {

using testing::kMissing;
using testing::ThreeClasses;

SurfaceSamples Samples(const std::vector<std::pair<std::uint16_t, std::uint32_t>>& labels) {
  SurfaceSamples samples;
  for (const auto& [class_id, instance] : labels) {
    samples.positions_m.emplace_back(0, 0, 0);
    samples.classes.push_back(class_id);
    samples.instances.push_back(instance);
  }
  return samples;
}

TEST(TruthLabels, JudgeOnlyClassesAndObjectsThatAreKnown) {
  const auto labels = TruthLabels(Samples({{1, 7}, {3, 8}, {9, 9}, {1, 0}}), ThreeClasses());
  EXPECT_EQ(labels[0], (ElementLabel{0, 7}));
  EXPECT_EQ(labels[1], (ElementLabel{2, 0})) << "stuff is one segment";
  EXPECT_EQ(labels[2], kMissing) << "a class that is not evaluated";
  EXPECT_EQ(labels[3], kMissing) << "the unknown submap";
}

TEST(PredictedLabels, ComeFromTheNeighbourWithinReach) {
  const SurfaceSamples predicted = Samples({{1, 7}, {2, 8}, {0, 0}, {9, 9}, {3, 5}});
  const std::vector<Neighbour> neighbours{{0, 0.0f}, {1, 0.08f}, {1, 0.081f}, {2, 0.0f}, {3, 0.0f}, {4, 0.0f}, {}};
  const auto labels = PredictedLabels(neighbours, predicted, ThreeClasses(), 0.08001, true);
  EXPECT_EQ(labels[0], (ElementLabel{0, 7}));
  EXPECT_EQ(labels[1], (ElementLabel{1, 8}));
  EXPECT_EQ(labels[2], kMissing) << "too far";
  EXPECT_EQ(labels[3], kMissing) << "does not say";
  EXPECT_EQ(labels[4], kMissing) << "not evaluated";
  EXPECT_EQ(labels[5], (ElementLabel{2, 0}));
  EXPECT_EQ(labels[6], kMissing);
}

TEST(PredictedLabels, AreOneSegmentAClassWithoutInstances) {
  const SurfaceSamples predicted = Samples({{1, 7}, {1, 8}});
  const auto labels =
      PredictedLabels(std::vector<Neighbour>{{0, 0.0f}, {1, 0.0f}}, predicted, ThreeClasses(), 1, false);
  EXPECT_EQ(labels[0], labels[1]);
}

TEST(FalseSurface, IsWhatIsFarFromAnyElementInElements) {
  const std::vector<Neighbour> from_predicted{{0, 0}, {1, 0.08f}, {3, 0.081f}, {3, 0.5f}, {}, {}, {}, {}};
  const ElementLabel ball{0, 7}, box{1, 8};
  const std::vector<ElementLabel> labels{ball, ball, box, box, ball, ball, ball, kMissing};
  EXPECT_EQ(FalseSurface(from_predicted, labels, 0.08001, 1), (LabelCounts{{ball, 3}, {box, 2}}));
  EXPECT_EQ(FalseSurface(from_predicted, labels, 0.08001, 0.25), (LabelCounts{{ball, 1}, {box, 1}}));
}

}  // namespace
}  // namespace dhpmap::evaluator
