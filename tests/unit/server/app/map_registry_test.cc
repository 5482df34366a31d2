// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/map_registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <map>
#include <string>

#include "mapping/query/distance_query.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/support/thread_ids.h"
#include "tests/support/wrapped_store.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

MapInfo InfoOf(const std::string& name) {
  MapInfo info;
  info.name = name;
  info.label_set = testing::MakeLabelSet(1, 1);
  return info;
}

/// A memory store that counts loads, and on request refuses calls or delays one map.
class MoodyStore final : public testing::WrappedStore {
 public:
  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    ++num_lists;
    return inner().ListMaps(after, max);
  }
  Result<StoredMap> GetMap(const std::string& name) override {
    ++num_asked;
    auto map = inner().GetMap(name);
    if (map.ok()) map->lost_revisions = lost_revisions[name];
    return map;
  }
  Status CreateMap(const MapSnapshot& snapshot) override {
    return refusal.ok() ? inner().CreateMap(snapshot) : refusal;
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    if (!refusal.ok()) return refusal;
    if (name == "slow" && !has_been_slow.exchange(true)) {
      is_loading_slow.set_value();
      may_go_on.get_future().wait();
    }
    auto map = inner().LoadMap(name);
    num_loads += map.ok() ? 1 : 0;
    return map;
  }
  Status DeleteMap(const std::string& name) override {
    if (!refusal.ok()) return refusal;
    lost_revisions.erase(name);
    return inner().DeleteMap(name);
  }

  Status refusal;
  std::map<std::string, LostRevisions> lost_revisions;
  std::atomic<int> num_loads = 0, num_asked = 0, num_lists = 0;
  std::promise<void> is_loading_slow, may_go_on;
  std::atomic<bool> has_been_slow = false;
};

class MapRegistryTest : public ::testing::Test {
 protected:
  std::unique_ptr<MapRegistry> Open() {
    OpenMapOptions options{.mapping = {.num_threads = 1},
                           .now_ns = [] { return std::int64_t{1'600'000'000'000'000'000}; }};
    return std::move(MapRegistry::Open(store_, std::move(options))).value();
  }

  MoodyStore store_;
  std::unique_ptr<MapRegistry> registry_ = Open();
};

TEST_F(MapRegistryTest, AMapIsStoredBeforeItsCreationIsAnswered) {
  const auto made = registry_->Create(InfoOf("room"));
  ASSERT_TRUE(made.ok()) << made.status().message();
  EXPECT_EQ(made->info.create_time_ns, 1'600'000'000'000'000'000);
  EXPECT_EQ(made->num_submaps, 1) << "the unknown submap";
  const auto stored = store_.GetMap("room");
  ASSERT_TRUE(stored.ok());
  EXPECT_EQ(stored->info.create_time_ns, made->info.create_time_ns);
  EXPECT_EQ(stored->info.revision, made->info.revision);
}

