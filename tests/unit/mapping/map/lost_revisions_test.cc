// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/lost_revisions.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(LostRevisions, AreThoseOfTheRangesWithBothEnds) {
  const LostRevisions lost{{5, 9}, {12, 12}, {20, 30}};
  for (const std::int64_t revision : {5, 7, 9, 12, 20, 30}) EXPECT_TRUE(IsLost(lost, revision)) << revision;
  for (const std::int64_t revision : {0, 4, 10, 11, 13, 19, 31}) EXPECT_FALSE(IsLost(lost, revision)) << revision;
}

TEST(LostRevisions, OfAMapThatWasNeverCutOffAreNone) { EXPECT_FALSE(IsLost({}, 0)); }

}  // namespace
}  // namespace dhpmap
