// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/surface_cache.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <latch>
#include <stop_token>
#include <thread>
#include <vector>

#include "mapping/base/this_thread.h"
#include "mapping/query/distance_query.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kPlenty;

/// Asks all over the room, so that all surfaces are made.
double AskEverywhere(SurfaceCache& cache, const std::shared_ptr<const MapSnapshot>& state) {
  const DistanceQuery query(cache.Of(state), {.max_distance_m = 9});
  double sum_m = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(500, 1.9, 2)) sum_m += query.At(p).distance_m;
  return sum_m;
}

TEST(SurfaceCache, MakesNothingBeforeItIsAsked) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  const auto surfaces = cache.Of(map.Publish(0));
  EXPECT_EQ(surfaces->index().entries().size(), 5u);
  EXPECT_EQ(cache.bytes(), 0u);
  (void)DistanceQuery(surfaces, {.max_distance_m = 0.1}).At({-0.55, 0.8, 1.1});
  const std::size_t of_few = cache.bytes();
  EXPECT_GT(of_few, 0u);
  AskEverywhere(cache, map.published());
  EXPECT_GT(cache.bytes(), 2 * of_few);
}

TEST(SurfaceCache, NewPosesAndClonesMakeNothingAgain) {
  Map map(testing::SceneInfo());  // nothing is near to another, which may have been one surface with it
  for (const Eigen::Vector3d& centre : {Eigen::Vector3d(-1.1, 0.1, 0), Eigen::Vector3d(1.1, 0, 0.2)}) {
    testing::ObserveBand(testing::AddThing(map), testing::Ball(centre, 0.3), testing::CubeAt(centre, 0.5));
  }
  SurfaceCache cache(kPlenty);
  AskEverywhere(cache, map.Publish(0));
  const std::size_t bytes = cache.bytes(), tiles = cache.num_tiles();
  std::mt19937 random(3);
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap = testing::RandomPose(random, 0.5);
  map.Clone(SubmapId(1))->mutable_info().T_map_submap = testing::RandomPose(random, 0.5);
  AskEverywhere(cache, map.Publish(1));
  EXPECT_EQ(cache.bytes(), bytes);
  EXPECT_EQ(cache.num_tiles(), tiles);
}

TEST(SurfaceCache, WrittenVoxelsChangeTheSurfaceInTheNewStateOnly) {
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return p.x() - 0.01; };
  testing::ObserveBand(testing::AddThing(map), wall, testing::CubeAt({0, 0, 0}, 0.5));
  SurfaceCache cache(kPlenty);
  const auto before = map.Publish(0);
  const Eigen::Vector3d p(0.3, 0.02, 0.03);
  EXPECT_NEAR(DistanceQuery(cache.Of(before), {}).At(p).distance_m, 0.29, 1e-3);
  const auto nearer = [](const Eigen::Vector3d& q) { return q.x() - 0.06; };
  testing::ObserveBand(*map.FindMutable(SubmapId(1)), nearer, testing::CubeAt({0, 0, 0}, 0.5));
  const auto after = map.Publish(1);
  EXPECT_NEAR(DistanceQuery(cache.Of(after), {}).At(p).distance_m, 0.24, 1e-3);
  EXPECT_NEAR(DistanceQuery(cache.Of(before), {}).At(p).distance_m, 0.29, 1e-3);
}

/// A wall along y from the origin, as submap 1. Tiles are 1.6 m long.
Map WallAlongY(double length_m) {
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return p.x() - 0.01; };
  testing::ObserveBand(testing::AddThing(map), wall,
                       Eigen::AlignedBox3d(Eigen::Vector3d(-0.3, 0, 0), Eigen::Vector3d(0.3, length_m, 0.5)));
  return map;
}

TEST(SurfaceCache, OnlyTilesThatTouchAChangeAreMadeAgain) {
  Map map = WallAlongY(14.2);
  SurfaceCache cache(kPlenty);
  const auto ask_along = [&](const std::shared_ptr<const MapSnapshot>& state) {
    const DistanceQuery query(cache.Of(state), {});
    for (int i = 0; i < 142; ++i) (void)query.At({0.2, 0.1 * i, 0.2});
  };
  ask_along(map.Publish(0));
  const auto all = map.published();
  const std::size_t bytes = cache.bytes();
  map.FindMutable(SubmapId(1))->MutableTsdf(BlockOf(VoxelAt({0, 0.1, 0.1}, testing::kSceneVoxel_m))).weight[0] += 1;
  ask_along(map.Publish(1));
  EXPECT_GT(cache.bytes(), bytes);
  EXPECT_LT(cache.bytes(), bytes + bytes / 2) << "the old state is still held, and the new one shares the rest with it";
}

