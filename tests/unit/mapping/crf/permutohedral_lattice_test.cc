// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/permutohedral_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "mapping/crf/lattice_embedding.h"

namespace dhpmap {
namespace {

template <int D>
using Features = std::vector<std::array<float, D>>;

/// Uniform in a cube of so many kernel widths.
template <int D>
Features<D> RandomCloud(std::size_t num_points, float extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(0.0f, extent);
  Features<D> cloud(num_points);
  for (auto& feature : cloud) {
    for (float& x : feature) x = coordinate(random);
  }
  return cloud;
}

std::vector<float> RandomValues(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0.0f, 1.0f);
  std::vector<float> values(size);
  for (float& v : values) v = value(random);
  return values;
}

template <int D>
std::vector<float> ExactFilter(const Features<D>& cloud, const std::vector<float>& in, std::size_t channels) {
  std::vector<float> out(in.size());
  std::vector<double> sum(channels);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      double distance2 = 0;
      for (std::size_t k = 0; k < D; ++k) {
        distance2 += static_cast<double>(cloud[i][k] - cloud[j][k]) * (cloud[i][k] - cloud[j][k]);
      }
      const double weight = std::exp(-0.5 * distance2);
      for (std::size_t c = 0; c < channels; ++c) sum[c] += weight * in[j * channels + c];
    }
    for (std::size_t c = 0; c < channels; ++c) out[i * channels + c] = static_cast<float>(sum[c]);
  }
  return out;
}

template <int D>
std::vector<float> LatticeFilter(const Features<D>& cloud, const std::vector<float>& in, std::size_t channels,
                                 int num_threads = 1) {
  ThreadPool pool(num_threads);
  PermutohedralLattice<D> lattice;
  lattice.Build(cloud, pool);
  std::vector<float> out(in.size());
  lattice.Filter(in, channels, out, pool);
  return out;
}

double RelativeError(const std::vector<float>& values, const std::vector<float>& exact) {
  double error2 = 0, norm2 = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    error2 += std::pow(static_cast<double>(values[i]) - exact[i], 2);
    norm2 += std::pow(static_cast<double>(exact[i]), 2);
  }
  return std::sqrt(error2 / norm2);
}

/// Error of (K in) / (K 1) for a step along the first coordinate, the picture of an edge between two labels.
template <int D>
double NormalizedError(const Features<D>& cloud, float extent) {
  std::vector<float> step(cloud.size()), ones(cloud.size(), 1.0f);
  for (std::size_t i = 0; i < cloud.size(); ++i) step[i] = cloud[i][0] > extent / 2 ? 1.0f : 0.0f;
  std::vector<float> lattice = LatticeFilter<D>(cloud, step, 1), exact = ExactFilter<D>(cloud, step, 1);
  const std::vector<float> lattice_sum = LatticeFilter<D>(cloud, ones, 1), exact_sum = ExactFilter<D>(cloud, ones, 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    lattice[i] /= lattice_sum[i];
    exact[i] /= exact_sum[i];
  }
  return RelativeError(lattice, exact);
}

TEST(LatticeEmbeddingTest, WeightsAreBarycentricAndCornersAreDistinct) {
  const LatticeEmbedding<6> embedding;
  for (const auto& feature : RandomCloud<6>(500, 50.0f, 1)) {
    Simplex<6> simplex;
    embedding.Embed(feature, simplex);
    float sum = 0;
    for (const float w : simplex.weights) {
      EXPECT_GE(w, -1e-4f);
      sum += w;
    }
    EXPECT_NEAR(sum, 1.0f, 1e-4f);
    EXPECT_EQ(std::set<LatticeKey<6>>(simplex.keys.begin(), simplex.keys.end()).size(), 7u);
  }
}

