// SPDX-License-Identifier: BSD-3-Clause
// Maps that another process on the same store gets: handed over, or taken.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/app/maps/map_registry.h"
#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"
#include "tests/support/lone_fleet.h"
#include "tests/support/wrapped_store.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

/// Two servers; this is server 1. Records maps that are given up; the test reports losses.
class NotedFleet final : public testing::LoneFleet {
 public:
  [[nodiscard]] FleetServer Me() const override { return servers.front(); }
  Result<std::vector<FleetServer>> ListServers() override { return servers; }
  Status GiveUp(const std::string& map, std::int64_t to_server) override {
    before_giving_up(map);
    given.emplace_back(map, to_server);
    return Status::Ok();
  }
  void OnLost(std::function<void(const std::string& map)> to_call) override { on_lost = std::move(to_call); }
  void StopTaking() override { takes = false; }

  std::vector<FleetServer> servers = {
      {.id = 1, .address = "one:1", .is_alive = true, .is_me = true},
      {.id = 2, .address = "two:2", .is_alive = true, .num_maps = 5},
      {.id = 3, .address = "three:3", .is_alive = true, .num_maps = 4},
      {.id = 4, .address = "four:4", .is_alive = false},
      {.id = 5, .address = "five:5", .is_alive = true, .is_draining = true},
  };
  std::vector<std::pair<std::string, std::int64_t>> given;
  std::function<void(const std::string& map)> before_giving_up = [](const std::string&) {};
  std::function<void(const std::string& map)> on_lost;
  bool takes = true;
};

/// A memory store that several processes seem to share.
class SharedStore final : public testing::WrappedStore {
 public:
  [[nodiscard]] Fleet* fleet() override { return &noted; }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    if (!refusal.ok()) return refusal;
    return inner().Commit(before, after, durability);
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return refusal.ok() ? inner().CommitEdit(before, after, edit) : refusal;
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    ++num_loads;
    return inner().LoadMap(name);
  }
  Status Reserve(const std::string& name, const NumberMarks& marks) override {
    return refusal.ok() ? inner().Reserve(name, marks) : refusal;
  }

  NotedFleet noted;
  Status refusal;  ///< of what is written
  std::atomic<int> num_loads = 0;
};

class HandingOverTest : public ::testing::Test {
 protected:
  void SetUp() override {
    OpenMapOptions options;
    options.mapping.num_threads = 2;
    options.commit.frames = 1000;  // nothing is stored by itself
    options.commit.delay_s = 1000;
    ASSERT_OK_AND_ASSIGN(registry_, MapRegistry::Open(store_, std::move(options)));
    ASSERT_OK(registry_->Create(RoomInfo("room")));
    ASSERT_OK_AND_ASSIGN(room_, registry_->GetOpen("room"));
    ASSERT_OK_AND_ASSIGN(feed_, room_->BeginFeed({.session = "robot",
                                                  .on_evicted = [this](const Status& why) { told_.set_value(why); }}));
  }
  FrameOutcome Integrate(int i) {
    return Wait<FrameOutcome>([&](auto done) { room_->Integrate(feed_, i, FrameOf(i), done); });
  }
  static std::string OwnerIn(const Status& status) {
    EXPECT_EQ(status.reason(), Reason("NOT_OWNER")) << status.ToString();
    return status.metadata().empty() ? "" : status.metadata().front().second;
  }

  SharedStore store_;
  std::unique_ptr<MapRegistry> registry_;
  std::shared_ptr<OpenMap> room_;
  std::shared_ptr<Feed> feed_;
  std::promise<Status> told_;
};

TEST_F(HandingOverTest, AMapIsStoredAndClosedBeforeItIsHandedOver) {
  ASSERT_OK(Integrate(1).report);
  std::int64_t num_frames = -1;
  store_.noted.before_giving_up = [&](const std::string&) { num_frames = store_.GetMap("room")->info.num_frames; };
  ASSERT_OK(registry_->HandOver("room", 2));
  EXPECT_EQ(num_frames, 1) << "what was fused is stored";
  EXPECT_EQ(store_.noted.given, (std::vector<std::pair<std::string, std::int64_t>>{{"room", 2}}));
  EXPECT_EQ(OwnerIn(told_.get_future().get()), "two:2") << "its streams are told where to go on";
  EXPECT_EQ(OwnerIn(Integrate(2).report.status()), "two:2");
  const auto edited = Wait<Status>([&](auto done) {
    room_->Edit([](Map&) -> Result<SubmapId> { return SubmapId(); },
                [done](const Result<EditOutcome>& outcome) { done(outcome.status()); });
  });
  EXPECT_EQ(OwnerIn(edited), "two:2");
  const int loads = store_.num_loads;
  ASSERT_OK_AND_ASSIGN(const auto again, registry_->GetOpen("room"));
  EXPECT_NE(again, room_) << "who asks next asks the store whose it is";
  EXPECT_EQ(store_.num_loads, loads + 1);
  EXPECT_EQ(again->View()->snapshot().info().num_frames, 1);
}