TEST(SurfaceCache, WhatShowsTheSameIsNotMadeAgain) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  const double truth = AskEverywhere(cache, map.Publish(0));
  const auto before = map.published();
  const auto first = cache.Of(before);
  const std::size_t bytes = cache.bytes();
  for (const auto& submap : before->submaps()) {
    for (const BlockEntry& block : submap->blocks().entries()) {
      map.FindMutable(submap->id())->MutableLabels(block.index).AddObservation(0, ClassId(2));
    }
  }
  EXPECT_EQ(AskEverywhere(cache, map.Publish(1)), truth);
  EXPECT_EQ(cache.bytes(), bytes);
  // Nor later, when the tiles it was made of are gone.
  EXPECT_EQ(AskEverywhere(cache, map.Publish(2)), truth);
  EXPECT_EQ(cache.bytes(), bytes);
  const auto last = cache.Of(map.published());
  for (std::size_t i = 0; i < first->index().entries().size(); ++i) {
    std::vector<Eigen::AlignedBox3d> changes_m;
    last->surface(i).AppendBoxes(&first->surface(i), changes_m);
    first->surface(i).AppendBoxes(&last->surface(i), changes_m);
    EXPECT_TRUE(changes_m.empty());
    last->surface(i).AppendBoxes(nullptr, changes_m);
    EXPECT_FALSE(changes_m.empty());
  }
}

TEST(SurfaceCache, AChangeBeyondTheReachOfATilesCellsLeavesItsSurface) {
  Map map = WallAlongY(3.2);
  SurfaceCache cache(kPlenty);
  const auto slots = [&] {
    const auto surfaces = cache.Of(map.published());
    const SubmapSurface* surface = surfaces->SurfaceOf(SubmapId(1)).get();
    return std::array{surface->SlotAt({0, 0, 0}), surface->SlotAt({0, 1, 0})};
  };
  const auto write_at = [&](double y_m) {
    map.FindMutable(SubmapId(1))->MutableTsdf(BlockOf(VoxelAt({0.1, y_m, 0.1}, testing::kSceneVoxel_m))).weight[0] += 1;
    map.Publish(0);
  };
  map.Publish(0);
  const auto before = slots();
  ASSERT_TRUE(before[0] && before[1]);
  write_at(3.0);
  const auto far = slots();
  EXPECT_EQ(far[0], before[0]) << "the block that was written touches none of the tile's";
  EXPECT_NE(far[1], before[1]);
  write_at(1.7);
  EXPECT_NE(slots()[0], before[0]);
}

TEST(SurfaceCache, IncrementalAnswersEqualThoseOfANewCacheOverRandomEdits) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int step = 0; step < 15; ++step) {
    const auto& submaps = map.submaps();
    const SubmapId id = submaps[random() % submaps.size()]->id();
    switch (random() % 5) {
      case 0: map.FindMutable(id)->mutable_info().T_map_submap = testing::RandomPose(random, 0.6); break;
      case 1: map.Clone(id)->mutable_info().T_map_submap = testing::RandomPose(random, 0.9); break;
      case 2:
        if (submaps.size() > 4) (void)map.Remove(id);
        break;
      case 3: {  // a bump
        const Eigen::Vector3d center{unit(random), unit(random), unit(random)};
        testing::ObserveBand(*map.FindMutable(id), testing::Ball(center, 0.15), testing::CubeAt(center, 0.3));
        break;
      }
      default: {
        Submap& submap = *map.FindMutable(id);
        if (!submap.blocks().empty()) (void)submap.EraseBlock(submap.blocks().entries().front().index);
        submap.UpdateBoundingSphere();
      }
    }
    const auto state = map.Publish(step);
    SurfaceCache fresh(kPlenty);
    const DistanceQuery incremental(cache.Of(state), {}), batch(fresh.Of(state), {});
    for (const Eigen::Vector3d& p : testing::RandomPoints(60, 1.8, static_cast<unsigned>(step / 5))) {
      const SurfaceDistance a = incremental.At(p), b = batch.At(p);
      for (int n = 0; n < 4; ++n) (void)incremental.At(p);  // until its cell is there, for the states that follow
      EXPECT_EQ(a.distance_m, b.distance_m) << step;
      EXPECT_EQ(a.status, b.status) << step;
      EXPECT_EQ(a.submap, b.submap) << step;
    }
  }
}

