// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/follow/followed_maps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/eventually.h"
#include "tests/support/lone_fleet.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap {
namespace {

using testing::Eventually;
using Names = std::vector<std::string>;

/// The test reports commits to it.
class ToldFleet final : public testing::LoneFleet {
 public:
  void OnChange(std::function<void(const std::string&, std::int64_t)> on_change) override {
    on_change_ = std::move(on_change);
  }
  void SetFollowed(std::vector<std::string> maps) override {
    const MutexLock lock(mutex_);
    followed_ = std::move(maps);
  }
  void MeasureFollowing(std::function<FollowingState()> measure) override { measure_ = std::move(measure); }
  void Tell(const std::string& map) const { on_change_(map, 0); }
  [[nodiscard]] FollowingState Measure() const { return measure_(); }
  Names followed() const {
    const MutexLock lock(mutex_);
    return followed_;
  }

 private:
  std::function<void(const std::string&, std::int64_t)> on_change_;
  std::function<FollowingState()> measure_;
  mutable Mutex mutex_;
  Names followed_ DHPMAP_GUARDED_BY(mutex_);
};

/// A memory store with outages, which counts reads.
class AwayStore final : public testing::WrappedStore {
 public:
  Result<StateToRead> LoadToRead(const std::string& name) override {
    ++num_loads;
    if (is_away) return Unavailable("it is away");
    return inner().LoadToRead(name);
  }
  Result<StateToRead> ReadSince(const StateToRead& before) override {
    ++num_looks;
    if (is_away) return Unavailable("it is away");
    return inner().ReadSince(before);
  }

  std::atomic<int> num_loads = 0, num_looks = 0;
  std::atomic<bool> is_away = false;
};

class FollowedMapsTest : public ::testing::Test {
 protected:
  FollowedMapsTest() {
    Create("room");
    Create("yard");
  }
  void Create(const std::string& name) {
    MapInfo info;
    info.name = name;
    info.history_id = 7;
    info.create_time_ns = 1;
    auto& map = written_[name] = std::make_unique<Map>(info);
    map->Create({.voxel_size_m = 0.05, .truncation_m = 0.2}).MutableTsdf({0, 0, 0});
    ASSERT_TRUE(store_.CreateMap(*map->Publish(1)).ok());
  }
  void Follow(FollowOptions options = {}) {
    options.watched = [this] { return watched_; };
    maps_ = std::make_unique<FollowedMaps>(store_, fleet_, std::move(options));
  }
  std::int64_t Commit(const std::string& name, int num_submaps = 0) {
    Map& map = *written_.at(name);
    const auto before = map.published();
    map.mutable_info().num_frames += 1;
    for (int n = 0; n < num_submaps; ++n) {
      map.Create({.voxel_size_m = 0.05, .truncation_m = 0.2}).MutableTsdf({0, 0, 0});
    }
    EXPECT_TRUE(store_.Commit(*before, *map.Publish(2), Durability::kNormal).ok());
    return map.published()->revision();
  }
  std::int64_t RevisionOf(const std::string& name) {
    const auto view = maps_->ViewOf(name);
    EXPECT_TRUE(view.ok()) << view.status().ToString();
    return view.ok() ? (*view)->snapshot().revision() : -1;
  }
  bool Reaches(const std::string& name, std::int64_t revision) {
    return Eventually([&] { return maps_->Find(name)->snapshot().revision() == revision; });
  }
  static FollowOptions LooksOnlyWhenTold() { return {.look_every = std::chrono::hours(1)}; }

