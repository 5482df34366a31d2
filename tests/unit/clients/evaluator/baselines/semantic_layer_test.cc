// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/semantic_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dhpmap::evaluator {
namespace {

constexpr ClassId kChair{7}, kTable{9}, kLamp{3};
constexpr VoxelIndex kHere{-5, 12, 700}, kElsewhere{-5, 12, 701};

using Labels = std::vector<LabelFrequency>;

TEST(BayesianLayerTest, AddsTheRowsOfTheConfusionMatrix) {
  BayesianLayer layer(0.8);
  layer.Observe(kHere, Labels{{kChair, 2}, {kTable, 1}});
  layer.Observe(kHere, Labels{{kTable, 1}});
  layer.Observe(kHere, Labels{{kLamp, 1}});
  // Five points: two chairs, two tables, one lamp; each is a hit for its own class and a miss for all others.
  const double hit = std::log(0.8), miss = std::log(0.2);
  EXPECT_NEAR(layer.LogProbability(kHere, kChair), 2 * hit + 3 * miss, 1e-12);
  EXPECT_NEAR(layer.LogProbability(kHere, kTable), 2 * hit + 3 * miss, 1e-12);
  EXPECT_NEAR(layer.LogProbability(kHere, kLamp), 1 * hit + 4 * miss, 1e-12);
  EXPECT_NEAR(layer.LogProbability(kHere, ClassId(1000)), 5 * miss, 1e-12);  // never seen, in no list
}

TEST(BayesianLayerTest, LabelIsTheMostProbableClassAndTiesGoToTheSmaller) {
  BayesianLayer layer(0.8);
  layer.Observe(kHere, Labels{{kTable, 3}});
  EXPECT_EQ(layer.LabelAt(kHere), kTable);
  layer.Observe(kHere, Labels{{kChair, 3}});
  EXPECT_EQ(layer.LabelAt(kHere), kChair);
  layer.Observe(kHere, Labels{{kTable, 1}});
  EXPECT_EQ(layer.LabelAt(kHere), kTable);
}

TEST(BayesianLayerTest, UnknownLabelsChangeNothing) {
  BayesianLayer layer(0.8);
  layer.Observe(kHere, {});
  EXPECT_EQ(layer.LabelAt(kHere), std::nullopt);
  EXPECT_EQ(layer.LogProbability(kHere, kChair), 0.0);
  layer.Observe(kHere, Labels{{kChair, 1}});
  const double before = layer.LogProbability(kHere, kChair);
  layer.Observe(kHere, {});
  EXPECT_EQ(layer.LogProbability(kHere, kChair), before);
  EXPECT_EQ(layer.LabelAt(kElsewhere), std::nullopt);
}

TEST(VoteLayerTest, EachRayVotesOnceForTheClassOfMostOfItsPoints) {
  VoteLayer layer;
  layer.Observe(kHere, Labels{{kChair, 4}, {kTable, 40}});
  layer.Observe(kHere, Labels{{kLamp, 1}});
  layer.Observe(kHere, Labels{{kLamp, 2}, {kTable, 1}});
  EXPECT_EQ(layer.LabelAt(kHere), kLamp);
}

TEST(VoteLayerTest, TiesGoToTheSmallerClassAndUnknownHasNoVote) {
  VoteLayer layer;
  layer.Observe(kHere, {});
  EXPECT_EQ(layer.LabelAt(kHere), std::nullopt);
  layer.Observe(kHere, Labels{{kTable, 1}});
  EXPECT_EQ(layer.LabelAt(kHere), kTable);
  layer.Observe(kHere, Labels{{kChair, 1}, {kTable, 1}});  // a tie among points, and then among rays
  EXPECT_EQ(layer.LabelAt(kHere), kChair);
  EXPECT_EQ(layer.LabelAt(kElsewhere), std::nullopt);
}

}  // namespace
}  // namespace dhpmap::evaluator
