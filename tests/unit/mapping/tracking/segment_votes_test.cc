// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/segment_votes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace dhpmap {
namespace {

constexpr ClassId kCup{1}, kBowl{2}, kWallpaper{3}, kDoor{4}, kPanel{5};

/// A cup and wallpaper; how sure the network is of something decides.
class FrameVotesTest : public ::testing::Test {
 protected:
  FrameVotesTest() : map_(Info()) {
    cup_ = Make(Panoptic::kThing, kCup);
    wallpaper_ = Make(Panoptic::kStuff, kWallpaper);
  }

  static MapInfo Info() {
    MapInfo info;
    info.name = "m";
    std::vector<LabelClass> classes{{.id = kCup, .name = "cup"},
                                    {.id = kBowl, .name = "bowl"},
                                    {.id = kWallpaper, .name = "wallpaper", .panoptic = Panoptic::kStuff},
                                    {.id = kDoor, .name = "door", .panoptic = Panoptic::kStuff},
                                    {.id = kPanel, .name = "panel", .panoptic = Panoptic::kStuff}};
    for (std::uint16_t c = 6; c <= 40; ++c) classes.push_back({.id = ClassId(c), .name = std::to_string(c)});
    info.label_set = std::make_shared<const LabelSet>(*LabelSet::Create(std::move(classes)));
    info.config.tracking.weigh_scores = true;
    return info;
  }

  SubmapId Make(Panoptic panoptic, ClassId class_id) {
    SubmapInfo info;
    info.panoptic = panoptic;
    info.class_id = class_id;
    return map_.Create(std::move(info)).id();
  }

  LabelHistograms VotesOf(const SegmentInfo& segment, SubmapId holder) const {
    return FrameVotes(frame_, map_).Of(segment, *map_.Find(holder));
  }