/// Whether a state had, or takes over, what is near a place, when it is asked about it for the first time.
bool HasCellAtOnce(const std::shared_ptr<const MapSurfaces>& surfaces, const Eigen::Vector3d& p) {
  (void)DistanceQuery(surfaces, {}).At(p);
  return surfaces->cells().SlotAt(p)->load() > CellSlots::kMostAsked;
}

TEST(SurfaceCache, WhatIsNearAPlaceIsKnownForAsLongAsNothingChangesThere) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  const Eigen::Vector3d at_ball(0.61, 0.0, 0.43), at_small(-0.55, 0.5, 0.9);  // before things 1 and 3
  const auto first = cache.Of(map.Publish(0));
  EXPECT_FALSE(HasCellAtOnce(first, at_ball));
  for (int n = 0; n < 5; ++n) {
    for (const Eigen::Vector3d& p : {at_ball, at_small}) (void)DistanceQuery(first, {}).At(p);
  }
  ASSERT_TRUE(HasCellAtOnce(first, at_ball) && HasCellAtOnce(first, at_small));
  map.FindMutable(SubmapId(1))->mutable_info().display_name = "globe";
  const auto renamed = cache.Of(map.Publish(1));
  EXPECT_TRUE(HasCellAtOnce(renamed, at_ball) && HasCellAtOnce(renamed, at_small));
  map.FindMutable(SubmapId(3))->mutable_info().T_map_submap.translation().z() -= 0.2;
  const auto moved = cache.Of(map.Publish(2));
  EXPECT_FALSE(HasCellAtOnce(moved, at_small));
  EXPECT_TRUE(map.Remove(SubmapId(2)));  // numbers are others from here on
  const auto removed = cache.Of(map.Publish(3));
  SurfaceCache fresh(kPlenty);
  const DistanceQuery incremental(removed, {}), anew(fresh.Of(map.published()), {});
  for (const Eigen::Vector3d& p : testing::RandomPoints(200, 1.5, 9)) {
    EXPECT_EQ(incremental.At(p).distance_m, anew.At(p).distance_m);
    EXPECT_EQ(incremental.At(p).submap, anew.At(p).submap);
  }
}

TEST(SurfaceCache, ARenamedSubmapAndOneThatMovesKeepTheirSurface) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  const auto first = cache.Of(map.Publish(0));
  map.FindMutable(SubmapId(1))->mutable_info().display_name = "globe";
  const auto renamed = cache.Of(map.Publish(1));
  EXPECT_EQ(renamed->SurfaceOf(SubmapId(1)), first->SurfaceOf(SubmapId(1)));
  EXPECT_EQ(renamed->index().entries()[renamed->NumberOf(SubmapId(1))].submap().info().display_name, "globe");
}

TEST(GridSharers, OverRandomEditsAreThoseOfANewOne) {
  Map map = testing::FurnishedRoom();
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<std::shared_ptr<const MapSnapshot>> states;
  std::vector<std::unique_ptr<const GridSharers>> sharers;
  int num_same = 0;
  for (int step = 0; step < 40; ++step) {
    const auto& submaps = map.submaps();
    const SubmapId id = submaps[random() % submaps.size()]->id();
    switch (random() % 5) {
      case 0: map.FindMutable(id)->mutable_info().T_map_submap = testing::RandomPose(random, 0.6); break;
      case 1: map.FindMutable(id)->mutable_info().display_name = std::to_string(step); break;
      case 2:
        if (submaps.size() > 4) (void)map.Remove(id);
        break;
      case 3: {
        const Eigen::Vector3d center = 2.5 * Eigen::Vector3d{unit(random), unit(random), unit(random)};
        testing::ObserveBand(testing::AddThing(map), testing::Ball(center, 0.15), testing::CubeAt(center, 0.3));
        break;
      }
      default: {
        Submap& submap = *map.FindMutable(id);
        if (!submap.blocks().empty()) (void)submap.EraseBlock(submap.blocks().entries().front().index);
      }
    }
    states.push_back(map.Publish(step));
    sharers.push_back(
        std::make_unique<const GridSharers>(*states.back(), sharers.empty() ? nullptr : sharers.back().get()));
    if (step > 0) num_same += sharers.back()->IsSameAs(*sharers[sharers.size() - 2]);
    const GridSharers anew(*states.back(), nullptr);
    for (int z = -3; z <= 3; ++z) {
      for (int n = 0; n < 49; ++n) {
        const TileIndex tile{n % 7 - 3, n / 7 - 3, z};
        const auto &a = sharers.back()->AroundOf(tile), &b = anew.AroundOf(tile);
        ASSERT_EQ(a == nullptr, b == nullptr) << step;
        if (a == nullptr) continue;
        ASSERT_EQ(a->holders, b->holders) << step;
      }
    }
  }
  EXPECT_GT(num_same, 5) << "nothing is made for a name";
  EXPECT_LT(num_same, 30);
}

