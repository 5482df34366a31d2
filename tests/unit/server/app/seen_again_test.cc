// SPDX-License-Identifier: BSD-3-Clause
// Later frames of an edited place have the effects that a person expects.
#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/app/edits/edit_list.h"
#include "tests/support/map_equality.h"
#include "tests/unit/mapping/pipeline/gone_scene.h"

namespace dhpmap {
namespace {

using testing::Box;
using testing::Chair;
using testing::EmptyRoom;
using testing::FindThing;
using testing::kChair;
using testing::kPerson;
using testing::PointsOf;
using testing::ShareWithSurface;
using testing::SubmapsAreEqual;
using testing::WalkFrame;
using testing::With;

/// Segments that are none of the room's classes: more chairs.
constexpr std::uint32_t kSecond = 11, kOfAnotherRobot = 21;

std::vector<SubmapId> ThingsIn(const MapSnapshot& map) {
  std::vector<SubmapId> things;
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap->id());
  }
  return things;
}

std::set<VoxelIndex> VoxelsOf(const Submap& submap) {
  std::set<VoxelIndex> voxels;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
      if (entry.tsdf->IsObserved(i)) voxels.insert(VoxelIn(entry.index, i));
    }
  }
  return voxels;
}

std::size_t NumShared(const std::set<VoxelIndex>& a, const std::set<VoxelIndex>& b) {
  return static_cast<std::size_t>(std::count_if(a.begin(), a.end(), [&b](VoxelIndex v) { return b.contains(v); }));
}

void RenameSegment(PanopticFrame& frame, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t& pixel : frame.camera->segments) pixel = pixel == from ? to : pixel;
}

/// A chair at the place of the room's, in two pieces beside each other or `gap_m` apart: segments kChair and kSecond.
testing::Scene PairOfChairs(double gap_m) {
  const double away_m = 0.15 + gap_m / 2;
  return With(With(EmptyRoom(), Box(kChair, {1.7, 0.2 - away_m, 0.4}, {0.25, 0.15, 0.4})),
              Box(ClassId(kSecond), {1.7, 0.2 + away_m, 0.4}, {0.25, 0.15, 0.4}));
}

/// A robot maps a room that a person edits. Things are matched by overlap.
class SeenAgainByOverlap : public ::testing::Test {
 protected:
  using Scene = testing::Scene;
  using Change = std::function<void(PanopticFrame&)>;

  void Walk(const Scene& scene, int num_frames, const Change& change = {}) {
    for (; num_frames > 0; --num_frames) {
      PanopticFrame frame = WalkFrame(scene, session_.next_++);
      for (const std::uint32_t id : {kSecond, kOfAnotherRobot}) {
        frame.segments.push_back({.id = SegmentId(id), .class_id = kChair});
      }
      frame.has_persistent_ids = has_persistent_ids_;
      if (change) change(frame);
      session_.Take(frame);
    }
  }
  std::vector<EditResult> Make(std::optional<EditTarget> target, decltype(Edit::action) action) {
    session_.Now();
    EditList list;
    list.edits.push_back({.target = target, .etag = {}, .action = std::move(action)});
    auto results = ApplyEdits(list, session_.map());
    EXPECT_TRUE(results.ok()) << results.status().ToString();
    session_.Now();
    return results.ok() ? *std::move(results) : std::vector<EditResult>(1);
  }
  SubmapId ChairOf(const Scene& scene) {
    Walk(scene, 12);
    const Submap* chair = FindThing(*Now(), kChair);
    EXPECT_NE(chair, nullptr);
    return chair != nullptr ? chair->id() : SubmapId();
  }
  std::shared_ptr<const MapSnapshot> Now() { return session_.Now(); }
  std::int64_t NumFramesOf(SubmapId id) { return Now()->Find(id)->info().num_frames_observed; }

  bool has_persistent_ids_ = false;
  testing::Session session_;
};

/// The same, and with persistent ids.
class SeenAgain : public SeenAgainByOverlap, public ::testing::WithParamInterface<bool> {
 protected:
  SeenAgain() { has_persistent_ids_ = GetParam(); }
};

