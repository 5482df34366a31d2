// SPDX-License-Identifier: BSD-3-Clause
// What somebody has locked stays as it is, whatever frames and refinement say.
#include <optional>
#include <tuple>

#include "tests/support/map_equality.h"
#include "tests/unit/mapping/pipeline/gone_scene.h"

namespace dhpmap {
namespace {

using testing::Box;
using testing::Chair;
using testing::EmptyRoom;
using testing::FindThing;
using testing::Info;
using testing::kChair;
using testing::kFloor;
using testing::kPerson;
using testing::kWall;
using testing::PointsOf;
using testing::Session;
using testing::ShareWithSurface;
using testing::SubmapsAreEqual;
using testing::WalkFrame;
using testing::With;

/// As `submap` would be if it had last been seen when `seen` was.
Submap SeenAs(const Submap& submap, const Submap& seen) {
  Submap copy = submap;
  copy.mutable_info().last_observed_ns = seen.info().last_observed_ns;
  return copy;
}

int NumThings(const MapSnapshot& map) {
  return static_cast<int>(std::count_if(map.submaps().begin(), map.submaps().end(), [](const auto& submap) {
    return submap->info().panoptic == Panoptic::kThing;
  }));
}

MapInfo RefinedInfo() {
  MapInfo info = Info();
  info.config.refinement.every_frames = 4;
  info.config.activity.deactivate_after_missed = 2;
  return info;
}

/// A chair that was walked around and then locked, in a session that is refined at every turn. With persistent ids or
/// matched by overlap.
class LockTest : public ::testing::TestWithParam<bool> {
 protected:
  LockTest() {
    Walk(With(EmptyRoom(), Chair()), 12);
    id_ = FindThing(*session_.Now(), kChair)->id();
    Lock(id_, true);
  }

  void Walk(const Scene& scene, int num_frames, const std::function<void(PanopticFrame&)>& change = {}) {
    for (; num_frames > 0; --num_frames) {
      PanopticFrame frame = WalkFrame(scene, session_.next_++);
      frame.has_persistent_ids = GetParam();
      if (change) change(frame);
      session_.Take(frame);
    }
  }
  void Lock(SubmapId id, bool is_locked) {
    session_.map().FindMutable(id)->mutable_info().is_locked = is_locked;
    locked_ = session_.Now();
  }
  void ExpectLeftAlone(SubmapId id) {
    const auto now = session_.Now();
    const Submap *before = locked_->Find(id), *after = now->Find(id);
    ASSERT_NE(after, nullptr);
    EXPECT_TRUE(SubmapsAreEqual(SeenAs(*before, *after), *after));
  }