TEST(SurfaceCache, KeepsToItsLimitAndAnswersTheSame) {
  Map map = testing::FurnishedRoom();
  SurfaceCache plenty(kPlenty);
  const double truth = AskEverywhere(plenty, map.Publish(0));
  SurfaceCache cache(plenty.bytes() / 3);
  for (int n = 0; n < 3; ++n) EXPECT_EQ(AskEverywhere(cache, map.published()), truth);
  (void)cache.Of(map.published());
  EXPECT_LE(cache.bytes(), plenty.bytes() / 3);
}

TEST(SurfaceCache, ForgetsMapsThatAreGone) {
  const auto ask_a_map_of_its_own = [](SurfaceCache& cache) {
    Map map(testing::SceneInfo());
    testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.3), testing::CubeAt({0, 0, 0}, 0.5));
    AskEverywhere(cache, map.Publish(0));
  };
  SurfaceCache cache(kPlenty);
  for (int n = 0; n < 20; ++n) ask_a_map_of_its_own(cache);
  SurfaceCache one(kPlenty);
  ask_a_map_of_its_own(one);
  EXPECT_LT(cache.bytes(), 8 * one.bytes()) << "it sweeps when what it has has doubled";
}

TEST(SurfaceCache, ForgetsAMapThatIsClosedOnceItIsTold) {
  SurfaceCache cache(kPlenty);
  {
    Map map = testing::FurnishedRoom();
    AskEverywhere(cache, map.Publish(0));
    cache.Forget(map.info().name);
    EXPECT_GT(cache.bytes(), 0u) << "the state is still there";
  }
  cache.Forget("another");
  cache.Forget(testing::SceneInfo().name);
  EXPECT_EQ(cache.bytes() + cache.cell_bytes(), 0u);
}

TEST(SurfaceCache, WhoIsStillAskingOfAMapThatIsForgottenLeavesNothingBehind) {
  for (int round = 0; round < 20; ++round) {
    SurfaceCache cache(kPlenty);
    std::string name;
    {
      Map map = testing::FurnishedRoom();
      name = map.info().name;
      const auto state = map.Publish(0);
      const std::jthread asker([&] { (void)DistanceQuery(cache.Of(state), {}).At({0.5, 0.8, 1.1}); });
      cache.Forget(name);
    }
    cache.Forget(name);
    EXPECT_EQ(cache.bytes() + cache.cell_bytes(), 0u);
  }
}

TEST(SurfaceCache, WhatEachStateLeavesBehindIsBounded) {
  Map map(testing::SceneInfo());
  testing::AddThing(map);
  SurfaceCache cache(kPlenty);
  std::size_t least = kPlenty, most = 0;
  for (int n = 0; n < 60; ++n) {
    const auto ball = testing::Ball({0, 0, 0}, 0.3 + 0.01 * (n % 2));
    testing::ObserveBand(*map.FindMutable(SubmapId(1)), ball, testing::CubeAt({0, 0, 0}, 0.5));
    AskEverywhere(cache, map.Publish(n));
    if (n > 0) least = std::min(least, cache.bytes());
    most = std::max(most, cache.bytes());
  }
  EXPECT_LT(most, 20 * least) << least;
}

