// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/same_state.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(SameState, AStateIsTheSameAsItsCopy) {
  MapInfo info;
  info.revision = 7;
  info.update_time_ns = 70;
  EXPECT_TRUE(IsSameState(info, MapInfo(info)));
}

TEST(SameState, TwoStatesOfOneRevisionDifferByTimeFramesOrObjects) {
  MapInfo info;
  info.revision = 7;
  for (const auto change :
       {+[](MapInfo& other) { other.update_time_ns += 1; }, +[](MapInfo& other) { other.num_frames += 1; },
        +[](MapInfo& other) { other.next_submap_id = SubmapId(other.next_submap_id.value + 1); },
        +[](MapInfo& other) { other.revision += 1; }, +[](MapInfo& other) { other.history_id += 1; },
        +[](MapInfo& other) { other.create_time_ns += 1; }}) {
    MapInfo other = info;
    change(other);
    EXPECT_FALSE(IsSameState(info, other));
  }
}

}  // namespace
}  // namespace dhpmap
