// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/instance_score.h"

#include <gtest/gtest.h>

#include "tests/unit/clients/evaluator/labelled_elements.h"

namespace dhpmap::evaluator {
namespace {

using testing::Elements;
using testing::kBallA;
using testing::kBallB;
using testing::kBoxA;
using testing::kFloor;
using testing::kMissing;
using testing::RunOf;

PrecisionAt PrecisionOf(const std::vector<RunOf>& runs, double iou, const std::map<std::uint32_t, float>& scores = {},
                        std::int64_t min_elements = 0) {
  return ScoreInstances(CountSegments(Elements(runs)), testing::ThreeClasses(), scores, iou, min_elements);
}

TEST(AreaBelowCurve, AgreesWithACountByHand) {
  EXPECT_DOUBLE_EQ(AreaBelowCurve({true, false, true}, 3), (1 + 2.0 / 3) / 3);
  EXPECT_DOUBLE_EQ(AreaBelowCurve({false, true, true}, 2), 2.0 / 3) << "precision only falls with recall";
  EXPECT_DOUBLE_EQ(AreaBelowCurve({true, true}, 2), 1);
  EXPECT_DOUBLE_EQ(AreaBelowCurve({false, false}, 2), 0);
  EXPECT_DOUBLE_EQ(AreaBelowCurve({}, 2), 0);
}

TEST(InstanceScore, IsOneForAPerfectPredictionWhateverTheIds) {
  const PrecisionAt at =
      PrecisionOf({{50, kBallA, {0, 3}}, {50, kBallB, {0, 1}}, {10, kBoxA, {1, 2}}, {50, kFloor, kFloor}}, 0.5);
  EXPECT_DOUBLE_EQ(at.mean, 1);
  EXPECT_DOUBLE_EQ(*at.classes[0], 1);
  EXPECT_DOUBLE_EQ(*at.classes[1], 1);
  EXPECT_FALSE(at.classes[2].has_value()) << "stuff has no instances";
}

TEST(InstanceScore, RanksBySureness) {
  const std::vector<RunOf> runs{{50, kBallA, {0, 1}}, {50, kBoxA, {0, 2}}};
  EXPECT_DOUBLE_EQ(*PrecisionOf(runs, 0.5, {{1, 0.9f}, {2, 0.5f}}).classes[0], 1);
  EXPECT_DOUBLE_EQ(*PrecisionOf(runs, 0.5, {{1, 0.5f}, {2, 0.9f}}).classes[0], 0.5);
}

TEST(InstanceScore, GivesAnObjectToOnePredictionOnly) {
  const std::vector<RunOf> runs{{60, kBallA, {0, 1}}, {40, kBallA, {0, 2}}, {50, kBallB, kMissing}};
  EXPECT_DOUBLE_EQ(*PrecisionOf(runs, 0.3, {{1, 0.9f}, {2, 0.5f}}).classes[0], 0.5);
  EXPECT_DOUBLE_EQ(*PrecisionOf(runs, 0.5, {{1, 0.9f}, {2, 0.5f}}).classes[0], 0.5);
  EXPECT_DOUBLE_EQ(*PrecisionOf(runs, 0.5, {{1, 0.5f}, {2, 0.9f}}).classes[0], 0.25);
}

TEST(InstanceScore, CountsFromTheIouOn) {
  const std::vector<RunOf> runs{{40, kBallA, {0, 1}}, {60, kBallA, kMissing}};
  EXPECT_DOUBLE_EQ(PrecisionOf(runs, 0.4).mean, 1);
  EXPECT_DOUBLE_EQ(PrecisionOf(runs, 0.41).mean, 0);
}

TEST(InstanceScore, IsTheMeanOverThePresentClasses) {
  EXPECT_DOUBLE_EQ(PrecisionOf({{50, kBallA, {0, 1}}, {50, kBoxA, kMissing}}, 0.5).mean, 0.5);
  EXPECT_DOUBLE_EQ(PrecisionOf({{50, kBallA, {0, 1}}}, 0.5).mean, 1);
}

TEST(InstanceScore, IgnoresSmallObjectsAndWhatMatchesThem) {
  const std::vector<RunOf> runs{{50, kBallA, {0, 1}}, {20, kBallB, {0, 2}}, {15, kFloor, {0, 2}}};
  EXPECT_DOUBLE_EQ(*PrecisionOf(runs, 0.5, {{1, 0.5f}, {2, 0.9f}}, 30).classes[0], 1);
}

}  // namespace
}  // namespace dhpmap::evaluator