TEST_F(MapRegistryTest, ANameMustBeValidAndFree) {
  EXPECT_EQ(registry_->Create(InfoOf("")).status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(registry_->Create(InfoOf("../etc")).status().code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(registry_->Create(InfoOf("room")).ok());
  EXPECT_EQ(registry_->Create(InfoOf("room")).status().code(), StatusCode::kAlreadyExists);
  EXPECT_TRUE(registry_->Delete("room").ok());
  EXPECT_TRUE(registry_->Create(InfoOf("room")).ok());
}

TEST_F(MapRegistryTest, AMapThatCannotBeStoredDoesNotExist) {
  store_.refusal = ResourceExhausted("the disk is full");
  EXPECT_EQ(registry_->Create(InfoOf("room")).status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(registry_->Get("room").status().code(), StatusCode::kNotFound);
  EXPECT_TRUE(registry_->List("", 10)->empty());
  store_.refusal = Status::Ok();
  EXPECT_TRUE(registry_->Create(InfoOf("room")).ok());
}

TEST_F(MapRegistryTest, RevisionsLostInACrashBelongToThatMapOnly) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  const LostRevisions lost = {{2, 500}, {701, 800}};
  store_.lost_revisions["room"] = lost;
  registry_ = Open();
  EXPECT_EQ(*registry_->LostRevisionsOf("room"), lost) << "while it is closed";
  ASSERT_TRUE(registry_->GetOpen("room").ok());
  EXPECT_EQ(*registry_->LostRevisionsOf("room"), lost);
  EXPECT_EQ(*registry_->LostRevisionsOf("hall"), LostRevisions());
  ASSERT_TRUE(registry_->Delete("room").ok());
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  EXPECT_EQ(*registry_->LostRevisionsOf("room"), LostRevisions());
}

TEST_F(MapRegistryTest, MissingMapsAreNotFound) {
  EXPECT_EQ(registry_->Get("room").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(registry_->GetOpen("room").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(registry_->DiskBytes("room").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(registry_->Delete("room").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(store_.num_loads, 0);
}

/// Creates a thing by an edit, which needs a writer and a commit.
void EditOnce(OpenMap& session) {
  std::promise<Status> done;
  session.Edit([](Map& map) -> Result<SubmapId> { return map.Create({.panoptic = Panoptic::kThing}).id(); },
               [&done](const Result<EditOutcome>& outcome) { done.set_value(outcome.status()); });
  ASSERT_TRUE(done.get_future().get().ok());
}

TEST_F(MapRegistryTest, OpenMapsShareFusionThreadsAndIdleOnesHaveNone) {
  OpenMapOptions options{.mapping = {.num_threads = 5}, .now_ns = [] { return std::int64_t{1}; }};
  const auto registry = std::move(MapRegistry::Open(store_, std::move(options))).value();
  constexpr std::size_t kMaps = 12, kThreadsAMap = 2;  // its writer, and what commits
  std::thread([] {}).join();                           // with the first of all, a sanitizer starts a thread of its own
  const auto before = testing::ThreadIds();
  for (std::size_t m = 0; m < kMaps; ++m) {
    const std::string name = "m" + std::to_string(m);
    ASSERT_TRUE(registry->Create(InfoOf(name)).ok());
    ASSERT_TRUE(registry->ViewOf(name).ok());
  }
  EXPECT_EQ(registry->OpenMaps().size(), kMaps);
  EXPECT_EQ(testing::NumThreadsSince(before), 0u);
  for (int round = 0; round < 2; ++round) {  // retired threads start again
    for (const auto& session : registry->OpenMaps()) EditOnce(*session);
    EXPECT_LE(testing::NumThreadsSince(before), kMaps * kThreadsAMap);
    EXPECT_TRUE(testing::Eventually([&] { return testing::NumThreadsSince(before) == 0; })) << "nobody writes any more";
  }
}

TEST_F(MapRegistryTest, ListsByNameWithoutLoading) {
  for (const char* name : {"hall", "attic", "cellar"}) ASSERT_TRUE(registry_->Create(InfoOf(name)).ok());
  for (const auto& registry : {std::move(registry_), Open()}) {  // the one that made them, and a later one
    const auto maps = registry->List("", 10).value();
    ASSERT_EQ(maps.size(), 3u);
    EXPECT_EQ(maps[0].info.name, "attic");
    EXPECT_EQ(maps[1].info.name, "cellar");
    EXPECT_EQ(maps[2].info.name, "hall");
    EXPECT_EQ(maps[2].num_submaps, 1);
    EXPECT_TRUE(registry->OpenMaps().empty());
  }
  EXPECT_EQ(store_.num_loads, 0);
}

TEST_F(MapRegistryTest, AStartReadsNoMaps) {
  for (const char* name : {"hall", "attic"}) ASSERT_TRUE(registry_->Create(InfoOf(name)).ok());
  store_.num_asked = store_.num_lists = 0;
  registry_ = Open();
  EXPECT_EQ(store_.num_lists, 0);
  EXPECT_EQ(store_.num_asked, 0);
  EXPECT_TRUE(registry_->MustLoad("hall"));
  EXPECT_TRUE(registry_->MustLoad("nowhere")) << "the store knows, and this must not wait for it";
  EXPECT_FALSE(registry_->MustLoad(""));
  EXPECT_FALSE(registry_->MustLoad("../etc"));
  EXPECT_EQ(store_.num_lists + store_.num_asked, 0);
}

TEST_F(MapRegistryTest, TheStoreIsAskedOnceAboutAClosedMap) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  registry_ = Open();
  store_.num_asked = 0;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(registry_->Get("room").ok());
  EXPECT_EQ(store_.num_asked, 1);
  ASSERT_TRUE(registry_->Delete("room").ok());
  EXPECT_EQ(registry_->Get("room").status().code(), StatusCode::kNotFound);
}

TEST_F(MapRegistryTest, ListsPagesByName) {
  for (const char* name : {"d", "b", "c", "a"}) ASSERT_TRUE(registry_->Create(InfoOf(name)).ok());
  const auto names = [this](const std::string& after, std::size_t max) {
    const std::vector<MapSummary> maps = registry_->List(after, max).value();
    std::string all;
    for (const MapSummary& map : maps) all += map.info.name;
    return all;
  };
  EXPECT_EQ(names("", 3), "abc");
  EXPECT_EQ(names("b", 1), "c");
  EXPECT_EQ(names("bb", 9), "cd") << "after a name that is not there";
  EXPECT_EQ(names("d", 9), "");
}

TEST_F(MapRegistryTest, MissingNamesLeaveNothingBehindAndGetSuggestions) {
  ASSERT_TRUE(registry_->Create(InfoOf("kitchen")).ok());
  for (const Status& status : {registry_->Get("kitchn").status(), registry_->GetOpen("kitchn").status(),
                               registry_->Delete("kitchn").status()}) {
    EXPECT_EQ(status.code(), StatusCode::kNotFound);
    EXPECT_NE(status.message().find("kitchen"), std::string::npos) << status.ToString();
  }
  EXPECT_TRUE(registry_->OpenMaps().empty());
  EXPECT_TRUE(registry_->Create(InfoOf("kitchn")).ok());
}

TEST_F(MapRegistryTest, SummariesFollowTheOpenMap) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  const auto session = registry_->GetOpen("room");
  ASSERT_TRUE(session.ok());
  EditOnce(**session);
  EXPECT_EQ(registry_->Get("room")->num_submaps, 2);
  EXPECT_EQ(registry_->List("", 10)->at(0).num_submaps, 2);
}

TEST_F(MapRegistryTest, AnUnusedMapIsClosedAndReopenedTransparently) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  EditOnce(**registry_->GetOpen("room"));
  const auto view = *registry_->ViewOf("room");
  const auto now = MapRegistry::Clock::now();
  registry_->CloseIdleMaps(now + std::chrono::seconds(1));
  EXPECT_EQ(registry_->OpenMaps().size(), 1u) << "used a moment ago";
  EXPECT_TRUE(testing::Eventually([&] {  // the edit was answered before its job had ended
    registry_->CloseIdleMaps(now + std::chrono::hours(1));
    return registry_->OpenMaps().empty();
  }));
  EXPECT_EQ(registry_->Get("room")->num_submaps, 2) << "its summary is of the state that was closed";
  EXPECT_EQ(view->snapshot().submaps().size(), 2u) << "who looks at it keeps what they see";
  const int num_loads = store_.num_loads;
  EXPECT_EQ((*registry_->ViewOf("room"))->snapshot().submaps().size(), 2u);
  EXPECT_EQ(store_.num_loads, num_loads + 1);
}

TEST_F(MapRegistryTest, CachesForQueriesAreDroppedWithTheMap) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  const auto ask = [this] {
    const auto view = *registry_->ViewOf("room");
    const DistanceQuery query(registry_->surfaces().Of(view->shared_snapshot()), {.max_distance_m = 9});
    return query.At({0, 0, 1}).distance_m;
  };
  const auto fuse = [this] {
    const auto session = *registry_->GetOpen("room");
    ASSERT_TRUE(Wait<FrameOutcome>([&](auto done) { session->Integrate(FrameOf(0), done); }).report.ok());
    ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  };
  fuse();
  const double distance_m = ask();
  EXPECT_LT(distance_m, 9);
  EXPECT_GT(registry_->surface_bytes(), 0u);
  ASSERT_TRUE(registry_->Delete("room").ok());
  EXPECT_EQ(registry_->surface_bytes(), 0u);
}

TEST_F(MapRegistryTest, AMapInUseStaysOpen) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  auto session = *registry_->GetOpen("room");
  registry_->CloseIdleMaps(MapRegistry::Clock::now() + std::chrono::hours(1));
  EXPECT_EQ(registry_->OpenMaps().size(), 1u);
  session = nullptr;
  registry_->CloseIdleMaps(MapRegistry::Clock::now() + std::chrono::hours(1));
  EXPECT_TRUE(registry_->OpenMaps().empty());
}

TEST_F(MapRegistryTest, ClosesIdleMapsByItself) {
  const auto registry =
      std::move(MapRegistry::Open(store_, {.mapping = {.num_threads = 1}}, {.idle_close_s = 0.02})).value();
  ASSERT_TRUE(registry->Create(InfoOf("room")).ok());
  ASSERT_TRUE(registry->ViewOf("room").ok());
  EXPECT_TRUE(testing::Eventually([&] { return registry->OpenMaps().empty(); }));
}

TEST_F(MapRegistryTest, AMapIsLoadedOnceForConcurrentCallers) {
  ASSERT_TRUE(registry_->Create(InfoOf("slow")).ok());
  std::vector<std::future<std::shared_ptr<OpenMap>>> sessions;
  const auto open = [this] { return registry_->GetOpen("slow").value(); };
  for (int i = 0; i < 4; ++i) sessions.push_back(std::async(std::launch::async, open));
  store_.is_loading_slow.get_future().wait();
  store_.may_go_on.set_value();
  const auto first = sessions[0].get();
  for (std::size_t i = 1; i < sessions.size(); ++i) EXPECT_EQ(sessions[i].get(), first);
  EXPECT_EQ(store_.num_loads, 1);
  EXPECT_EQ(registry_->OpenMaps().size(), 1u);
}

TEST_F(MapRegistryTest, LoadingOneMapDoesNotDelayAnother) {
  ASSERT_TRUE(registry_->Create(InfoOf("slow")).ok());
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  auto slow = std::async(std::launch::async, [this] { return registry_->GetOpen("slow").status(); });
  store_.is_loading_slow.get_future().wait();
  EXPECT_TRUE(registry_->GetOpen("room").ok());
  EXPECT_TRUE(registry_->Get("slow").ok()) << "its summary needs no loading";
  EXPECT_EQ(registry_->List("", 10)->size(), 2u);
  EXPECT_TRUE(registry_->Create(InfoOf("hall")).ok());
  EXPECT_TRUE(registry_->Delete("hall").ok());
  store_.may_go_on.set_value();
  EXPECT_TRUE(slow.get().ok());
}

TEST_F(MapRegistryTest, AMapDeletedDuringItsLoadIsGoneAfterwards) {
  ASSERT_TRUE(registry_->Create(InfoOf("slow")).ok());
  auto open = std::async(std::launch::async, [this] { return registry_->GetOpen("slow").status(); });
  store_.is_loading_slow.get_future().wait();
  auto deleted = std::async(std::launch::async, [this] { return registry_->Delete("slow").status(); });
  store_.may_go_on.set_value();
  EXPECT_TRUE(open.get().ok()) << "it was there when it was asked for";
  EXPECT_TRUE(deleted.get().ok());
  EXPECT_EQ(registry_->GetOpen("slow").status().code(), StatusCode::kNotFound);
  EXPECT_TRUE(registry_->OpenMaps().empty());
}

TEST_F(MapRegistryTest, AFailedLoadIsTriedAgain) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  store_.refusal = Unavailable("the disk is away");
  EXPECT_EQ(registry_->GetOpen("room").status().code(), StatusCode::kUnavailable);
  EXPECT_TRUE(registry_->Get("room").ok());
  store_.refusal = Status::Ok();
  EXPECT_TRUE(registry_->GetOpen("room").ok());
}