TEST_P(SeenAgain, TheOldPlaceOfAMovedObjectIsMappedAgain) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  std::vector<Eigen::Vector3d> floor_below;
  for (const double x_m : {1.6, 1.7, 1.8}) {
    for (const double y_m : {0.1, 0.2, 0.3}) floor_below.emplace_back(x_m, y_m, 0);
  }
  EXPECT_LT(ShareWithSurface(Now(), floor_below), 0.1) << "nobody has seen it";
  SubmapPatch patch;
  patch.T_map_submap = Transform(Eigen::Translation3d(0, -0.7, 0));
  Make(chair, PatchEdit{patch});
  const std::int64_t num_frames = NumFramesOf(chair);
  Walk(With(EmptyRoom(), Chair(1.7, -0.5)), 14);  // the real chair was moved, too
  EXPECT_GT(ShareWithSurface(Now(), floor_below), 0.9);
  EXPECT_LT(ShareWithSurface(Now(), PointsOf(Chair())), 0.1);
  EXPECT_GT(ShareWithSurface(Now(), PointsOf(Chair(1.7, -0.5))), 0.5);
  EXPECT_EQ(ThingsIn(*Now()), std::vector<SubmapId>{chair}) << "where it was put it is the same one";
  EXPECT_GT(NumFramesOf(chair), num_frames);
}

/// Frames show the three doors as one background; one of them stays in it.
testing::Scene ThreeDoors() {
  const auto door = [](double x_m, double y_m) { return Box(testing::kDoor, {x_m, y_m, 0.5}, {0.06, 0.2, 0.5}); };
  return With(With(With(EmptyRoom(), door(1.7, -0.6)), door(1.7, 0.2)), door(1.7, 1.0));
}

TEST_P(SeenAgain, DoorsSplitFromABackgroundReceiveTheirObservations) {
  Walk(ThreeDoors(), 12);
  const Submap* background = nullptr;
  for (const auto& submap : Now()->submaps()) {
    if (submap->info().panoptic == Panoptic::kStuff && submap->info().class_id == testing::kDoor) {
      background = submap.get();
    }
  }
  ASSERT_NE(background, nullptr);
  const SubmapId rest = background->id();
  SplitEdit split{SplitByParts{}};
  split.class_id = kPerson;
  const std::vector<SubmapId> parts = Make(rest, split)[0].created;
  ASSERT_EQ(parts.size(), 2u);
  const auto voxels_of = [&](SubmapId id) { return VoxelsOf(*Now()->Find(id)); };
  const std::int64_t frames_of_part = NumFramesOf(parts[0]);
  std::vector<std::set<VoxelIndex>> before;
  for (const SubmapId id : parts) before.push_back(voxels_of(id));
  const std::set<VoxelIndex> rest_before = voxels_of(rest);

  Walk(ThreeDoors(), 14);
  EXPECT_EQ(ThingsIn(*Now()), parts) << "nothing new, and nothing merged";
  EXPECT_GE(NumFramesOf(parts[0]), frames_of_part + 10) << "frames call it a door, and mean the part";
  const std::set<VoxelIndex> rest_after = voxels_of(rest);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(Now()->Find(parts[i])->info().class_id, kPerson);
    EXPECT_EQ(Now()->Find(parts[i])->info().presence, Presence::kPresent);
    EXPECT_EQ(NumShared(before[i], rest_after), NumShared(before[i], rest_before))
        << "the background does not grow back";
    EXPECT_EQ(NumShared(before[i], voxels_of(parts[i])), before[i].size()) << "and it keeps what it had";
  }
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_GT(static_cast<double>(NumShared(before[i], voxels_of(parts[i]))),
              0.9 * static_cast<double>(before[i].size()));
  }
}

TEST_P(SeenAgain, BothSidesOfASplitBackgroundKeepTheirObservations) {
  const testing::Scene scene = With(EmptyRoom(), Box(testing::kDoor, {1.7, 0.2, 0.5}, {0.06, 0.5, 0.5}));
  Walk(scene, 12);
  SubmapId rest;
  for (const auto& submap : Now()->submaps()) {
    if (submap->info().panoptic == Panoptic::kStuff && submap->info().class_id == testing::kDoor) rest = submap->id();
  }
  SplitEdit split{SplitByPlane{{0, 0.2, 0}, {0, 1, 0}}};
  split.class_id = kPerson;
  const std::vector<SubmapId> parts = Make(rest, split)[0].created;
  ASSERT_EQ(parts.size(), 1u);
  const std::set<VoxelIndex> of_rest = VoxelsOf(*Now()->Find(rest)), of_part = VoxelsOf(*Now()->Find(parts[0]));
  Walk(scene, 14);
  session_.builder().Finish();
  const std::set<VoxelIndex> rest_after = VoxelsOf(*Now()->Find(rest)), part_after = VoxelsOf(*Now()->Find(parts[0]));
  EXPECT_GT(static_cast<double>(NumShared(of_rest, rest_after)), 0.9 * static_cast<double>(of_rest.size()));
  EXPECT_GT(static_cast<double>(NumShared(of_part, part_after)), 0.9 * static_cast<double>(of_part.size()));
  EXPECT_EQ(ThingsIn(*Now()), parts);
}