TEST(LatticeEmbeddingTest, OneStepAlongEveryAxisComesBackToTheStart) {
  // The axes' directions add up to zero.
  const LatticeEmbedding<3> embedding;
  Simplex<3> simplex;
  embedding.Embed({1.5f, -7.25f, 3.0f}, simplex);
  for (const LatticeKey<3> start : simplex.keys) {
    LatticeKey<3> key = start;
    for (int axis = 0; axis <= 3; ++axis) key = LatticeEmbedding<3>::Next(key, axis);
    EXPECT_EQ(key, start);
  }
}

TEST(PermutohedralLatticeTest, NormalizedFilterIsWithinAFewPercentOfExactSumsInSpace) {
  EXPECT_LT(NormalizedError<3>(RandomCloud<3>(4000, 8.0f, 2), 8.0f), 0.05);
}

TEST(PermutohedralLatticeTest, NormalizedFilterIsWithinAFewPercentOfExactSumsInSpaceAndColour) {
  EXPECT_LT(NormalizedError<6>(RandomCloud<6>(4000, 3.0f, 3), 3.0f), 0.08);
}

TEST(PermutohedralLatticeTest, SumsAreOfTheRightSizeButTooSmallByAConstant) {
  // What is splatted beyond the vertices that points touch is lost. The normalisation makes up for it.
  const auto mean_ratio = [](const std::vector<float>& sums, const std::vector<float>& exact) {
    double ratio = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) ratio += sums[i] / exact[i] / static_cast<double>(sums.size());
    return ratio;
  };
  const std::vector<float> ones(4000, 1.0f);
  const auto space = RandomCloud<3>(4000, 8.0f, 2);
  EXPECT_NEAR(mean_ratio(LatticeFilter<3>(space, ones, 1), ExactFilter<3>(space, ones, 1)), 0.8, 0.1);
  const auto space_and_color = RandomCloud<6>(4000, 3.0f, 3);
  EXPECT_NEAR(mean_ratio(LatticeFilter<6>(space_and_color, ones, 1), ExactFilter<6>(space_and_color, ones, 1)), 0.6,
              0.1);
}

TEST(PermutohedralLatticeTest, FilterIsLinear) {
  const auto cloud = RandomCloud<6>(1000, 4.0f, 4);
  const std::vector<float> a = RandomValues(1000, 5), b = RandomValues(1000, 6);
  std::vector<float> mixed(1000);
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = 2.0f * a[i] - 3.0f * b[i];
  const std::vector<float> filtered = LatticeFilter<6>(cloud, mixed, 1);
  const std::vector<float> filtered_a = LatticeFilter<6>(cloud, a, 1), filtered_b = LatticeFilter<6>(cloud, b, 1);
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    ASSERT_NEAR(filtered[i], 2.0f * filtered_a[i] - 3.0f * filtered_b[i], 1e-4f * (filtered_a[i] + filtered_b[i]));
  }
}

TEST(PermutohedralLatticeTest, FilterIsPositiveAndNearlySymmetric) {
  const auto cloud = RandomCloud<3>(60, 2.0f, 7);
  // One channel a point, so that the result is K itself.
  std::vector<float> identity(60 * 60, 0.0f);
  for (std::size_t i = 0; i < 60; ++i) identity[61 * i] = 1.0f;
  const std::vector<float> k = LatticeFilter<3>(cloud, identity, 60);
  double asymmetry2 = 0, norm2 = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_GT(k[61 * i], 0.0f);
    for (std::size_t j = 0; j < 60; ++j) {
      EXPECT_GE(k[60 * i + j], 0.0f);
      asymmetry2 += std::pow(k[60 * i + j] - k[60 * j + i], 2);
      norm2 += std::pow(k[60 * i + j], 2);
    }
  }
  EXPECT_LT(std::sqrt(asymmetry2 / norm2), 0.10);
}