TEST_F(MapRegistryTest, DeletingReturnsTheLastRevisionAndAFailureKeepsTheMap) {
  for (const bool is_open : {false, true}) {
    const auto made = registry_->Create(InfoOf("room"));
    ASSERT_TRUE(made.ok());
    if (is_open) {
      ASSERT_TRUE(registry_->GetOpen("room").ok());
    }
    store_.refusal = Unavailable("the disk is away");
    EXPECT_EQ(registry_->Delete("room").status().code(), StatusCode::kUnavailable);
    store_.refusal = Status::Ok();
    EXPECT_TRUE(registry_->Get("room").ok());
    const auto deleted = registry_->Delete("room");
    ASSERT_TRUE(deleted.ok()) << deleted.status().message();
    EXPECT_EQ(*deleted, made->info.revision);
    EXPECT_EQ(store_.GetMap("room").status().code(), StatusCode::kNotFound);
    EXPECT_EQ(registry_->Get("room").status().code(), StatusCode::kNotFound);
  }
}

TEST_F(MapRegistryTest, AfterAShutdownNoMapIsOpened) {
  ASSERT_TRUE(registry_->Create(InfoOf("room")).ok());
  ASSERT_TRUE(registry_->Create(InfoOf("hall")).ok());
  ASSERT_TRUE(registry_->GetOpen("room").ok());
  EXPECT_TRUE(registry_->Shutdown().ok());
  EXPECT_TRUE(registry_->GetOpen("room").ok()) << "what is open can still be read";
  EXPECT_EQ(registry_->GetOpen("hall").status().code(), StatusCode::kUnavailable);
  EXPECT_TRUE(registry_->Shutdown().ok()) << "twice does no harm";
}

}  // namespace
}  // namespace dhpmap