  ToldFleet fleet_;
  AwayStore store_;
  Names watched_;
  std::map<std::string, std::unique_ptr<Map>> written_;
  std::unique_ptr<FollowedMaps> maps_;  // last: it uses the others
};

TEST_F(FollowedMapsTest, ACopyIsReadOnceAndUpdatedAfterEachReportedCommit) {
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(maps_->Find("room"), nullptr);
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_TRUE(Eventually([&] { return store_.num_looks == 1; })) << "for what was committed before it was followed";
  for (int n = 0; n < 5; ++n) {
    const std::int64_t revision = Commit("room");
    fleet_.Tell("room");
    EXPECT_TRUE(Reaches("room", revision));
    EXPECT_EQ(RevisionOf("room"), revision);
  }
  EXPECT_EQ(store_.num_loads, 1);
  EXPECT_EQ(maps_->num_maps(), 1u);
}

TEST_F(FollowedMapsTest, AReaderOfALaterStateNeverGetsAnOlderOne) {
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(RevisionOf("room"), 1);
  ASSERT_TRUE(Eventually([&] { return store_.num_looks == 1; }));
  const std::int64_t revision = Commit("room");
  EXPECT_EQ(RevisionOf("room"), 1) << "nobody has told of it";
  EXPECT_EQ((*maps_->ViewOf("room", revision))->snapshot().revision(), revision);
  EXPECT_EQ((*maps_->ViewOf("room", revision + 9))->snapshot().revision(), revision) << "there is no later one";
}

TEST_F(FollowedMapsTest, AViewStaysAsItIs) {
  Follow(LooksOnlyWhenTold());
  const auto view = maps_->ViewOf("room");
  ASSERT_TRUE(view.ok());
  const std::int64_t revision = Commit("room", 3);
  fleet_.Tell("room");
  ASSERT_TRUE(Reaches("room", revision));
  EXPECT_EQ((*view)->snapshot().revision(), 1);
  EXPECT_EQ((*view)->snapshot().submaps().size(), 2u);
  EXPECT_EQ((*maps_->ViewOf("room"))->snapshot().submaps().size(), 5u);
}

TEST_F(FollowedMapsTest, AnUnreportedCommitIsFoundNevertheless) {
  Follow({.look_every = std::chrono::milliseconds(1)});
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_TRUE(Reaches("room", Commit("room")));
}

TEST_F(FollowedMapsTest, ConcurrentReadersReadTheMapOnce) {
  Follow(LooksOnlyWhenTold());
  std::vector<std::thread> readers;
  for (int n = 0; n < 4; ++n) readers.emplace_back([this] { EXPECT_EQ(RevisionOf("room"), 1); });
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(store_.num_loads, 1);
}

TEST_F(FollowedMapsTest, TheFleetKnowsWhichMapsAreFollowedOrWatched) {
  watched_ = {"yard", "attic"};
  Follow(LooksOnlyWhenTold());
  maps_->NoteWatched();
  EXPECT_TRUE(Eventually([&] { return fleet_.followed() == Names{"attic", "yard"}; }));
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_TRUE(Eventually([&] { return fleet_.followed() == Names{"attic", "room", "yard"}; }));
  maps_->Drop("room");
  maps_->NoteWatched();
  EXPECT_TRUE(Eventually([&] { return fleet_.followed() == Names{"attic", "yard"}; }));
}

TEST_F(FollowedMapsTest, EveryCommitIsPassedOnForWatchers) {
  Names told;
  FollowOptions options = LooksOnlyWhenTold();
  options.on_commit = [&told](const std::string& map) { told.push_back(map); };
  Follow(std::move(options));
  fleet_.Tell("yard");
  EXPECT_EQ(told, Names{"yard"}) << "which nobody follows";
  maps_->Stop();
  fleet_.Tell("yard");
  EXPECT_EQ(told, Names{"yard"}) << "nobody is called any more";
  EXPECT_EQ(maps_->ViewOf("yard").status().code(), StatusCode::kUnavailable);
}

TEST_F(FollowedMapsTest, AMissingMapLeavesNoCopy) {
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(maps_->ViewOf("attic").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(maps_->num_maps(), 0u);
}

TEST_F(FollowedMapsTest, ADeletedMapsCopyIsDropped) {
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(RevisionOf("room"), 1);
  ASSERT_TRUE(store_.DeleteMap("room").ok());
  fleet_.Tell("room");
  EXPECT_TRUE(Eventually([&] { return maps_->Find("room") == nullptr; }));
  EXPECT_EQ(maps_->ViewOf("room").status().code(), StatusCode::kNotFound);
  EXPECT_TRUE(Eventually([&] { return maps_->bytes() == 0; }));
}

TEST_F(FollowedMapsTest, ACopySurvivesAnOutageOfTheStoreAndCatchesUp) {
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(RevisionOf("room"), 1);
  ASSERT_TRUE(Eventually([&] { return store_.num_looks == 1; }));
  store_.is_away = true;
  const std::int64_t revision = Commit("room");
  fleet_.Tell("room");
  ASSERT_TRUE(Eventually([&] { return store_.num_looks > 1; }));
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_EQ(maps_->ViewOf("yard").status().code(), StatusCode::kUnavailable);
  store_.is_away = false;
  EXPECT_TRUE(Reaches("room", revision)) << "it tries again by itself";
  EXPECT_EQ(RevisionOf("yard"), 1);
}

TEST_F(FollowedMapsTest, ACopysLagStartsWithTheFirstMissingCommit) {
  constexpr std::chrono::seconds kLater{10};
  const auto behind_s = [this](std::chrono::seconds later) {
    return maps_->StateAt(FollowedMaps::Clock::now() + later).behind_s;
  };
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_EQ(RevisionOf("yard"), 1);
  ASSERT_TRUE(Eventually([&] { return store_.num_looks == 2; }));
  EXPECT_EQ(behind_s(kLater), 0);
  store_.is_away = true;
  Commit("room");
  fleet_.Tell("room");
  EXPECT_GE(behind_s(kLater), 10);
  ASSERT_TRUE(Eventually([&] { return store_.num_looks > 4; }));
  const std::int64_t revision = Commit("room");
  fleet_.Tell("room");
  EXPECT_GE(behind_s(kLater), 10) << "reads that fail change nothing";
  EXPECT_EQ(fleet_.Measure().num_copies, 2);
  EXPECT_GT(fleet_.Measure().behind_s, 0);
  EXPECT_EQ(fleet_.Measure().bytes, static_cast<std::int64_t>(maps_->bytes()));
  store_.is_away = false;
  EXPECT_TRUE(Reaches("room", revision));
  EXPECT_TRUE(Eventually([&] { return behind_s(kLater) == 0; }));
  maps_->Stop();
  EXPECT_EQ(fleet_.Measure().num_copies, 0) << "the fleet may outlive the copies";
}

TEST_F(FollowedMapsTest, TheNumberOfCopiesIsLimited) {
  FollowOptions few = LooksOnlyWhenTold();
  few.max_maps = 1;
  Follow(std::move(few));
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_EQ(maps_->ViewOf("yard").status().reason(), Reason("TOO_BUSY"));
  maps_->Drop("room");
  EXPECT_EQ(RevisionOf("yard"), 1);
}

TEST_F(FollowedMapsTest, ACopyThatDoesNotFitIntoMemoryIsDropped) {
  Follow(LooksOnlyWhenTold());
  EXPECT_EQ(RevisionOf("room"), 1);
  const std::size_t one = maps_->bytes();
  ASSERT_GT(one, sizeof(TsdfBlock));
  FollowOptions tight = LooksOnlyWhenTold();
  tight.max_bytes = one + one / 2;
  Follow(std::move(tight));
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_EQ(maps_->ViewOf("yard").status().reason(), Reason("TOO_BUSY"));
  EXPECT_EQ(maps_->bytes(), one);
  Commit("room", 2);  // it has outgrown the room
  fleet_.Tell("room");
  EXPECT_TRUE(Eventually([&] { return maps_->Find("room") == nullptr && maps_->bytes() == 0; }));
  EXPECT_EQ(RevisionOf("yard"), 1);
}

TEST_F(FollowedMapsTest, UnusedCopiesAreDropped) {
  Follow({.idle_drop_s = std::chrono::duration<double>(60), .look_every = std::chrono::hours(1)});
  EXPECT_EQ(RevisionOf("room"), 1);
  maps_->DropIdle(FollowedMaps::Clock::now() + std::chrono::seconds(30));
  EXPECT_EQ(maps_->num_maps(), 1u);
  maps_->DropIdle(FollowedMaps::Clock::now() + std::chrono::seconds(90));
  EXPECT_EQ(maps_->num_maps(), 0u);
  EXPECT_TRUE(Eventually([&] { return maps_->bytes() == 0; }));
  EXPECT_EQ(RevisionOf("room"), 1);
  EXPECT_EQ(store_.num_loads, 2);
}

}  // namespace
}  // namespace dhpmap
