// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/dense_crf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr CrfKernel kSmoothness{.position_m = 0.10, .color = 0, .weight = 1.0};
constexpr CrfKernel kAppearance{.position_m = 0.30, .color = 20.0, .weight = 1.0};
// The messages of a kernel add up to about its weight, so this much outvotes unaries of a few units.
constexpr CrfKernel kStrongSmoothness{.position_m = 0.10, .color = 0, .weight = 3.0};
constexpr CrfKernel kStrongAppearance{.position_m = 0.30, .color = 20.0, .weight = 5.0};
constexpr CrfKernel kOff{.position_m = 0.10, .color = 20.0, .weight = 0.0};

struct Problem {
  std::vector<CrfPoint> points;
  std::vector<int> num_labels;
  std::vector<float> unaries;
  CrfKernel smoothness = kSmoothness, appearance = kAppearance;
  int iterations = 5;

  [[nodiscard]] std::size_t RowSize() const { return unaries.size() / std::max<std::size_t>(1, points.size()); }
};

std::vector<float> Solve(const Problem& problem, int num_threads = 1) {
  ThreadPool pool(num_threads);
  DenseCrf crf(pool);
  crf.SetPoints(problem.points, problem.smoothness, problem.appearance);
  std::vector<float> values = problem.unaries;
  crf.Infer(problem.num_labels, problem.iterations, values);
  return values;
}

/// w D^-1/2 K D^-1/2 with exact Gaussians; color 0: by position only.
std::vector<double> ExactKernel(const std::vector<CrfPoint>& points, const CrfKernel& config, bool use_color) {
  const std::size_t n = points.size();
  std::vector<double> k(n * n), sums(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Color a = points[i].color, b = points[j].color;
      double d2 = (points[i].position_m - points[j].position_m).cast<double>().squaredNorm() /
                  (config.position_m * config.position_m);
      const double color2 = std::pow(a.r - b.r, 2) + std::pow(a.g - b.g, 2) + std::pow(a.b - b.b, 2);
      if (use_color) d2 += color2 / (config.color * config.color);
      k[i * n + j] = std::exp(-0.5 * d2);
      sums[i] += k[i * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) k[i * n + j] *= config.weight / std::sqrt(sums[i] * sums[j]);
  }
  return k;
}

/// Mean field of a problem with one kind of labels, by its definition.
std::vector<float> SolveExactly(const Problem& problem) {
  const std::size_t n = problem.points.size(), num_labels = problem.RowSize();
  std::vector<double> kernel = ExactKernel(problem.points, problem.smoothness, false);
  const std::vector<double> appearance = ExactKernel(problem.points, problem.appearance, true);
  for (std::size_t i = 0; i < kernel.size(); ++i) kernel[i] += appearance[i];
  std::vector<double> q(n * num_labels, 0.0), message(n * num_labels, 0.0);
  for (int iteration = 0; iteration <= problem.iterations; ++iteration) {
    for (std::size_t i = 0; i < n && iteration > 0; ++i) {
      for (std::size_t l = 0; l < num_labels; ++l) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += kernel[i * n + j] * q[j * num_labels + l];
        message[i * num_labels + l] = sum;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      double total = 0;
      for (std::size_t l = i * num_labels; l < (i + 1) * num_labels; ++l) {
        total += q[l] = std::exp(message[l] - problem.unaries[l]);
      }
      for (std::size_t l = i * num_labels; l < (i + 1) * num_labels; ++l) q[l] /= total;
    }
  }
  return {q.begin(), q.end()};
}

int ArgMax(const std::vector<float>& values, std::size_t point, std::size_t row_size) {
  const auto row = values.begin() + static_cast<std::ptrdiff_t>(point * row_size);
  return static_cast<int>(std::max_element(row, row + static_cast<std::ptrdiff_t>(row_size)) - row);
}

Color NoisyColor(Color base, int noise, std::mt19937& random) {
  std::uniform_int_distribution<int> shift(-noise, noise);
  const auto add = [&](std::uint8_t c) { return static_cast<std::uint8_t>(std::clamp(c + shift(random), 0, 255)); };
  return {add(base.r), add(base.g), add(base.b)};
}