TEST_F(HandingOverTest, AServerThatTakesNoMapsGetsNone) {
  EXPECT_EQ(registry_->HandOver("room", 4).code(), StatusCode::kFailedPrecondition) << "it is dead";
  EXPECT_EQ(registry_->HandOver("room", 5).code(), StatusCode::kFailedPrecondition) << "it drains";
  EXPECT_EQ(registry_->HandOver("room", 6).code(), StatusCode::kNotFound);
  EXPECT_OK(registry_->HandOver("room", 1)) << "has it already";
  EXPECT_TRUE(store_.noted.given.empty());
  EXPECT_OK(Integrate(1).report);
}

TEST_F(HandingOverTest, AtShutdownMapsAreDistributedEvenly) {
  for (const char* name : {"attic", "barn"}) {
    ASSERT_OK(registry_->Create(RoomInfo(name)));
    ASSERT_OK(registry_->GetOpen(name));
  }
  ASSERT_OK(registry_->HandAllOver());
  EXPECT_FALSE(store_.noted.takes);
  std::map<std::int64_t, int> num_given;
  for (const auto& [map, to] : store_.noted.given) ++num_given[to];
  EXPECT_EQ(num_given, (std::map<std::int64_t, int>{{2, 1}, {3, 2}})) << "one had 5 maps, the other 4";
  EXPECT_TRUE(registry_->OpenMaps().empty());
  EXPECT_OK(registry_->Shutdown());
}

TEST_F(HandingOverTest, AMapTakenByAnotherServerIsDroppedAndItsStreamsEnd) {
  ASSERT_OK(Integrate(1).report);
  store_.refusal = Unavailable("taken").WithReason("NOT_OWNER").WithMetadata("owner", "two:2");
  const auto flushed = Wait<Status>([&](auto done) { room_->Flush(done); });
  EXPECT_EQ(OwnerIn(flushed), "two:2");
  EXPECT_EQ(OwnerIn(Integrate(2).report.status()), "two:2") << "though it is still open";
  store_.noted.on_lost("room");
  EXPECT_EQ(OwnerIn(told_.get_future().get()), "two:2");
  EXPECT_TRUE(testing::Eventually([&] { return registry_->OpenMaps().empty(); }));
  store_.refusal = {};
  ASSERT_OK_AND_ASSIGN(const auto again, registry_->GetOpen("room"));
  EXPECT_NE(again, room_);
  EXPECT_EQ(again->View()->snapshot().info().num_frames, 0) << "as it is stored";
}

TEST_F(HandingOverTest, ALostMapIsLoadedAgainEvenBeforeItWasClosed) {
  store_.noted.on_lost("room");
  ASSERT_OK_AND_ASSIGN(const auto again, registry_->GetOpen("room"));
  EXPECT_NE(again, room_);
  EXPECT_EQ(OwnerIn(Integrate(1).report.status()), "") << "the old one is closed";
}

TEST_F(HandingOverTest, ALostMapIsNoErrorAtShutdown) {
  ASSERT_OK(Integrate(1).report);
  store_.refusal = Unavailable("taken").WithReason("NOT_OWNER");
  EXPECT_OK(registry_->Shutdown());
  EXPECT_FALSE(store_.noted.on_lost) << "nobody is told any more";
}

TEST_F(HandingOverTest, AnIdleMapGoesToTheFirstServerThatAsks) {
  room_->EndFeed(feed_);
  room_.reset();
  registry_->CloseIdleMaps(MapRegistry::Clock::now() + std::chrono::hours(1));
  EXPECT_EQ(store_.noted.given, (std::vector<std::pair<std::string, std::int64_t>>{{"room", 0}}));
}

TEST(HandingOverAloneTest, ASingleServerCannotHandMapsOver) {
  const auto store = MakeMemoryStore();
  ASSERT_OK_AND_ASSIGN(const auto registry, MapRegistry::Open(*store, {}));
  EXPECT_EQ(registry->HandOver("room", 0).reason(), Reason("NO_FLEET"));
  EXPECT_OK(registry->HandAllOver());
}

}  // namespace
}  // namespace dhpmap