TEST_P(SeenAgain, ADeletedObjectThatIsStillThereIsMappedAsANewOne) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  Make(chair, DeleteEdit{});
  Walk(With(EmptyRoom(), Chair()), 8);
  ASSERT_EQ(ThingsIn(*Now()).size(), 1u);
  EXPECT_GT(ThingsIn(*Now()).front(), chair) << "ids are never given out twice";
  EXPECT_GT(ShareWithSurface(Now(), PointsOf(Chair())), 0.35);
}

TEST_P(SeenAgain, ADeletedObjectIsNotMappedAgainInAnIgnoredRegion) {
  ChairOf(With(EmptyRoom(), Chair()));
  const Eigen::AlignedBox3d around(Eigen::Vector3d(1.29, -0.21, 0.07), Eigen::Vector3d(2.11, 0.61, 1.01));
  Make(std::nullopt, ClearEdit{around, {}, "no-chair-here"});
  Walk(With(EmptyRoom(), Chair()), 12);
  session_.builder().Finish();
  for (const auto& submap : Now()->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; entry.tsdf != nullptr && i < kBlockVoxels; ++i) {
        const Eigen::Vector3d p_m = VoxelCentre(VoxelIn(entry.index, i), submap->info().voxel_size_m);
        ASSERT_FALSE(entry.tsdf->IsObserved(i) && around.contains(p_m)) << "of submap " << submap->id().value;
      }
    }
  }
  Make(std::nullopt, LiftEdit{"no-chair-here"});
  Walk(With(EmptyRoom(), Chair()), 8);
  EXPECT_GT(ShareWithSurface(Now(), PointsOf(Chair())), 0.35) << "lifted, it fills again";
}

TEST_P(SeenAgain, RelabelledStaysRelabelled) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  SubmapPatch patch;
  patch.class_id = kPerson;
  Make(chair, PatchEdit{patch});
  const std::int64_t num_frames = NumFramesOf(chair);
  Walk(With(EmptyRoom(), Chair()), 30);  // frames go on to call it a chair
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), std::vector<SubmapId>{chair});
  EXPECT_EQ(Now()->Find(chair)->info().class_id, kPerson);
  EXPECT_EQ(NumFramesOf(chair), num_frames + 30);
}

TEST_P(SeenAgain, ARenamedObjectKeepsItsNameAfterAnAbsence) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  SubmapPatch patch;
  patch.display_name = "Grandmother's";
  Make(chair, PatchEdit{patch});
  Walk(With(EmptyRoom(), Chair()), 6);
  Walk(EmptyRoom(), 20);
  EXPECT_TRUE(Now()->Find(chair)->IsAbsent());
  Walk(With(EmptyRoom(), Chair()), 12);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), std::vector<SubmapId>{chair});
  EXPECT_FALSE(Now()->Find(chair)->IsAbsent());
  EXPECT_EQ(Now()->Find(chair)->info().display_name, "Grandmother's");
}

TEST_P(SeenAgain, ALockedObjectChangesOnlyItsLastSeenStamp) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  SubmapPatch patch;
  patch.is_locked = true;
  Make(chair, PatchEdit{patch});
  const auto before = Now();
  Walk(With(EmptyRoom(), Chair()), 8);
  session_.builder().Finish();
  const auto after = Now();
  ASSERT_NE(after->Find(chair), nullptr);
  Submap expected = *before->Find(chair);
  expected.mutable_info().last_observed_ns = (session_.next_ - 1) * testing::kPeriod_ns;
  EXPECT_TRUE(SubmapsAreEqual(expected, *after->Find(chair)));
  EXPECT_EQ(ThingsIn(*after), std::vector<SubmapId>{chair}) << "no twin";
}