/// A slab of voxels of 4 cm; colour and true label by column.
template <typename ColorAt>
std::vector<CrfPoint> Slab(int side, int height, const ColorAt& color_at) {
  std::vector<CrfPoint> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < height; ++z) points.push_back({Eigen::Vector3f(x, y, z) * 0.04f, color_at(x, y)});
    }
  }
  return points;
}

/// Unaries of labels seen with probability `sure`, the rest shared by the others.
void AddUnaries(int label, int num_labels, double sure, std::vector<float>& unaries) {
  for (int l = 0; l < num_labels; ++l) {
    unaries.push_back(static_cast<float>(-std::log(l == label ? sure : (1 - sure) / (num_labels - 1))));
  }
}

int Flipped(int label, int num_labels, double probability, std::mt19937& random) {
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  if (chance(random) >= probability) return label;
  return (label + std::uniform_int_distribution<int>(1, num_labels - 1)(random)) % num_labels;
}

/// A slab with a checkerboard of labels 40 cm wide, each with its colour, and random unaries.
Problem SmallRandomProblem(unsigned seed) {
  std::mt19937 random(seed);
  const std::vector<Color> colors{{180, 60, 60}, {60, 160, 70}, {90, 90, 200}};
  Problem problem;
  const auto label_at = [](int x, int y) { return (x / 10 + y / 10) % 3; };
  problem.points = Slab(24, 2, [&](int x, int y) { return NoisyColor(colors[label_at(x, y)], 12, random); });
  problem.num_labels = {3};
  std::uniform_real_distribution<double> sure(0.4, 0.9);
  for (int x = 0; x < 24; ++x) {
    for (int y = 0; y < 24; ++y) {
      for (int z = 0; z < 2; ++z) {
        AddUnaries(Flipped(label_at(x, y), 3, 0.2, random), 3, sure(random), problem.unaries);
      }
    }
  }
  return problem;
}

TEST(DenseCrfTest, MarginalsEqualExactMeanFieldUpToTheLattice) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Problem problem = SmallRandomProblem(seed);
    const std::vector<float> values = Solve(problem), exact = SolveExactly(problem);
    double mean_error = 0, max_error = 0;
    int num_equal = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double error = std::abs(values[i] - exact[i]);
      mean_error += error / static_cast<double>(values.size());
      max_error = std::max(max_error, error);
    }
    for (std::size_t p = 0; p < problem.points.size(); ++p) num_equal += ArgMax(values, p, 3) == ArgMax(exact, p, 3);
    EXPECT_LT(mean_error, 0.01);
    EXPECT_LT(max_error, 0.08);
    EXPECT_GT(num_equal, 0.99 * static_cast<double>(problem.points.size()));
  }
}

TEST(DenseCrfTest, OneKernelAloneEqualsExactMeanFieldToo) {
  Problem problem = SmallRandomProblem(4);
  for (const bool appearance_only : {false, true}) {
    problem.smoothness.weight = appearance_only ? 0.0 : 2.0;
    problem.appearance.weight = appearance_only ? 2.0 : 0.0;
    const std::vector<float> values = Solve(problem), exact = SolveExactly(problem);
    double mean_error = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      mean_error += std::abs(values[i] - exact[i]) / static_cast<double>(values.size());
    }
    EXPECT_LT(mean_error, 0.015);
  }
}

TEST(DenseCrfTest, NoKernelOrNoIterationIsTheSoftmaxOfTheUnaries) {
  Problem problem = SmallRandomProblem(5);
  problem.iterations = 0;
  const std::vector<float> values = Solve(problem);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], std::exp(-problem.unaries[i]), 1e-5);
  problem.iterations = 5;
  problem.smoothness = problem.appearance = kOff;
  EXPECT_EQ(Solve(problem), values);
}