  Map map_;
  PanopticFrame frame_;
  SubmapId cup_, wallpaper_;
};

/// Counts of classes and of instances have the same sum, ids ascend, and the holder has a share.
void ExpectWellFormed(const LabelHistograms& votes) {
  std::uint64_t num_classes = 0, num_instances = 0;
  for (const LabelCount& entry : votes.classes) num_classes += entry.count;
  for (const InstanceCount& entry : votes.instances) num_instances += entry.count;
  EXPECT_EQ(num_classes, num_instances);
  EXPECT_TRUE(std::is_sorted(votes.classes.begin(), votes.classes.end(),
                             [](const LabelCount& a, const LabelCount& b) { return a.id < b.id; }));
  EXPECT_TRUE(std::is_sorted(votes.instances.begin(), votes.instances.end(),
                             [](const InstanceCount& a, const InstanceCount& b) { return a.id < b.id; }));
  ASSERT_FALSE(votes.instances.empty());
  EXPECT_TRUE(votes.instances.front().id.IsOwn());
}

TEST_F(FrameVotesTest, ASightingCountsOneWhateverTheNetworkSaysUnlessItIsWeighed) {
  SegmentInfo said{
      .id = SegmentId(1), .class_id = kCup, .score = 0.75f, .class_scores = {{kBowl, 0.25f}, {kCup, 0.5f}}};
  map_.mutable_info().config.tracking.weigh_scores = false;
  EXPECT_EQ(VotesOf(said, cup_), LabelHistograms::OfClass(kCup));
  EXPECT_EQ(VotesOf(said, kUnknownSubmap), LabelHistograms{});
  said.class_id.reset();
  EXPECT_EQ(VotesOf(said, cup_), LabelHistograms{});
}

TEST_F(FrameVotesTest, AWeighedSightingCountsAsItsScoreSays) {
  const auto of_score = [&](std::optional<float> score) {
    return VotesOf({.id = SegmentId(1), .class_id = kCup, .score = score}, cup_);
  };
  EXPECT_EQ(of_score(0.75f), LabelHistograms::OfClass(kCup, 192));
  EXPECT_EQ(of_score(1), LabelHistograms::OfClass(kCup, 256));
  EXPECT_EQ(of_score(1e-6f), LabelHistograms::OfClass(kCup, 1)) << "it was seen";
  EXPECT_EQ(of_score(0.0f), LabelHistograms::OfClass(kCup, 1)) << "the worst score, not none";
  EXPECT_EQ(of_score(std::nullopt), LabelHistograms::OfClass(kCup, 256)) << "the network gives nobody a score";
  frame_.segments = {{.id = SegmentId(1), .score = 0.25f}, {.id = SegmentId(2), .score = 0.75f}, {.id = SegmentId(3)}};
  EXPECT_EQ(of_score(std::nullopt), LabelHistograms::OfClass(kCup, 128)) << "it is as sure as the others";
  frame_.segments[1] = {.id = SegmentId(2), .class_id = kCup, .class_scores = {{kCup, 0.5f}}};
  EXPECT_EQ(of_score(std::nullopt), LabelHistograms::OfClass(kCup, 96)) << "class scores say how sure, too";
}

TEST_F(FrameVotesTest, ClassScoresOfAThingAreItsClassesAlone) {
  SegmentInfo said{.id = SegmentId(1),
                   .class_id = kCup,
                   .score = 0.9f,
                   .class_scores = {{kWallpaper, 0.25f}, {kCup, 0.5f}, {kBowl, 0.125f}}};
  const LabelHistograms expected{{{kCup.value, 128}, {kBowl.value, 32}}, {{kOwnInstance, 160}}};
  EXPECT_EQ(VotesOf(said, cup_), expected) << "a thing is no wallpaper, however likely";
  said.class_scores = {{kWallpaper, 1.0f}};
  EXPECT_EQ(VotesOf(said, cup_), LabelHistograms::OfClass(kCup, 1)) << "it was put here";
  said.class_id = kBowl;
  said.class_scores = {{kCup, 0.5f}, {kBowl, 0.5f}};
  EXPECT_EQ(VotesOf(said, cup_).classes, (std::vector<LabelCount>{{kCup.value, 128}, {kBowl.value, 129}})) << "a tie";
}

TEST_F(FrameVotesTest, ClassScoresOfABackgroundAreForTheSubmapsOfTheirClasses) {
  SegmentInfo said{.id = SegmentId(3),
                   .class_id = kWallpaper,
                   .class_scores = {{kDoor, 0.25f}, {kWallpaper, 0.5f}, {kPanel, 0.125f}, {kCup, 0.125f}}};
  const std::vector<LabelCount> classes{{kWallpaper.value, 128}, {kDoor.value, 64}, {kPanel.value, 32}};
  EXPECT_EQ(VotesOf(said, wallpaper_), (LabelHistograms{classes, {{kOwnInstance, 224}}}))
      << "there is no door yet, and a cup is no wallpaper";
  const SubmapId door = Make(Panoptic::kStuff, kDoor);
  EXPECT_EQ(VotesOf(said, wallpaper_), (LabelHistograms{classes, {{kOwnInstance, 160}, {SeenInstance(door), 64}}}));
  said.class_scores = {{kDoor, 0.5f}, {kWallpaper, 0.5f}};
  LabelHistograms votes = VotesOf(said, wallpaper_);
  EXPECT_EQ(votes.instances, (std::vector<InstanceCount>{{kOwnInstance, 129}, {SeenInstance(door), 128}})) << "a tie";
  ExpectWellFormed(votes);
  said.class_scores = {{kDoor, 0.125f}, {kWallpaper, 0.75f}};
  EXPECT_EQ(VotesOf(said, wallpaper_).instances.size(), 1u) << "too little to decide anything";
  said.class_scores = {{kDoor, 1.0f}};
  votes = VotesOf(said, wallpaper_);
  EXPECT_EQ(votes.instances, (std::vector<InstanceCount>{{kOwnInstance, 1}, {SeenInstance(door), 256}}));
  ExpectWellFormed(votes);
}

TEST_F(FrameVotesTest, NothingIsHandedFromOrToWhatSomebodyHasEdited) {
  const SubmapId door = Make(Panoptic::kStuff, kDoor);
  const SegmentInfo said{.id = SegmentId(3), .class_id = kWallpaper, .class_scores = {{kDoor, 0.75f}}};
  ASSERT_EQ(VotesOf(said, wallpaper_).instances.size(), 2u);
  map_.FindMutable(door)->mutable_info().is_locked = true;
  EXPECT_EQ(VotesOf(said, wallpaper_).instances.size(), 1u);
  map_.FindMutable(door)->mutable_info().is_locked = false;
  map_.FindMutable(wallpaper_)->mutable_info().class_is_fixed = true;
  EXPECT_EQ(VotesOf(said, wallpaper_).instances.size(), 1u);
  map_.FindMutable(wallpaper_)->mutable_info().class_is_fixed = false;
  map_.FindMutable(door)->mutable_info().display_name = "the door";
  EXPECT_EQ(VotesOf(said, wallpaper_).instances.size(), 1u);
}

TEST_F(FrameVotesTest, OfClassScoresTheLikeliestFewCountInAnyOrder) {
  SegmentInfo said{.id = SegmentId(1), .class_id = kCup};
  for (const LabelClass& c : map_.info().label_set->classes()) {
    said.class_scores.push_back({c.id, c.id == ClassId(7) ? 0.3f : 0.0625f});
  }
  const LabelHistograms votes = VotesOf(said, cup_);
  EXPECT_EQ(votes.classes, (std::vector<LabelCount>{{1, 16}, {2, 16}, {6, 16}, {7, 77}}));
  ExpectWellFormed(votes);
  std::reverse(said.class_scores.begin(), said.class_scores.end());
  EXPECT_EQ(VotesOf(said, cup_), votes);
}

}  // namespace
}  // namespace dhpmap
