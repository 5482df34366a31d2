// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/beam_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mapping/space/camera_kernel.h"

namespace dhpmap {
namespace {

/// Positions of a line's bins in a grid, and of those that are beyond it: `none`.
using Line = std::vector<std::size_t>;
constexpr std::size_t kBeyond = static_cast<std::size_t>(-1);

/// The rule of BeamGaps, line by line and bin by bin.
void FillSlowly(const std::vector<Line>& lines, bool go_around, std::vector<float>& bins) {
  struct Pair {
    const Line* line;
    std::size_t first, apart;
  };
  std::vector<Pair> pairs;
  std::vector<std::size_t> apart;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto has = [&](std::size_t at) {
        const std::size_t bin = line[at % line.size()];
        return bin != kBeyond && bins[bin] != kNoLimit;
      };
      if (!has(i)) continue;
      const std::size_t end = go_around ? i + line.size() : line.size();
      std::size_t next = i + 1;
      while (next < end && !has(next)) ++next;
      if (next == end) continue;
      pairs.push_back({&line, i, next - i});
      apart.push_back(std::min(next - i, BeamGaps::kMostBins));
    }
  }
  std::size_t usual = 0;
  const auto share = [&](std::size_t most) {
    return 4 * std::count_if(apart.begin(), apart.end(), [most](std::size_t n) { return n <= most; });
  };
  while (usual < BeamGaps::kMostBins && share(usual) < 3 * static_cast<std::ptrdiff_t>(apart.size())) ++usual;
  const std::size_t widest = std::min(BeamGaps::kMostBins, std::max(usual + 1, usual * 3 / 2));
  std::vector<float> filled = bins;
  for (const Pair& pair : pairs) {
    if (pair.apart > widest) continue;
    const auto at = [&](std::size_t i) { return (*pair.line)[(pair.first + i) % pair.line->size()]; };
    for (std::size_t i = 1; i < pair.apart; ++i) filled[at(i)] = std::min(bins[at(0)], bins[at(pair.apart)]);
  }
  bins = filled;
}

std::vector<float> RandomBins(std::size_t count, unsigned one_in, std::mt19937& random) {
  std::vector<float> bins(count, kNoLimit);
  for (float& bin : bins) {
    if (random() % one_in == 0) bin = static_cast<float>(1 + random() % 50);
  }
  return bins;
}

TEST(BeamGaps, ColumnsAreFilledAsBinByBin) {
  std::mt19937 random(1);
  constexpr std::size_t kWidth = 23, kHeight = 90;
  std::vector<Line> columns(kWidth);
  for (std::size_t u = 0; u < kWidth; ++u) {
    for (std::size_t v = 0; v < kHeight; ++v) columns[u].push_back(v * kWidth + u);
  }
  BeamGaps gaps;
  for (unsigned round = 0; round < 100; ++round) {
    std::vector<float> bins = RandomBins(kWidth * kHeight, 1 + round % 30, random);
    std::vector<float> slowly = bins;
    FillSlowly(columns, false, slowly);
    gaps.FillColumns(kWidth, kHeight, bins);
    ASSERT_EQ(bins, slowly);
  }
}

TEST(BeamGaps, RowsGoAroundAlsoWhereTheGridHoldsAPartOfThem) {
  std::mt19937 random(2);
  constexpr std::size_t kWidth = 80, kHeight = 7;
  BeamGaps gaps;
  for (const std::size_t num_around : {kWidth, kWidth + BeamGaps::kMostBins + 1}) {
    std::vector<Line> rows(kHeight, Line(num_around, kBeyond));
    for (std::size_t i = 0; i < kWidth * kHeight; ++i) rows[i / kWidth][i % kWidth] = i;
    for (unsigned round = 0; round < 100; ++round) {
      std::vector<float> bins = RandomBins(kWidth * kHeight, 1 + round % 30, random);
      std::vector<float> slowly = bins;
      FillSlowly(rows, true, slowly);
      gaps.FillRows(kWidth, kHeight, num_around, bins);
      ASSERT_EQ(bins, slowly);
    }
  }
}

}  // namespace
}  // namespace dhpmap
