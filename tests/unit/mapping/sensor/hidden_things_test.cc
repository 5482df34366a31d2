// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/hidden_things.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

constexpr std::uint32_t kThing = 5, kStuff = 6, kOfNoClass = 7, kUnlisted = 8;

/// Two points of each kind, of which the second is hidden.
PanopticFrame Frame() {
  PanopticFrame frame;
  frame.unlisted_ids_are_unknown = true;
  frame.segments = {{SegmentId(kStuff), ClassId(3)}, {SegmentId(kOfNoClass), {}}, {SegmentId(kThing), ClassId(1)}};
  LidarData& scan = frame.lidar.emplace();
  scan.segments = {kThing, kThing, kStuff, kStuff, kOfNoClass, kOfNoClass, kUnlisted, kUnlisted, 0, 0};
  scan.is_hidden = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
  for (int i = 0; i < 10; ++i) scan.points_m.emplace_back(5, 0.1f * static_cast<float>(i), 0);
  return frame;
}

TEST(WithoutHiddenThings, OnlyAThingsHiddenPointsLoseTheirSegment) {
  const PanopticFrame frame = Frame();
  const auto rest = WithoutHiddenThings(frame, *testing::MakeLabelSet(2, 1));
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(rest->lidar->segments, (std::vector<std::uint32_t>{kThing, 0, kStuff, kStuff, kOfNoClass, kOfNoClass,
                                                               kUnlisted, kUnlisted, 0, 0}));
  EXPECT_EQ(rest->lidar->points_m, frame.lidar->points_m);
  EXPECT_EQ(rest->segments.size(), frame.segments.size());
  EXPECT_FALSE(WithoutHiddenThings(*rest, *testing::MakeLabelSet(2, 1)).has_value()) << "forgotten once";
}

TEST(WithoutHiddenThings, NothingIsToBeForgottenWithoutFlagsLabelsOrAScan) {
  const auto label_set = testing::MakeLabelSet(2, 1);
  PanopticFrame frame = Frame();
  frame.lidar->is_hidden.clear();
  EXPECT_FALSE(WithoutHiddenThings(frame, *label_set).has_value());
  frame = Frame();
  frame.lidar->segments.clear();
  EXPECT_FALSE(WithoutHiddenThings(frame, *label_set).has_value());
  frame = Frame();
  frame.lidar->is_hidden.assign(10, 0);
  EXPECT_FALSE(WithoutHiddenThings(frame, *label_set).has_value());
  EXPECT_FALSE(WithoutHiddenThings(PanopticFrame(), *label_set).has_value());
}

}  // namespace
}  // namespace dhpmap