TEST(DenseCrfTest, RestoresASlabWithAFifthOfTheLabelsFlipped) {
  std::mt19937 random(6);
  Problem problem;
  problem.smoothness = kStrongSmoothness;
  problem.appearance = kStrongAppearance;
  problem.points = Slab(60, 4, [&](int, int) { return NoisyColor({120, 110, 90}, 15, random); });
  problem.num_labels = {5};
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    AddUnaries(Flipped(2, 5, 0.2, random), 5, 0.6, problem.unaries);
  }
  const std::vector<float> values = Solve(problem);
  int num_right = 0;
  for (std::size_t p = 0; p < problem.points.size(); ++p) num_right += ArgMax(values, p, 5) == 2;
  EXPECT_GT(num_right, 0.99 * static_cast<double>(problem.points.size()));
}

TEST(DenseCrfTest, DoesNotBleedAcrossAColourEdge) {
  std::mt19937 random(7);
  Problem problem;
  problem.smoothness = kStrongSmoothness;
  problem.appearance = kStrongAppearance;
  const auto label_at = [](int x) { return x < 30 ? 0 : 1; };
  problem.points = Slab(60, 4, [&](int x, int) {
    return NoisyColor(label_at(x) == 0 ? Color{170, 80, 60} : Color{60, 90, 170}, 10, random);
  });
  problem.num_labels = {2};
  for (const CrfPoint& point : problem.points) {
    const int x = static_cast<int>(std::lround(point.position_m.x() / 0.04f));
    AddUnaries(Flipped(label_at(x), 2, 0.2, random), 2, 0.65, problem.unaries);
  }
  const std::vector<float> values = Solve(problem);
  int num_right = 0, num_right_at_edge = 0, num_at_edge = 0;
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const int x = static_cast<int>(std::lround(problem.points[p].position_m.x() / 0.04f));
    const bool is_right = ArgMax(values, p, 2) == label_at(x), is_at_edge = x >= 28 && x < 32;
    num_right += is_right;
    num_at_edge += is_at_edge;
    num_right_at_edge += is_at_edge && is_right;
  }
  EXPECT_GT(num_right, 0.99 * static_cast<double>(problem.points.size()));
  EXPECT_GT(num_right_at_edge, 0.98 * num_at_edge);
}

TEST(DenseCrfTest, KindsOfLabelsDoNotInfluenceEachOther) {
  std::mt19937 random(8);
  for (const std::vector<int>& num_labels : std::vector<std::vector<int>>{{3, 9}, {8, 1, 21}, {1, 40}}) {
    Problem together = SmallRandomProblem(9);
    together.num_labels = num_labels;
    std::vector<Problem> alone(num_labels.size(), together);
    together.unaries.clear();
    for (std::size_t k = 0; k < alone.size(); ++k) {
      alone[k].num_labels = {num_labels[k]};
      alone[k].unaries.clear();
    }
    std::uniform_real_distribution<float> unary(0.0f, 3.0f);
    for (std::size_t p = 0; p < together.points.size(); ++p) {
      for (std::size_t k = 0; k < alone.size(); ++k) {
        for (int l = 0; l < num_labels[k]; ++l) {
          alone[k].unaries.push_back(unary(random));
          together.unaries.push_back(alone[k].unaries.back());
        }
      }
    }
    const std::vector<float> values = Solve(together);
    std::size_t first_label = 0;
    for (const Problem& kind : alone) {
      const std::vector<float> kind_values = Solve(kind);
      for (std::size_t p = 0; p < kind.points.size(); ++p) {
        for (std::size_t l = 0; l < kind.RowSize(); ++l) {
          ASSERT_NEAR(values[p * together.RowSize() + first_label + l], kind_values[p * kind.RowSize() + l], 1e-5f);
        }
      }
      first_label += kind.RowSize();
    }
  }
}

TEST(DenseCrfTest, AFirstChoiceThatAllShareStaysFirst) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Problem problem = SmallRandomProblem(seed);
    const std::size_t row_size = problem.RowSize();
    for (std::size_t p = 0; p < problem.points.size(); ++p) {
      const auto row = problem.unaries.begin() + static_cast<std::ptrdiff_t>(p * row_size);
      std::iter_swap(row, std::min_element(row, row + static_cast<std::ptrdiff_t>(row_size)));
    }
    problem.smoothness = kStrongSmoothness;
    problem.appearance = kStrongAppearance;
    const std::vector<float> marginals = Solve(problem);
    for (std::size_t p = 0; p < problem.points.size(); ++p) EXPECT_EQ(ArgMax(marginals, p, row_size), 0);
  }
}

