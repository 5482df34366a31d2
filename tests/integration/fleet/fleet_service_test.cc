// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "dhpmap/v1/fleet_service.grpc.pb.h"
#include "tests/integration/fleet/fleet_of_two.h"
#include "tests/support/lone_fleet.h"

namespace dhpmap::testing {
namespace {

using FleetStub = v1::FleetService::Stub;

v1::MoveMapRequest MoveTo(const std::string& server) {
  v1::MoveMapRequest request;
  request.set_map("maps/room");
  request.set_server(server);
  return request;
}

TEST_F(FleetOfTwo, ListsItsServers) {
  const auto fleet = other.server.Call(&FleetStub::GetFleet).value();
  ASSERT_EQ(fleet.servers_size(), 2);
  EXPECT_EQ(fleet.servers(0).name(), "servers/1");
  EXPECT_EQ(fleet.servers(0).address(), owner.address());
  EXPECT_EQ(fleet.servers(0).num_maps(), 1);
  EXPECT_FALSE(fleet.servers(0).answering());
  EXPECT_TRUE(fleet.servers(1).answering());
  EXPECT_TRUE(fleet.servers(1).alive());
}

TEST_F(FleetOfTwo, ListsOwnersInPages) {
  for (const char* map : {"a", "b", "c", "d"}) room->AddMap(map, 0);
  v1::ListMapOwnersRequest request;
  request.set_page_size(2);
  std::string maps;
  int num_pages = 0;
  do {
    const auto page = other.server.Call(&FleetStub::ListMapOwners, request).value();
    for (const auto& owned : page.owners()) maps += owned.map() + ":" + owned.server() + " ";
    request.set_page_token(page.next_page_token());
    ++num_pages;
  } while (!request.page_token().empty());
  EXPECT_EQ(maps, "maps/a: maps/b: maps/c: maps/d: maps/room:servers/1 ");
  EXPECT_EQ(num_pages, 3);
}

TEST_F(FleetOfTwo, RefusesToMoveAMapToAMissingOrDeadServer) {
  EXPECT_EQ(owner.server.Call(&FleetStub::MoveMap, MoveTo("servers/99")).code(), grpc::INVALID_ARGUMENT);
  room->SetAlive(other.fleet.me(), false);
  EXPECT_EQ(owner.server.Call(&FleetStub::MoveMap, MoveTo(other.address())).code(), grpc::FAILED_PRECONDITION);
  EXPECT_EQ(owner.server.Call(&FleetStub::ListMapOwners)->owners(0).server(), "servers/1") << "nothing has moved";
}

TEST_F(FleetOfTwo, AMoveToThePresentOwnerChangesNothing) {
  const auto moved = other.server.Call(&FleetStub::MoveMap, MoveTo("servers/1")).value();
  EXPECT_EQ(moved.owner().server(), "servers/1");
  EXPECT_EQ(moved.owner().epoch(), 1);
  EXPECT_EQ(num_relayed, 1);
}

/// A fleet in the middle of an upgrade, with another server that may be older.
class UpgradingFleet final : public LoneFleet {
 public:
  Result<std::vector<FleetServer>> ListServers() override {
    return std::vector<FleetServer>{{.id = 1,
                                     .is_alive = true,
                                     .is_me = true,
                                     .newest_schema = 6,
                                     .beat_age_s = 0.25,
                                     .following = FollowingState{.num_copies = 3, .behind_s = 1.5}},
                                    {.id = 2, .is_alive = true, .newest_schema = 4}};
  }
  [[nodiscard]] FleetSchema Schema() const override { return {.in_force = in_force, .newest = 6}; }
  Result<FleetSchema> FinishUpgrade() override {
    if (has_older) return FailedPrecondition("old:1 does not know schema 6");
    in_force = 6;
    return Schema();
  }
  bool has_older = true;
  std::int64_t in_force = 4;
};

TEST(FleetService, ReportsAnUpgradeAndFinishesIt) {
  UpgradingFleet fleet;
  const auto store = MakeMemoryStore();
  TestServer server(*store, {}, {.fleet = &fleet});
  const auto before = server.Call(&FleetStub::GetFleet).value();
  EXPECT_EQ(before.schema().in_force(), 4);
  EXPECT_EQ(before.schema().newest(), 6);
  EXPECT_EQ(before.servers(0).newest_schema(), 6);
  EXPECT_DOUBLE_EQ(before.servers(0).beat_age_s(), 0.25);
  EXPECT_EQ(before.servers(0).num_copies(), 3);
  EXPECT_DOUBLE_EQ(before.servers(0).copies_behind_s(), 1.5);
  EXPECT_FALSE(before.servers(1).has_beat_age_s() || before.servers(1).has_num_copies());
  EXPECT_EQ(server.Call(&FleetStub::FinishUpgrade).code(), grpc::FAILED_PRECONDITION);
  fleet.has_older = false;
  EXPECT_EQ(server.Call(&FleetStub::FinishUpgrade)->schema().in_force(), 6);
  EXPECT_EQ(server.Call(&FleetStub::GetFleet)->schema().in_force(), 6);
}

TEST(FleetService, IsUnavailableOnADatabaseFile) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  for (const std::string& reason :
       {server.Call(&FleetStub::GetFleet).reason(), server.Call(&FleetStub::ListMapOwners).reason(),
        server.Call(&FleetStub::MoveMap, MoveTo("1")).reason(), server.Call(&FleetStub::FinishUpgrade).reason()}) {
    EXPECT_EQ(reason, "NO_FLEET");
  }
}

}  // namespace
}  // namespace dhpmap::testing
