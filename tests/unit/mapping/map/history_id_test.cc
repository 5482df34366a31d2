// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/history_id.h"

#include <gtest/gtest.h>

#include <set>

namespace dhpmap {
namespace {

TEST(HistoryId, IsDrawnAnewEachTime) {
  std::set<std::uint64_t> drawn;
  for (int i = 0; i < 100; ++i) drawn.insert(DrawHistoryId());
  EXPECT_EQ(drawn.size(), 100u);
  EXPECT_FALSE(drawn.contains(0));
  EXPECT_EQ(*drawn.rbegin() >> 63, 0u) << "SQLite's integers have a sign";
}

}  // namespace
}  // namespace dhpmap