TEST(PermutohedralLatticeTest, ChannelsDoNotInfluenceEachOther) {
  for (const std::size_t channels : {2u, 8u, 21u, 33u, 50u}) {
    const auto cloud = RandomCloud<6>(700, 3.0f, 8);
    const std::vector<float> in = RandomValues(700 * channels, 9);
    const std::vector<float> out = LatticeFilter<6>(cloud, in, channels);
    for (std::size_t c = 0; c < channels; ++c) {
      std::vector<float> one(700);
      for (std::size_t i = 0; i < 700; ++i) one[i] = in[i * channels + c];
      one = LatticeFilter<6>(cloud, one, 1);
      for (std::size_t i = 0; i < 700; ++i) ASSERT_EQ(out[i * channels + c], one[i]) << channels << " " << c;
    }
  }
}

TEST(PermutohedralLatticeTest, NormalizedLatticeHasRowsOfAboutTheWeight) {
  // D^-1/2 K D^-1/2 has the eigenvector D^1/2 to eigenvalue 1; where density varies little its rows sum up to 1.
  const auto cloud = RandomCloud<3>(5000, 5.0f, 10);
  ThreadPool pool(1);
  PermutohedralLattice<3> lattice;
  lattice.Build(cloud, pool);
  lattice.Normalize(2.5f, pool);
  const std::vector<float> ones(5000, 1.0f);
  std::vector<float> sums(5000);
  lattice.Filter(ones, 1, sums, pool);
  double mean = 0;
  for (const float s : sums) mean += s / 5000.0;
  EXPECT_NEAR(mean, 2.5, 0.05);
}

TEST(PermutohedralLatticeTest, OrderOfPointsDoesNotMatter) {
  // 20,000 points are several chunks, whose common vertices are joined in another way when points change places.
  auto cloud = RandomCloud<6>(20000, 4.0f, 11);
  std::vector<float> in = RandomValues(20000, 12);
  const std::vector<float> out = LatticeFilter<6>(cloud, in, 1);
  std::vector<std::size_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(13));
  Features<6> shuffled_cloud;
  std::vector<float> shuffled_in;
  for (const std::size_t i : order) {
    shuffled_cloud.push_back(cloud[i]);
    shuffled_in.push_back(in[i]);
  }
  const std::vector<float> shuffled_out = LatticeFilter<6>(shuffled_cloud, shuffled_in, 1);
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_NEAR(shuffled_out[i], out[order[i]], 1e-4f * out[order[i]]);
}

TEST(PermutohedralLatticeTest, ThreadsDoNotChangeABit) {
  const auto cloud = RandomCloud<6>(30000, 6.0f, 14);
  const std::vector<float> in = RandomValues(30000 * 5, 15);
  const std::vector<float> out = LatticeFilter<6>(cloud, in, 5, 1);
  EXPECT_EQ(LatticeFilter<6>(cloud, in, 5, 2), out);
  EXPECT_EQ(LatticeFilter<6>(cloud, in, 5, 3), out);
}

TEST(PermutohedralLatticeTest, CanBeBuiltAgainOnOtherPoints) {
  ThreadPool pool(2);
  PermutohedralLattice<3> lattice;
  for (const std::size_t num_points : {9000u, 10u, 0u, 20000u, 1u}) {
    const auto cloud = RandomCloud<3>(num_points, 5.0f, static_cast<unsigned>(num_points));
    const std::vector<float> in = RandomValues(num_points, 16);
    std::vector<float> out(num_points);
    lattice.Build(cloud, pool);
    lattice.Filter(in, 1, out, pool);
    EXPECT_EQ(out, LatticeFilter<3>(cloud, in, 1));
  }
}

TEST(PermutohedralLatticeTest, IdenticalPointsAreSummed) {
  const Features<6> cloud(1000, {1.0f, -2.0f, 3.0f, 4.0f, 5.0f, 6.0f});
  const std::vector<float> ones(1000, 1.0f);
  const float alone = LatticeFilter<6>({cloud[0]}, {1.0f}, 1)[0];
  for (const float sum : LatticeFilter<6>(cloud, ones, 1)) ASSERT_NEAR(sum, 1000.0f * alone, 0.1f);
}

}  // namespace
}  // namespace dhpmap
