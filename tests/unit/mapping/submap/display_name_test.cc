// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/display_name.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

LabelSet Labels() {
  return *LabelSet::Create({{.id = ClassId(1), .name = "sofa", .panoptic = Panoptic::kThing},
                            {.id = ClassId(2), .name = "handle", .panoptic = Panoptic::kThing},
                            {.id = ClassId(3), .name = "wall", .panoptic = Panoptic::kStuff}});
}

SubmapInfo ThingOf(ClassId class_id, const std::string& name) {
  SubmapInfo info;
  info.id = SubmapId(7);
  info.panoptic = Panoptic::kThing;
  info.class_id = class_id;
  info.display_name = name;
  return info;
}

TEST(DisplayName, FollowsTheClassUntilSomebodySetsIt) {
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(2), ""), Labels()), "handle 7");
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(1), ""), Labels()), "sofa 7");
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(1), "grandmother's"), Labels()), "grandmother's");
}

TEST(DisplayName, FollowsTheClassWhereAnOlderMapWroteItsOwn) {
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(1), "handle 7"), Labels()), "sofa 7");
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(1), "handle 8"), Labels()), "handle 8") << "another's number: it was given";
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(1), "wall"), Labels()), "wall") << "things have numbers: it was given";
}

TEST(DisplayName, OfBackgroundIsTheClass) {
  SubmapInfo wall = ThingOf(ClassId(3), "");
  wall.panoptic = Panoptic::kStuff;
  EXPECT_EQ(DisplayNameOf(wall, Labels()), "wall");
  EXPECT_EQ(DisplayNameOf({}, Labels()), "unknown");
}

TEST(DisplayName, OfAClassThatTheLabelSetLacksIsTheId) {
  EXPECT_EQ(DisplayNameOf(ThingOf(ClassId(9), ""), Labels()), "submap 7");
}

}  // namespace
}  // namespace dhpmap
