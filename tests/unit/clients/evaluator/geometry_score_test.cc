// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/geometry_score.h"

#include <gtest/gtest.h>

namespace dhpmap::evaluator {
namespace {

constexpr GeometryLimits kLimits{.threshold_m = 0.05, .accuracy_truncation_m = 0.5, .completion_truncation_m = 2.0};

std::vector<Neighbour> At(const std::vector<float>& distances_m) {
  std::vector<Neighbour> neighbours;
  for (const float d : distances_m) neighbours.push_back(d < 0 ? Neighbour{} : Neighbour{0, d});
  return neighbours;
}

TEST(GeometryScore, AgreesWithACountByHand) {
  const GeometryScore score = ScoreGeometry(At({0, 0.04f, 0.08f, 1.0f, -1}), At({0, 0.09f, -1}), kLimits);
  EXPECT_NEAR(score.accuracy_m, 0.12 / 3, 1e-7) << "far samples do not count";
  EXPECT_NEAR(score.completion_m, (0.09 + 2.0) / 3, 1e-7) << "missing ones count as the clip";
  EXPECT_NEAR(score.chamfer_l1_m(), (0.04 + 2.09 / 3) / 2, 1e-7);
  EXPECT_DOUBLE_EQ(score.precision, 2.0 / 5);
  EXPECT_DOUBLE_EQ(score.recall, 1.0 / 3);
  EXPECT_DOUBLE_EQ(score.f_score(), 2 * 0.4 / 3 / (0.4 + 1.0 / 3));
}

TEST(GeometryScore, OnlyLabelledSamplesAreToBeCovered) {
  const std::vector<ElementLabel> truth{{.class_index = 0}, {.class_index = 2}, {}, {.class_index = 1}};
  EXPECT_DOUBLE_EQ(ShareCovered(At({0, 0.09f, 0, -1}), truth, 0.1), 2.0 / 3);
  EXPECT_DOUBLE_EQ(ShareCovered(At({0, 0.11f, 0, -1}), truth, 0.1), 1.0 / 3);
}

TEST(GeometryScore, IsPerfectForTheSameSurface) {
  const GeometryScore score = ScoreGeometry(At({0, 0}), At({0, 0, 0}), kLimits);
  EXPECT_EQ(score.chamfer_l1_m(), 0);
  EXPECT_DOUBLE_EQ(score.f_score(), 1);
}

TEST(GeometryScore, ClipsLargeDistances) {
  EXPECT_DOUBLE_EQ(ScoreGeometry(At({0}), At({5.0f}), kLimits).completion_m, 2.0);
}

TEST(GeometryScore, OfAnEmptyPredictionIsTheWorst) {
  const GeometryScore score = ScoreGeometry({}, At({-1, -1}), kLimits);
  EXPECT_DOUBLE_EQ(score.accuracy_m, 0.5);
  EXPECT_DOUBLE_EQ(score.completion_m, 2.0);
  EXPECT_EQ(score.f_score(), 0);
}

}  // namespace
}  // namespace dhpmap::evaluator