TEST(DenseCrfTest, MarginalsAddUpToOne) {
  const Problem problem = SmallRandomProblem(10);
  const std::vector<float> values = Solve(problem);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    ASSERT_NEAR(values[3 * p] + values[3 * p + 1] + values[3 * p + 2], 1.0f, 1e-5f);
  }
}

TEST(DenseCrfTest, ImpossibleLabelsStayImpossible) {
  Problem problem = SmallRandomProblem(11);
  for (std::size_t p = 0; p < problem.points.size(); ++p) problem.unaries[3 * p + p % 3] = kInfinity;
  const std::vector<float> values = Solve(problem);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    ASSERT_EQ(values[3 * p + p % 3], 0.0f);
    ASSERT_NEAR(values[3 * p] + values[3 * p + 1] + values[3 * p + 2], 1.0f, 1e-5f);
  }
}

TEST(DenseCrfTest, APointThatKnowsNothingListensToItsSurroundings) {
  std::mt19937 random(12);
  Problem problem;
  problem.points = Slab(20, 2, [&](int, int) { return NoisyColor({100, 100, 100}, 5, random); });
  problem.num_labels = {4, 2};
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    for (int l = 0; l < 4; ++l) problem.unaries.push_back(p % 10 == 0 || l != 3 ? kInfinity : 0.0f);
    for (int l = 0; l < 2; ++l) {
      problem.unaries.push_back(p % 10 == 1 ? std::numeric_limits<float>::quiet_NaN() : (l == 1 ? 0.1f : 2.4f));
    }
  }
  const std::vector<float> values = Solve(problem);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    EXPECT_GT(values[6 * p + 3], 0.5f);
    EXPECT_GT(values[6 * p + 5], 0.5f);
    EXPECT_NEAR(values[6 * p] + values[6 * p + 1] + values[6 * p + 2] + values[6 * p + 3], 1.0f, 1e-5f);
    EXPECT_NEAR(values[6 * p + 4] + values[6 * p + 5], 1.0f, 1e-5f);
  }
}

TEST(DenseCrfTest, ExtremeUnariesAreSurvived) {
  Problem problem = SmallRandomProblem(13);
  const std::vector<float> extremes{-kInfinity, kInfinity, 1e38f, -1e38f, 0.0f, 1000.0f, -1000.0f};
  for (std::size_t i = 0; i < problem.unaries.size(); ++i) problem.unaries[i] = extremes[i % extremes.size()];
  const std::vector<float> values = Solve(problem);
  ASSERT_EQ(values.size(), problem.unaries.size());
  for (const float q : values) ASSERT_TRUE(q >= 0.0f && q <= 1.0f) << q;
}

/// A room's worth of points: enough for several chunks.
Problem LargeProblem() {
  std::mt19937 random(14);
  Problem problem;
  problem.points = Slab(100, 3, [&](int x, int y) {
    return NoisyColor({static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y), 90}, 20, random);
  });
  problem.num_labels = {5, 6};
  std::uniform_real_distribution<float> unary(0.0f, 3.0f);
  for (std::size_t i = 0; i < 11 * problem.points.size(); ++i) problem.unaries.push_back(unary(random));
  return problem;
}

TEST(DenseCrfTest, ThreadsDoNotChangeABit) {
  const Problem problem = LargeProblem();
  const std::vector<float> values = Solve(problem, 1);
  EXPECT_EQ(Solve(problem, 2), values);
  EXPECT_EQ(Solve(problem, 3), values);
}

TEST(DenseCrfTest, OrderOfPointsDoesNotMatter) {
  const Problem problem = LargeProblem();
  std::vector<std::size_t> order(problem.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(15));
  Problem shuffled = problem;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.points[i] = problem.points[order[i]];
    for (std::size_t l = 0; l < 11; ++l) shuffled.unaries[11 * i + l] = problem.unaries[11 * order[i] + l];
  }
  const std::vector<float> values = Solve(problem), shuffled_values = Solve(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t l = 0; l < 11; ++l) ASSERT_NEAR(shuffled_values[11 * i + l], values[11 * order[i] + l], 1e-4f);
  }
}

