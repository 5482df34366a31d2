// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/panoptic_score.h"

#include <gtest/gtest.h>

#include <algorithm>

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

PanopticScore ScoreOf(const std::vector<RunOf>& runs, std::int64_t min_elements = 0) {
  return ScorePanoptics(CountSegments(Elements(runs)), testing::ThreeClasses(), min_elements);
}

TEST(PanopticScore, AgreesWithACountByHand) {
  const ElementLabel p{0, 1}, q{0, 2};
  const PanopticScore score = ScoreOf({{80, kBallA, p},
                                       {20, kBallA, kMissing},
                                       {10, kBallB, p},
                                       {60, kBallB, q},
                                       {30, kBallB, kMissing},
                                       {40, kFloor, ElementLabel{0, 3}},
                                       {60, kFloor, kFloor}});
  const ClassPanoptic& ball = score.classes[0];
  EXPECT_EQ(ball.num_matched, 2);
  EXPECT_EQ(ball.num_false, 1) << "a ball on the floor";
  EXPECT_EQ(ball.num_missed, 0);
  EXPECT_DOUBLE_EQ(ball.sq(), (80.0 / 110 + 0.6) / 2);
  EXPECT_DOUBLE_EQ(ball.rq(), 2 / 2.5);
  EXPECT_DOUBLE_EQ(ball.pq(), ball.sq() * ball.rq());
  EXPECT_DOUBLE_EQ(score.classes[2].pq(), 0.6);
  EXPECT_DOUBLE_EQ(score.all.pq, (ball.pq() + 0.6) / 2);
  EXPECT_DOUBLE_EQ(score.things.pq, ball.pq());
  EXPECT_DOUBLE_EQ(score.stuff.pq, 0.6);
  EXPECT_EQ(score.all.num_classes, 2) << "there is no box";
  EXPECT_TRUE(score.matches.contains({kBallA, p}));
  EXPECT_FALSE(score.matches.contains({kBallB, p}));
}

TEST(PanopticScore, IsOneForAPerfectPredictionWhateverTheIds) {
  for (const std::uint32_t shift : {0u, 1u, 1000u}) {
    const auto renamed = [shift](ElementLabel label) {
      return ElementLabel{label.class_index, 31 - label.instance + shift};
    };
    const PanopticScore score = ScoreOf({{50, kBallA, renamed(kBallA)},
                                         {40, kBallB, renamed(kBallB)},
                                         {30, kBoxA, renamed(kBoxA)},
                                         {90, kFloor, kFloor}});
    EXPECT_DOUBLE_EQ(score.all.pq, 1);
    EXPECT_DOUBLE_EQ(score.all.sq, 1);
    EXPECT_DOUBLE_EQ(score.all.rq, 1);
    EXPECT_EQ(score.all.num_classes, 3);
  }
}

TEST(PanopticScore, DoesNotDependOnTheOrderOfElements) {
  auto elements = Elements({{70, kBallA, kBallA}, {30, kBallA, kBallB}, {55, kBallB, kBallB}, {45, kBoxA, kBallA}});
  const PanopticScore before = ScorePanoptics(CountSegments(elements), testing::ThreeClasses(), 0);
  std::reverse(elements.begin(), elements.end());
  const PanopticScore after = ScorePanoptics(CountSegments(elements), testing::ThreeClasses(), 0);
  EXPECT_DOUBLE_EQ(before.all.pq, after.all.pq);
}

TEST(PanopticScore, NeedsMoreThanHalf) {
  const PanopticScore half = ScoreOf({{50, kBallA, kBallA}, {50, kBallA, kMissing}});
  EXPECT_EQ(half.classes[0].num_matched, 0);
  EXPECT_EQ(half.classes[0].num_missed, 1);
  EXPECT_EQ(half.classes[0].num_false, 1);
  EXPECT_EQ(half.all.pq, 0);
  const PanopticScore more = ScoreOf({{51, kBallA, kBallA}, {49, kBallA, kMissing}});
  EXPECT_DOUBLE_EQ(more.all.pq, 0.51);
}

TEST(PanopticScore, GivesSwappedClassesNothing) {
  const PanopticScore score = ScoreOf({{50, kBallA, kBoxA}, {50, kBoxA, kBallA}, {50, kFloor, kFloor}});
  EXPECT_DOUBLE_EQ(score.all.pq, 1.0 / 3);
  EXPECT_EQ(score.classes[0].num_false, 1);
  EXPECT_EQ(score.classes[0].num_missed, 1);
}

TEST(PanopticScore, IgnoresSmallSegmentsThatMatchNothing) {
  const std::vector<RunOf> runs{
      {100, kBallA, kBallA}, {10, kBallB, kMissing}, {10, kFloor, kBallB}, {100, kFloor, kFloor}};
  EXPECT_DOUBLE_EQ(ScoreOf(runs, 30).classes[0].pq(), 1);
  EXPECT_DOUBLE_EQ(ScoreOf(runs, 0).classes[0].pq(), 0.5);
}

TEST(PanopticScore, KeepsSmallSegmentsThatMatch) {
  EXPECT_DOUBLE_EQ(ScoreOf({{10, kBoxA, kBoxA}}, 30).classes[1].pq(), 1);
}

TEST(PanopticScore, LeavesAClassWithOnlySmallMissedSegmentsOutOfTheMean) {
  const PanopticScore score = ScoreOf({{100, kBallA, kBallA}, {10, kBoxA, kMissing}}, 30);
  EXPECT_EQ(score.all.num_classes, 1);
  EXPECT_DOUBLE_EQ(score.all.pq, 1);
}

TEST(PanopticScore, IgnoresWhatIsNotJudged) {
  const PanopticScore score = ScoreOf({{100, kBallA, kBallA}, {500, kMissing, kBallA}, {500, kMissing, kBoxA}});
  EXPECT_DOUBLE_EQ(score.all.pq, 1);
}

}  // namespace
}  // namespace dhpmap::evaluator
