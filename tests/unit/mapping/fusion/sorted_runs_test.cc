// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/sorted_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

/// Rows 0 to 2 of the table; 8 is not in it, and nobody has 6.
const std::vector<SegmentInfo> kListed = {{.id = SegmentId(9)}, {.id = SegmentId(4)}, {.id = SegmentId(6)}};
int RowOfSegment(std::uint32_t id) { return id == 9 ? 0 : id == 4 ? 1 : -1; }

RunBands RandomBands(std::mt19937& random) {
  RunBands bands(random() % 5);
  for (std::vector<PointRun>& band : bands) {
    for (std::size_t n = random() % 40; n > 0; --n) {
      band.push_back({.place = PointPlace(std::vector<std::uint32_t>{0, 4, 8, 9}[random() % 4], {})});
    }
  }
  return bands;
}

TEST(SortedRuns, AreThoseOfAllBandsStablySortedByRow) {
  std::mt19937 random(5);
  for (int n = 0; n < 100; ++n) {
    const RunBands bands = RandomBands(random);
    std::vector<const PointRun*> expected, sorted;
    std::vector<std::uint32_t> positions;
    for (const std::vector<PointRun>& band : bands) {
      for (const PointRun& run : band) expected.push_back(&run);
    }
    std::stable_sort(expected.begin(), expected.end(), [](const PointRun* a, const PointRun* b) {
      return RowOfSegment(a->place.segment()) < RowOfSegment(b->place.segment());
    });
    const std::vector<RunsOfSegment> segments = SortRunsBySegment(kListed, bands, positions, sorted);
    EXPECT_EQ(sorted, expected);
    std::size_t end = 0;
    int last_row = -2;
    for (const RunsOfSegment& segment : segments) {
      EXPECT_GT(segment.row, last_row);
      EXPECT_EQ(segment.begin, end);
      ASSERT_LT(segment.begin, segment.end) << "only those that have any";
      for (std::size_t i = segment.begin; i < segment.end; ++i) {
        EXPECT_EQ(RowOfSegment(sorted[i]->place.segment()), segment.row);
      }
      last_row = segment.row;
      end = segment.end;
    }
    EXPECT_EQ(end, sorted.size());
  }
}

}  // namespace
}  // namespace dhpmap