TEST(DenseCrfTest, AnObjectCanBeUsedAgain) {
  ThreadPool pool(2);
  DenseCrf crf(pool);
  const Problem large = LargeProblem(), small = SmallRandomProblem(16);
  for (const Problem* problem : {&large, &small, &large}) {
    crf.SetPoints(problem->points, problem->smoothness, problem->appearance);
    for (int again = 0; again < 2; ++again) {
      std::vector<float> values = problem->unaries;
      crf.Infer(problem->num_labels, problem->iterations, values);
      ASSERT_EQ(values, Solve(*problem));
    }
  }
  const CrfBuildReport report = crf.SetPoints(small.points, small.smoothness, kOff);
  EXPECT_GT(report.num_smoothness_vertices, 0u);
  EXPECT_EQ(report.num_appearance_vertices, 0u);
}

TEST(DenseCrfTest, NoPointsAndNoLabels) {
  Problem problem;
  problem.num_labels = {3};
  EXPECT_TRUE(Solve(problem).empty());
  problem = SmallRandomProblem(17);
  problem.num_labels = {};
  problem.unaries.clear();
  EXPECT_TRUE(Solve(problem).empty());
}

TEST(DenseCrfTest, OnePointFollowsItsUnaries) {
  const Problem problem{.points = {{{1.0f, 2.0f, 3.0f}, {10, 20, 30}}}, .num_labels = {2}, .unaries = {0.2f, 1.7f}};
  const std::vector<float> values = Solve(problem), exact = SolveExactly(problem);
  EXPECT_NEAR(values[0], exact[0], 1e-4f);
  EXPECT_NEAR(values[1], exact[1], 1e-4f);
}

TEST(DenseCrfTest, OneLabelIsCertain) {
  Problem problem = SmallRandomProblem(18);
  problem.num_labels = {1};
  problem.unaries.resize(problem.points.size());
  EXPECT_EQ(Solve(problem), std::vector<float>(problem.points.size(), 1.0f));
}

TEST(DenseCrfTest, IdenticalPointsAgree) {
  Problem problem;
  problem.points.assign(5000, {{-3.0f, 4.0f, 5.0f}, {1, 2, 3}});
  problem.num_labels = {2};
  for (int i = 0; i < 5000; ++i) AddUnaries(i % 4 == 0 ? 0 : 1, 2, 0.6, problem.unaries);
  const std::vector<float> values = Solve(problem);
  for (std::size_t p = 0; p < 5000; ++p) ASSERT_EQ(ArgMax(values, p, 2), 1);
}

TEST(DenseCrfTest, TheOriginDoesNotMatter) {
  const Problem problem = SmallRandomProblem(19);
  const std::vector<float> values = Solve(problem);
  for (const Eigen::Vector3f& shift_m :
       {Eigen::Vector3f(-500.0f, 20.0f, -3.0f), Eigen::Vector3f(4096.0f, -8192.0f, 0)}) {
    Problem shifted = problem;
    for (CrfPoint& point : shifted.points) point.position_m += shift_m;
    const std::vector<float> shifted_values = Solve(shifted);
    // Single precision holds 1 mm at 8 km, a hundredth of the smoothness kernel.
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(shifted_values[i], values[i], 0.02f);
  }
}

TEST(DenseCrfTest, PartsOfAWideCloudAreSolvedAsIfAlone) {
  // Two slabs 20 km apart.
  const Problem problem = SmallRandomProblem(20);
  Problem wide = problem;
  for (const CrfPoint& point : problem.points) {
    wide.points.push_back({point.position_m + Eigen::Vector3f(-16384.0f, 8192.0f, 1024.0f), point.color});
  }
  wide.unaries.insert(wide.unaries.end(), problem.unaries.begin(), problem.unaries.end());
  const std::vector<float> alone = Solve(problem), values = Solve(wide);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], alone[i % alone.size()], 0.08f);
}

}  // namespace
}  // namespace dhpmap
