// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/semantic_score.h"

#include <gtest/gtest.h>

#include "tests/unit/clients/evaluator/labelled_elements.h"

namespace dhpmap::evaluator {
namespace {

using testing::Elements;
using testing::kFloor;
using testing::kMissing;

constexpr ElementLabel kBall{0, 1}, kBox{1, 1};

TEST(SemanticScore, AgreesWithACountByHand) {
  const SemanticScore score = ScoreSemantics(
      Elements({{4, kBall, kBall}, {1, kBall, kBox}, {1, kBall, kMissing}, {3, kBox, kBox}, {1, kBox, kBall}}), 3);
  EXPECT_DOUBLE_EQ(score.classes[0].iou(), 4.0 / 7);
  EXPECT_DOUBLE_EQ(score.classes[1].iou(), 3.0 / 5);
  EXPECT_DOUBLE_EQ(score.mean_iou, (4.0 / 7 + 3.0 / 5) / 2) << "the absent class is not in the mean";
  EXPECT_DOUBLE_EQ(score.accuracy, 0.7);
  EXPECT_EQ(score.num_elements, 10);
  EXPECT_EQ(score.num_answered, 9);
}

TEST(SemanticScore, IsOneForAPerfectPrediction) {
  const SemanticScore score = ScoreSemantics(Elements({{5, kBall, kBall}, {7, kFloor, kFloor}}), 3);
  EXPECT_DOUBLE_EQ(score.mean_iou, 1);
  EXPECT_DOUBLE_EQ(score.accuracy, 1);
}

TEST(SemanticScore, IgnoresElementsThatAreNotJudged) {
  const auto judged = Elements({{3, kBall, kBall}, {1, kBox, kBall}});
  const auto more = Elements({{3, kBall, kBall}, {1, kBox, kBall}, {50, kMissing, kBall}, {50, kMissing, kMissing}});
  const SemanticScore a = ScoreSemantics(judged, 3), b = ScoreSemantics(more, 3);
  EXPECT_DOUBLE_EQ(a.mean_iou, b.mean_iou);
  EXPECT_DOUBLE_EQ(a.accuracy, b.accuracy);
  EXPECT_EQ(b.num_elements, 4);
}

TEST(SemanticScore, CountsAMissingHalfAsWrong) {
  const SemanticScore score = ScoreSemantics(
      Elements({{5, kBall, kBall}, {5, kBall, kMissing}, {8, kFloor, kFloor}, {8, kFloor, kMissing}}), 3);
  EXPECT_DOUBLE_EQ(score.mean_iou, 0.5);
  EXPECT_DOUBLE_EQ(score.accuracy, 0.5);
}

TEST(SemanticScore, GivesSwappedClassesNothing) {
  const SemanticScore score = ScoreSemantics(Elements({{5, kBall, kBox}, {5, kBox, kBall}, {10, kFloor, kFloor}}), 3);
  EXPECT_DOUBLE_EQ(score.mean_iou, 1.0 / 3);
  EXPECT_DOUBLE_EQ(score.accuracy, 0.5);
}

TEST(SemanticScore, PunishesAClassThatIsNotThereOnlyWhereItReplacesAnother) {
  const SemanticScore score = ScoreSemantics(Elements({{9, kBall, kBall}, {1, kBall, kBox}}), 3);
  EXPECT_DOUBLE_EQ(score.mean_iou, 0.9);
}

TEST(SemanticScore, OfNothingIsNothing) {
  const SemanticScore score = ScoreSemantics({}, 3);
  EXPECT_EQ(score.mean_iou, 0);
  EXPECT_EQ(score.accuracy, 0);
}

}  // namespace
}  // namespace dhpmap::evaluator
