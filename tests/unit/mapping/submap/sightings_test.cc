// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/sightings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>

namespace dhpmap {
namespace {

TEST(Sightings, MissesCountForTheSessionWhoseFramesTheyAreAlone) {
  Sightings sightings;
  sightings.OnSeen("a", 1);
  sightings.OnSeen("b", 2);
  sightings.OnMissed("b", 3);
  sightings.OnMissed("b", 4);
  sightings.OnMissed("c", 5);
  EXPECT_EQ(sightings.LeastMissed(), 0);
  sightings.Lapse(2, 5, 1000);
  EXPECT_TRUE(sightings.IsInSightOf("a"));
  EXPECT_FALSE(sightings.IsInSightOf("b"));
  EXPECT_FALSE(sightings.IsInSightOf("c")) << "it has never seen it";
  EXPECT_EQ(sightings.all().size(), 1u) << "what says nothing is not kept";
  sightings.OnMissed("a", 6);
  EXPECT_EQ(sightings.LeastMissed(), 1);
  sightings.OnSeen("a", 7);
  EXPECT_EQ(sightings.LeastMissed(), 0);
}

TEST(Sightings, WhoSendsNothingHasNothingInSight) {
  Sightings sightings;
  EXPECT_FALSE(sightings.IsDeserted(100, 10)) << "nobody was there";
  sightings.OnSeen("a", 1);
  EXPECT_FALSE(sightings.IsDeserted(11, 10));
  EXPECT_TRUE(sightings.IsDeserted(12, 10));
  sightings.OnMissed("a", 5);
  EXPECT_FALSE(sightings.IsDeserted(15, 10));
  sightings.Lapse(100, 16, 10);
  EXPECT_FALSE(sightings.IsInSight());
}

TEST(Sightings, TracksOutlastSight) {
  Sightings sightings;
  sightings.SetTrack("a", 7);
  sightings.OnSeen("a", 1);
  sightings.OnSeen("b", 2);
  sightings.LapseAll();
  EXPECT_EQ(sightings.TrackOf("a"), 7u);
  EXPECT_EQ(sightings.TrackOf("b"), 0u);
  EXPECT_TRUE(sightings.HasTrack());
  EXPECT_EQ(sightings.all().size(), 1u);
}

TEST(Sightings, OfTwoThingsThatAreOneTheNearerCounts) {
  Sightings a, b;
  a.SetTrack("x", 1);
  a.OnSeen("y", 1);
  for (int frame = 2; frame < 5; ++frame) a.OnMissed("y", frame);
  b.SetTrack("x", 2);
  b.SetTrack("z", 3);
  b.OnSeen("y", 3);
  a.Merge(b);
  EXPECT_EQ(a.TrackOf("x"), 1u);
  EXPECT_EQ(a.TrackOf("z"), 3u);
  EXPECT_TRUE(a.IsInSightOf("y"));
  EXPECT_EQ(a.LeastMissed(), 0);
  EXPECT_FALSE(a.IsDeserted(14, 10)) << "the last frame of both";
}

TEST(Sightings, OfTwoThingsThatAreOneASessionKnowsTheWholeByTheIdsOfBoth) {
  Sightings whole, part;
  whole.SetTrack("x", 5);
  for (const std::uint32_t id : {9u, 2u, 5u}) part.AddTrack("x", id);
  part.OnSeen("x", 4);
  whole.Merge(part);
  EXPECT_EQ(whole.TrackOf("x"), 5u);
  for (const std::uint32_t id : {2u, 5u, 9u}) EXPECT_TRUE(whole.IsTrackedAs("x", id)) << id;
  EXPECT_FALSE(whole.IsTrackedAs("x", 3));
  EXPECT_FALSE(whole.IsTrackedAs("y", 5));
  EXPECT_TRUE(whole.IsInSightOf("x"));
  ASSERT_EQ(whole.all().size(), 3u) << "each id once";
  const Result<Sightings> read_back = Sightings::Create(whole.all());
  ASSERT_TRUE(read_back.ok()) << read_back.status().ToString();
  EXPECT_EQ(*read_back, whole);

  whole.LapseAll();
  EXPECT_TRUE(whole.IsTrackedAs("x", 2)) << "ids outlast sight";
  whole.ForgetTrack("x", 5);
  EXPECT_EQ(whole.TrackOf("x"), 2u) << "the next one";
  EXPECT_TRUE(whole.IsTrackedAs("x", 9));
  whole.SetTrack("x", 7);
  EXPECT_EQ(whole.all().size(), 1u) << "its only one";
  whole.ForgetTrack("x", 8);
  whole.ForgetTrack("y", 7);
  EXPECT_EQ(whole.TrackOf("x"), 7u);
  whole.ForgetTrack("x", 7);
  EXPECT_TRUE(whole.all().empty());
}

TEST(Sightings, AForgottenIdLeavesWhatTheSessionHasInSight) {
  Sightings sightings;
  sightings.OnSeen("x", 3);
  sightings.AddTrack("x", 4);
  sightings.AddTrack("x", 6);
  sightings.ForgetTrack("x", 4);
  sightings.ForgetTrack("x", 6);
  EXPECT_TRUE(sightings.IsInSightOf("x"));
  EXPECT_FALSE(sightings.HasTrack());
}

TEST(Sightings, ASessionHasNoMoreIdsThanMayBeAndGoesWithAllOfThem) {
  Sightings sightings;
  const auto most = static_cast<std::uint32_t>(Sightings::kMostTracks);
  for (std::uint32_t id = 1; id <= most + 3; ++id) sightings.AddTrack("old", id);
  EXPECT_EQ(sightings.all().size(), Sightings::kMostTracks);
  EXPECT_EQ(sightings.TrackOf("old"), 1u);
  for (std::uint32_t id = 2; id <= most + 3; ++id) {
    EXPECT_EQ(sightings.IsTrackedAs("old", id), id > 4) << id << ": the newest is the one that frames use";
  }
  sightings.AddTrack("old", 3);
  EXPECT_TRUE(sightings.IsTrackedAs("old", 3)) << "also where it is the smallest";
  EXPECT_FALSE(sightings.IsTrackedAs("old", 5));
  EXPECT_EQ(sightings.all().size(), Sightings::kMostTracks);
  EXPECT_TRUE(Sightings::Create(sightings.all()).ok());
  for (std::size_t i = 1; i < Sightings::kMost; ++i) {
    sightings.OnSeen("s" + std::to_string(i), static_cast<std::int64_t>(i));
  }
  EXPECT_TRUE(sightings.IsTrackedAs("old", 1)) << "ids take no session's place";
  sightings.OnSeen("one more", 1000);
  EXPECT_FALSE(sightings.IsTrackedAs("old", 1));
  EXPECT_EQ(sightings.all().size(), Sightings::kMost);
}

TEST(Sightings, NoMoreAreKeptThanMayBeAndTheOldestGo) {
  Sightings sightings;
  const auto name = [](int i) { return "s" + std::to_string(i); };
  const int most = static_cast<int>(Sightings::kMost);
  for (int i = 0; i < most + 3; ++i) sightings.OnSeen(name(i), 1 + i);
  EXPECT_EQ(sightings.all().size(), Sightings::kMost);
  for (int i = 0; i < most + 3; ++i) EXPECT_EQ(sightings.IsInSightOf(name(i)), i >= 3) << i;
  EXPECT_TRUE(Sightings::Create(sightings.all()).ok());
}

/// Against a table of all that was said, looked through anew for each answer.
TEST(Sightings, AnswersAreThoseOfALogOfAllFrames) {
  std::mt19937 random(7);
  const std::string names[] = {"", "a", "b", "c"};
  struct Seen {
    int missed = 0;
    std::int64_t last_frame = 0;
  };
  Sightings sightings;
  std::map<std::string, Seen> reference;
  for (std::int64_t frame = 1; frame < 5000; ++frame) {
    const std::string& session = names[random() % (random() % 20 == 0 ? 4 : 3)];
    if (random() % 4 == 0) {
      sightings.OnSeen(session, frame);
      reference[session] = {0, frame};
    } else {
      sightings.OnMissed(session, frame);
      if (const auto it = reference.find(session); it != reference.end())
        ++it->second.missed, it->second.last_frame = frame;
    }
    sightings.Lapse(5, frame, 30);
    std::erase_if(reference,
                  [&](const auto& entry) { return entry.second.missed >= 5 || frame - entry.second.last_frame > 30; });
    ASSERT_EQ(sightings.IsInSight(), !reference.empty());
    ASSERT_EQ(sightings.all().size(), reference.size());
    for (const std::string& name : names) ASSERT_EQ(sightings.IsInSightOf(name), reference.contains(name));
    if (reference.empty()) continue;
    const auto nearest = std::min_element(reference.begin(), reference.end(), [](const auto& x, const auto& y) {
      return x.second.missed < y.second.missed;
    });
    ASSERT_EQ(sightings.LeastMissed(), nearest->second.missed);
  }
}

TEST(Sightings, AListThatCannotBeIsRefused) {
  const Sighting a{.session = "a", .has_in_sight = true}, b{.session = "b", .track_id = 1};
  EXPECT_TRUE(Sightings::Create({a, b}).ok());
  EXPECT_FALSE(Sightings::Create({b, a}).ok());
  EXPECT_FALSE(Sightings::Create({a, a}).ok());
  EXPECT_FALSE(Sightings::Create({{.session = "nothing"}}).ok());
  const auto with_track = [](std::uint32_t track_id) { return Sighting{.session = "b", .track_id = track_id}; };
  EXPECT_TRUE(Sightings::Create({with_track(5), with_track(1), with_track(9)}).ok()) << "several ids";
  EXPECT_FALSE(Sightings::Create({with_track(5), with_track(9), with_track(1)}).ok()) << "in another order";
  EXPECT_FALSE(Sightings::Create({with_track(5), with_track(5)}).ok());
  EXPECT_FALSE(Sightings::Create({with_track(5), with_track(9), with_track(9)}).ok());
  EXPECT_FALSE(Sightings::Create({{.session = "b", .has_in_sight = true}, with_track(9)}).ok());
  EXPECT_FALSE(Sightings::Create({with_track(5), {.session = "b", .track_id = 9, .has_in_sight = true}}).ok());
  EXPECT_FALSE(Sightings::Create({with_track(5), {.session = "b", .track_id = 9, .last_frame = 3}}).ok());
  std::vector<Sighting> many;
  for (std::size_t i = 0; i <= Sightings::kMost; ++i) {
    many.push_back({.session = std::string(i + 1, 'x'), .has_in_sight = true});
  }
  EXPECT_FALSE(Sightings::Create(many).ok());
}

}  // namespace
}  // namespace dhpmap
