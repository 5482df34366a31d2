// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/sightings.h"

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
  std::vector<Sighting> many;
  for (std::size_t i = 0; i <= Sightings::kMost; ++i) {
    many.push_back({.session = std::string(i + 1, 'x'), .has_in_sight = true});
  }
  EXPECT_FALSE(Sightings::Create(many).ok());
}

}  // namespace
}  // namespace dhpmap
