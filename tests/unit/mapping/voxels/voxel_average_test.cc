// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/voxel_average.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

struct Observation {
  float distance_m, weight;
  Color color;
};

std::vector<Observation> RandomObservations(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> distance_m(-0.08f, 0.08f), weight(0.01f, 4.0f);
  std::uniform_int_distribution<int> channel(0, 255);
  std::vector<Observation> observations;
  for (int n = 0; n < count; ++n) {
    const auto byte = [&] { return static_cast<std::uint8_t>(channel(random)); };
    observations.push_back({distance_m(random), weight(random), {byte(), byte(), byte()}});
  }
  return observations;
}

/// sum(w x) / sum(w) in double, spelled out.
struct Truth {
  double weight = 0, distance_m = 0, red = 0;
  explicit Truth(const std::vector<Observation>& observations) {
    for (const Observation& o : observations) weight += o.weight;
    for (const Observation& o : observations) {
      distance_m += o.weight * o.distance_m / weight;
      red += o.weight * o.color.r / weight;
    }
  }
};

std::unique_ptr<TsdfBlock> BlockWith(const Observation& o, std::size_t i) {
  auto block = std::make_unique<TsdfBlock>();
  block->distance_m[i] = o.distance_m;
  block->weight[i] = o.weight;
  block->color[i] = o.color;
  return block;
}

TEST(RunningAverage, OfManyObservationsIsTheirWeightedMean) {
  const std::vector<Observation> observations = RandomObservations(50, 1);
  const Truth truth(observations);
  float distance_m = 0, weight = 0;
  for (const Observation& o : observations) {
    distance_m = RunningAverage(weight, o.weight)(distance_m, o.distance_m);
    weight += o.weight;
  }
  EXPECT_NEAR(distance_m, truth.distance_m, 1e-6);  // 50 roundings of values below 0.08, 4e-9 each
}

TEST(RunningAverage, OfTheFirstObservationIsThatObservation) {
  EXPECT_NEAR(RunningAverage(0, 3)(0.7f, 0.05f), 0.05f, 1e-8f) << "what weighs nothing says nothing";
  EXPECT_EQ(RunningAverage(0, 3).Channel(9, 200), 200);
}

TEST(RunningAverage, RoundsColoursToTheNearest) {
  EXPECT_EQ(RunningAverage(1, 1).Channel(10, 11), 11) << "10.5";
  EXPECT_EQ(RunningAverage(3, 1).Channel(10, 11), 10) << "10.25";
  EXPECT_EQ(RunningAverage(1e-3f, 1e3f).Channel(255, 255), 255);
}

TEST(MergedAverage, IsTheWeightedMeanAndKeepsTheSumOfWeights) {
  const std::vector<Observation> observations = RandomObservations(20, 2);
  const Truth truth(observations);
  MergedAverage<double> merged;
  for (const Observation& o : observations) merged.Add(*BlockWith(o, 77), 77);
  TsdfBlock block;
  merged.Store(block, 5);
  EXPECT_FLOAT_EQ(block.distance_m[5], static_cast<float>(truth.distance_m));
  EXPECT_FLOAT_EQ(block.weight[5], static_cast<float>(truth.weight));
  EXPECT_EQ(block.color[5].r, static_cast<int>(truth.red + 0.5));
  EXPECT_FALSE(block.IsObserved(77)) << "only the voxel that was asked for is written";
}

TEST(MergedAverage, OfOneHolderIsThatHolder) {
  for (const Observation& o : RandomObservations(200, 3)) {
    MergedAverage<double> merged;
    merged.Add(*BlockWith(o, 0), 0);
    TsdfBlock block;
    merged.Store(block, 0);
    EXPECT_EQ(block.distance_m[0], o.distance_m);
    EXPECT_EQ(block.weight[0], o.weight);
    EXPECT_EQ(block.color[0], o.color);
  }
}

}  // namespace
}  // namespace dhpmap