  using Scene = testing::Scene;
  Session session_{RefinedInfo()};
  SubmapId id_;
  std::shared_ptr<const MapSnapshot> locked_;
};

TEST_P(LockTest, FramesThatSeeItOnlySetWhenItWasLastSeen) {
  const Scene scene = With(EmptyRoom(), Chair());
  Walk(scene, 20);
  ExpectLeftAlone(id_);
  EXPECT_EQ(session_.Now()->Find(id_)->info().last_observed_ns, (session_.next_ - 1) * testing::kPeriod_ns);
  EXPECT_EQ(NumThings(*session_.Now()), 1);
  session_.builder().Finish();
  ExpectLeftAlone(id_);
  EXPECT_EQ(session_.Now()->Find(id_)->info().activity, Activity::kActive) << "as it was";
}

TEST_P(LockTest, AnotherObjectIsMappedAsEver) {
  Walk(With(With(EmptyRoom(), Chair()), Box(kPerson, {1.2, -0.6, 0.5}, {0.2, 0.2, 0.5})), 12);
  ExpectLeftAlone(id_);
  const Submap* person = FindThing(*session_.Now(), kPerson);
  ASSERT_NE(person, nullptr);
  EXPECT_GT(person->info().num_frames_observed, 8);
}

TEST_P(LockTest, WhatIsGoneStaysAsItWas) {
  Walk(EmptyRoom(), 30);
  session_.builder().Finish();
  ExpectLeftAlone(id_);
  EXPECT_FALSE(session_.Now()->Find(id_)->IsAbsent());
  EXPECT_GT(ShareWithSurface(session_.Now(), PointsOf(Chair())), 0.6);
  Lock(id_, false);
  Walk(EmptyRoom(), 30);
  EXPECT_TRUE(session_.Now()->Find(id_)->IsAbsent()) << "it lives again";
}

TEST_P(LockTest, WhatSomebodyHasSaidIsAbsentStaysAbsentThoughItIsSeen) {
  session_.map().FindMutable(id_)->mutable_info().presence = Presence::kAbsent;
  Lock(id_, true);
  Walk(With(EmptyRoom(), Chair()), 8);
  ExpectLeftAlone(id_);
  EXPECT_TRUE(session_.Now()->Find(id_)->IsAbsent());
}

TEST_P(LockTest, OtherIdsClassesAndDoubtsMakeNoTwinOfIt) {
  const Scene scene = With(EmptyRoom(), Chair());
  Walk(scene, 6, [this](PanopticFrame& frame) {  // an id that the session has not used, in each frame another
    const auto id = static_cast<std::uint32_t>(100 + session_.next_);
    for (std::uint32_t& pixel : frame.camera->segments) pixel = pixel == kChair.value ? id : pixel;
    frame.segments[0].id = SegmentId(id);
  });
  Walk(scene, 6, [](PanopticFrame& frame) {  // a network that takes it for a person
    frame.segments[0].class_id = kPerson;
    frame.segments[0].id = SegmentId(77);
    for (std::uint32_t& pixel : frame.camera->segments) pixel = pixel == kChair.value ? 77 : pixel;
  });
  ExpectLeftAlone(id_);
  EXPECT_EQ(NumThings(*session_.Now()), 1);
  const auto unknown_before = session_.Now()->Find(kUnknownSubmap)->blocks().size();
  Walk(scene, 6, [](PanopticFrame& frame) {  // one that does not know what it is
    frame.segments[0].class_id.reset();
    frame.segments[0].id = SegmentId(78);
    for (std::uint32_t& pixel : frame.camera->segments) pixel = pixel == kChair.value ? 78 : pixel;
  });
  ExpectLeftAlone(id_);
  EXPECT_EQ(session_.Now()->Find(kUnknownSubmap)->blocks().size(), unknown_before);
  EXPECT_EQ(NumThings(*session_.Now()), 1);
}

TEST_P(LockTest, UnlockedItTakesWhatIsSeenOfIt) {
  Walk(With(EmptyRoom(), Chair()), 4);
  ExpectLeftAlone(id_);
  Lock(id_, false);
  const std::int64_t before = locked_->Find(id_)->info().num_frames_observed;
  Walk(With(EmptyRoom(), Chair()), 5);
  EXPECT_EQ(session_.Now()->Find(id_)->info().num_frames_observed, before + 5);
  EXPECT_FALSE(SubmapsAreEqual(*locked_->Find(id_), *session_.Now()->Find(id_)));
  EXPECT_EQ(NumThings(*session_.Now()), 1);
}

TEST_P(LockTest, ABackgroundIsLeftAloneToo) {
  SubmapId wall;
  for (const auto& submap : session_.Now()->submaps()) {
    if (submap->info().panoptic == Panoptic::kStuff && submap->info().class_id == kWall) wall = submap->id();
  }
  Lock(wall, true);
  const std::size_t num_submaps = locked_->submaps().size();
  Walk(With(EmptyRoom(), Chair()), 12);
  session_.builder().Finish();
  ExpectLeftAlone(wall);
  EXPECT_EQ(session_.Now()->submaps().size(), num_submaps) << "no second one of its class";
}

TEST_P(LockTest, NoFrameMergesOrDissolvesIt) {
  Map& map = session_.map();
  Submap& twin = *map.Clone(id_);  // in the same place: one object, as far as frames can tell
  const SubmapId other = twin.id();
  map.mutable_info().pairs.AddEvidence(id_, other, 1000, -1000, 1000);
  Lock(id_, true);
  Walk(With(EmptyRoom(), Chair()), 9);
  session_.builder().Finish();
  ExpectLeftAlone(id_);
  ASSERT_NE(session_.Now()->Find(other), nullptr);

  Lock(id_, false);
  session_.map().mutable_info().pairs.AddEvidence(id_, other, 1000, -1000, 1000);
  session_.builder().Finish();
  EXPECT_EQ(session_.map().Find(other), nullptr) << "merged, now that it may be";
}

TEST_P(LockTest, AFrameOfWhichOnlyItIsSeenMakesNoSubmap) {
  const std::size_t num_submaps = locked_->submaps().size();
  Walk({{Chair()}}, 5);
  ExpectLeftAlone(id_);
  EXPECT_EQ(session_.Now()->submaps().size(), num_submaps);
}

INSTANTIATE_TEST_SUITE_P(Ids, LockTest, ::testing::Bool(),
                         [](const auto& ids) { return ids.param ? "Persistent" : "PerFrame"; });

}  // namespace
}  // namespace dhpmap