TEST(SurfaceCache, OfStatesThatSomebodyKeepsThoseAskedForLastAreKnown) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  std::mt19937 random(7);
  std::vector<std::shared_ptr<const MapSnapshot>> states;
  for (int i = 0; i < 20; ++i) {
    map.FindMutable(SubmapId(2))->mutable_info().T_map_submap = testing::RandomPose(random, 0.5);
    states.push_back(map.Publish(i));
  }
  const double truth = AskEverywhere(cache, states[0]);
  const auto first = cache.Of(states[0]), second = cache.Of(states[1]);
  for (const auto& state : states) {
    (void)cache.Of(state);
    EXPECT_EQ(cache.Of(states[1]).get(), second.get()) << "it is asked for again and again";
  }
  EXPECT_NE(cache.Of(states[0]).get(), first.get());
  EXPECT_EQ(AskEverywhere(cache, states[0]), truth);
}

TEST(SurfaceCache, ThreadsMayAskWhileOthersMakeAndEvict) {
  Map map = testing::FurnishedRoom();
  SurfaceCache plenty(kPlenty);
  const double truth = AskEverywhere(plenty, map.Publish(0));
  const std::size_t limit_bytes = plenty.bytes() / 2;
  SurfaceCache cache(limit_bytes);
  {
    std::vector<std::jthread> threads;
    threads.reserve(4);
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int n = 0; n < 3; ++n) EXPECT_EQ(AskEverywhere(cache, map.published()), truth);
      });
    }
  }
  (void)cache.Of(map.published());
  EXPECT_LE(cache.bytes(), limit_bytes) << "nothing is kept that nobody knows of";
}

TEST(SurfaceCache, ThreadsThatWantASurfaceAtOnceGetOneThatIsCountedOnce) {
  constexpr std::size_t kThreads = 6;
  Map map = testing::FurnishedRoom();
  const auto state = map.Publish(0);
  SurfaceCache alone(kPlenty);
  const auto prepare = [&](SurfaceCache& cache, std::latch& all_here) {
    std::vector<const TriangleTree*> made;
    const auto surfaces = cache.Of(state);
    all_here.arrive_and_wait();
    const std::span<const SubmapIndex::Entry> entries = surfaces->index().entries();
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const SubmapSurface& surface = surfaces->surface(i);
      for (std::size_t t = 0; t < surface.num_tiles(); ++t)
        made.push_back(&surface.Surface(*state, entries[i].submap(), t));
    }
    return made;
  };
  std::latch nobody_else(1);
  ASSERT_GT(prepare(alone, nobody_else).size(), 5u);
  for (int round = 0; round < 20; ++round) {
    SurfaceCache cache(kPlenty);
    std::array<std::vector<const TriangleTree*>, kThreads> made;
    {
      std::latch all_here(kThreads);
      std::vector<std::jthread> threads;
      threads.reserve(kThreads);
      for (std::size_t t = 0; t < kThreads; ++t) {
        threads.emplace_back([&, t] {
          if (t % 2 == 1) MakeThisThreadNicer(1);  // those wait for one another alone
          made[t] = prepare(cache, all_here);
        });
      }
    }
    for (const auto& of_thread : made) ASSERT_EQ(of_thread, made[0]);
    ASSERT_EQ(cache.bytes(), alone.bytes()) << "one that was made twice is counted once";
  }
}

/// So many that some are mostly in the middle of it.
TEST(SurfaceCache, EvictsWhileOthersGoOnMarkingWhatTheyUse) {
  constexpr std::size_t kMarking = 6, kAsking = 2;
  constexpr int kRounds = 30, kMarks = 200;
  Map map = testing::FurnishedRoom();
  SurfaceCache plenty(kPlenty);
  const double truth = AskEverywhere(plenty, map.Publish(0));
  SurfaceCache cache(plenty.bytes() / 2);
  const auto mark = [&](const std::stop_token& is_over) {
    while (!is_over.stop_requested()) {
      const auto surfaces = cache.Of(map.published());
      const std::size_t num_surfaces = surfaces->index().entries().size();
      for (std::size_t n = 0; n < kMarks; ++n) {
        const SubmapSurface& surface = surfaces->surface(n % num_surfaces);
        for (std::size_t tile = 0; tile < surface.num_tiles(); ++tile) surface.MarkUsed(tile);
      }
    }
  };
  std::vector<std::jthread> marking, asking;
  for (std::size_t i = 0; i < kMarking; ++i) marking.emplace_back(mark);
  for (std::size_t i = 0; i < kAsking; ++i) {
    asking.emplace_back([&] {
      for (int round = 0; round < kRounds; ++round) EXPECT_EQ(AskEverywhere(cache, map.published()), truth);
    });
  }
}

}  // namespace
}  // namespace dhpmap