TEST_P(SeenAgain, MergedStayMergedForTheIdsOfTwoRobots) {
  const testing::Scene scene = PairOfChairs(0);
  const Change first_robot = [](PanopticFrame& frame) {
    frame.session = "first";
    RenameSegment(frame, kSecond, 0);  // which it does not know
  };
  const Change second_robot = [](PanopticFrame& frame) {
    frame.session = "second";
    RenameSegment(frame, kChair.value, 0);
    RenameSegment(frame, kSecond, kOfAnotherRobot);
  };
  Walk(scene, 8, first_robot);
  Walk(scene, 8, second_robot);
  const auto things = ThingsIn(*Now());
  ASSERT_EQ(things.size(), 2u);
  Make(things[0], MergeEdit{{things[1]}});
  const std::int64_t num_frames = NumFramesOf(things[0]);
  Walk(scene, 6, first_robot);
  Walk(scene, 6, second_robot);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), std::vector<SubmapId>{things[0]});
  EXPECT_EQ(NumFramesOf(things[0]), num_frames + 12);
}

TEST_P(SeenAgain, MergedStayMergedForBothOfTheirIdsInOneSession) {
  const testing::Scene scene = PairOfChairs(0);
  Walk(scene, 12);
  const auto things = ThingsIn(*Now());
  ASSERT_EQ(things.size(), 2u);
  Make(things[0], MergeEdit{{things[1]}});
  const std::int64_t num_frames = NumFramesOf(things[0]);
  Walk(scene, 12);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), std::vector<SubmapId>{things[0]});
  EXPECT_EQ(NumFramesOf(things[0]), num_frames + 12);
}

TEST_P(SeenAgain, MergedStayMergedThoughTheirPartsStandApart) {
  const testing::Scene scene = PairOfChairs(0.4);
  Walk(scene, 12);
  const auto things = ThingsIn(*Now());
  ASSERT_EQ(things.size(), 2u);
  Make(things[0], MergeEdit{{things[1]}});
  Walk(scene, 12);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), std::vector<SubmapId>{things[0]});
}

/// The part beyond y = `y_m` becomes another object.
SplitEdit BeyondY(double y_m) { return {SplitByPlane{Eigen::Vector3d(0, y_m, 0), Eigen::Vector3d(0, 1, 0)}}; }

TEST_P(SeenAgain, ASplitPartStaysSeparateWhileFramesShowBothAsOne) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  const SubmapId part = Make(chair, SplitEdit{BeyondY(0.2)}).front().created.at(0);
  Walk(With(EmptyRoom(), Chair()), 5);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), (std::vector<SubmapId>{chair, part}));
  EXPECT_FALSE(Now()->info().merged.Into(part));
}

TEST_F(SeenAgainByOverlap, ASplitPartThatFramesDistinguishReceivesItsObservations) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  const SubmapId part = Make(chair, SplitEdit{BeyondY(0.2)}).front().created.at(0);
  const std::int64_t num_before = NumFramesOf(chair), num_of_part = NumFramesOf(part);
  const testing::Scene halves = With(With(EmptyRoom(), Box(kChair, {1.7, 0.075, 0.4}, {0.25, 0.125, 0.4})),
                                     Box(ClassId(kSecond), {1.7, 0.325, 0.4}, {0.25, 0.125, 0.4}));
  Walk(halves, 20);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), (std::vector<SubmapId>{chair, part}));
  EXPECT_GE(NumFramesOf(chair), num_before + 15);
  EXPECT_GE(NumFramesOf(part), num_of_part + 15);
}

/// The rest keeps the id of the whole, so it receives all frames that show both as one.
TEST_P(SeenAgain, ASplitPartStaysSeparateHoweverLongFramesShowBothAsOne) {
  const SubmapId chair = ChairOf(With(EmptyRoom(), Chair()));
  const SubmapId part = Make(chair, SplitEdit{BeyondY(0.3)}).front().created.at(0);
  Walk(With(EmptyRoom(), Chair()), 60);
  session_.builder().Finish();
  EXPECT_EQ(ThingsIn(*Now()), (std::vector<SubmapId>{chair, part}));
}

INSTANTIATE_TEST_SUITE_P(Ids, SeenAgain, ::testing::Bool(),
                         [](const auto& ids) { return ids.param ? "Persistent" : "PerFrame"; });

}  // namespace
}  // namespace dhpmap
