// SPDX-License-Identifier: BSD-3-Clause
// What the lattices and the mean field allocate is counted.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "mapping/base/memory_count.h"
#include "mapping/crf/dense_crf.h"
#include "mapping/crf/grow_buffer.h"
#include "mapping/crf/permutohedral_lattice.h"

namespace dhpmap {
namespace {

std::size_t CrfScratchNow() { return CountOf(MemoryKind::kRefinement).now_bytes(); }

TEST(CrfScratch, OfAnArrayIsCountedAsItWasAllocated) {
  {
    GrowBuffer<std::uint32_t> small;
    small.Resize(1000);
    EXPECT_EQ(CrfScratchNow(), 63u * 64) << "whole cache lines";
    small.Resize(10);
    EXPECT_EQ(CrfScratchNow(), 63u * 64) << "it keeps its memory";
    GrowBuffer<std::uint32_t> moved = std::move(small);
    EXPECT_EQ(CrfScratchNow(), 63u * 64);
    moved.Resize((5u << 20) / sizeof(std::uint32_t));
    EXPECT_EQ(CrfScratchNow(), 6u << 20) << "whole huge pages, and what was there before is gone";
  }
  EXPECT_EQ(CrfScratchNow(), 0u);
}

TEST(CrfScratch, OfTheCrfIsNoLessThanItsLatticesTake) {
  constexpr std::size_t kPoints = 20'000, kLabels = 5;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> position_m(0, 2);
  std::vector<CrfPoint> points(kPoints);
  for (CrfPoint& point : points) {
    point = {{position_m(random), position_m(random), position_m(random)}, {100, 150, 200}};
  }
  ThreadPool pool(1);  // of several, any may find nothing to do the first time
  {
    DenseCrf crf(pool);
    const CrfKernel smoothness{.position_m = 0.1, .color = 0, .weight = 1};
    const CrfKernel appearance{.position_m = 0.2, .color = 20, .weight = 1};
    const CrfBuildReport built = crf.SetPoints(points, smoothness, appearance);
    constexpr std::size_t kCorners =
        sizeof(PermutohedralLattice<3>::Corners) + sizeof(PermutohedralLattice<6>::Corners) + sizeof(std::uint32_t);
    const std::size_t after_build = CrfScratchNow();
    EXPECT_GE(after_build, kPoints * kCorners);
    std::vector<float> values(kPoints * kLabels, 1.0f);
    const int num_labels[] = {static_cast<int>(kLabels)};
    crf.Infer(num_labels, 3, values);
    const std::size_t num_vertices = built.num_smoothness_vertices + built.num_appearance_vertices;
    EXPECT_GE(CrfScratchNow(), after_build + num_vertices * 8 * sizeof(float)) << "a row of values each, kept";
    const std::size_t after_first = CrfScratchNow();
    crf.Infer(num_labels, 3, values);
    EXPECT_EQ(CrfScratchNow(), after_first);
  }
  EXPECT_EQ(CrfScratchNow(), 0u);
}

}  // namespace
}  // namespace dhpmap
