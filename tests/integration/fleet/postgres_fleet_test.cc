// SPDX-License-Identifier: BSD-3-Clause
// Two servers on one PostgreSQL database. Each answers for all maps, and maps move while robots feed them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dhpmap/client.h"
#include "dhpmap/v1/fleet_service.grpc.pb.h"
#include "storage/postgres_store.h"
#include "tests/integration/test_server.h"
#include "tests/support/postgres_cluster.h"

namespace dhpmap::testing {
namespace {

using FleetStub = v1::FleetService::Stub;

/// A server process. Its heartbeats use a clock that stands still: no server ever counts as dead, and maps move only on
/// request.
struct Process {
  explicit Process(const std::string& schema)
      : store(OpenPostgresStore(
                  PostgresCluster::Get()->Url(),
                  {.schema = schema, .fleet = {.version = "1.0", .time_ns = [] { return std::int64_t{1} << 40; }}})
                  .value()),
        server(*store, {}, {.fleet = store->fleet()}) {
    store->fleet()->Announce(address());
  }
  [[nodiscard]] std::string address() { return "127.0.0.1:" + std::to_string(server.grpc().port()); }
  [[nodiscard]] std::string name() const { return "servers/" + std::to_string(store->fleet()->Me().id); }

  std::unique_ptr<MapStore> store;
  TestServer server;
};

/// Compares up to the rounding of stored distances and weights.
void ExpectSame(v1::PackedPointResults a, v1::PackedPointResults b) {
  ASSERT_EQ(a.tsdf_m_size(), b.tsdf_m_size());
  constexpr double kStep_m = 1e-4, kStepFraction = 0.01;
  for (int i = 0; i < a.tsdf_m_size(); ++i) {
    EXPECT_EQ(std::isnan(a.tsdf_m(i)), std::isnan(b.tsdf_m(i))) << i;
    if (!std::isnan(a.tsdf_m(i))) {
      EXPECT_NEAR(a.tsdf_m(i), b.tsdf_m(i), kStep_m) << i;
    }
    EXPECT_NEAR(a.weight(i), b.weight(i), kStepFraction * b.weight(i)) << i;
  }
  for (v1::PackedPointResults* of : {&a, &b}) {
    of->clear_tsdf_m();
    of->clear_weight();
  }
  EXPECT_TRUE(a.SerializeAsString() == b.SerializeAsString());
}

class PostgresFleet : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    const std::string schema = PostgresCluster::Get()->NewSchema();
    a = std::make_unique<Process>(schema);
    b = std::make_unique<Process>(schema);
    ASSERT_OK(a->server.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(a->server, "room", 0, 3).status);
    ASSERT_OK(a->server.Call(&MappingStub::FinishMapping, "maps/room"));  // publishes everything
  }
  static Answer<v1::MoveMapResponse> Move(Process& asked, Process& to) {
    v1::MoveMapRequest request;
    request.set_map("maps/room");
    request.set_server(to.address());
    return asked.server.Call(&FleetStub::MoveMap, request);
  }
  static std::string OwnerOfRoom(Process& asked) {
    const auto owners = asked.server.Call(&FleetStub::ListMapOwners).value();
    return owners.owners_size() == 1 ? owners.owners(0).server() : "";
  }

  std::unique_ptr<Process> a, b;
};

TEST_F(PostgresFleet, EitherServerAnswersAndTakesFrames) {
  const auto here = a->server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
  const auto there = b->server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
  EXPECT_TRUE(here.SerializeAsString() == there.SerializeAsString());
  EXPECT_OK(Feed(b->server, "room", 3, 6).status);
  EXPECT_EQ(OwnerOfRoom(*b), a->name()) << "who takes frames in passes them on";
  EXPECT_EQ(a->server.Call(&MapStub::GetMap, "maps/room").value().map().num_frames(), 6);
}

TEST_F(PostgresFleet, AMovedMapAnswersAsBefore) {
  const auto before = b->server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
  const auto moved = Move(*b, *b);  // the call is relayed to the owner
  ASSERT_OK(moved);
  EXPECT_EQ(moved->owner().server(), b->name());
  EXPECT_GT(moved->owner().epoch(), 1);
  EXPECT_EQ(OwnerOfRoom(*a), b->name());
  for (Process* asked : {a.get(), b.get()}) {
    const auto after = asked->server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
    ASSERT_EQ(after.results_size(), before.results_size());
    ExpectSame(after.packed(), before.packed());
  }
  ASSERT_OK(Move(*a, *a));
  EXPECT_EQ(OwnerOfRoom(*b), a->name());
}

TEST_F(PostgresFleet, AFeedFollowsItsMap) {
  auto connected = client::Client::Connect(b->address(), {});
  ASSERT_OK(connected);
  const auto map = connected->OpenMap("room");
  ASSERT_OK(map);
  for (Process* to : {b.get(), a.get(), b.get()}) {
    const auto fed = Feed(a->server, "room", 3, 5);
    EXPECT_OK(fed.status);
    ASSERT_OK(Move(*a, *to));
    const auto info = map->Info();
    ASSERT_OK(info);
  }
  EXPECT_EQ(map->Info()->num_frames, 3 + 3 * 2);
}

TEST_F(PostgresFleet, AStreamRefusesAMessageAboutAMapOfAnotherOwnerAndGoesOn) {
  ASSERT_OK(b->server.Call(&MapStub::CreateMap, CreateRequest("hall")));
  for (Process* asked : {a.get(), b.get()}) {  // by its own handler, and through a relay
    grpc::ClientContext context;
    const auto stream = asked->server.queries->StreamQueries(&context);
    const auto ask = [&](const std::string& map) {
      v1::StreamQueriesRequest request;
      *request.mutable_query_points() = TestQuery(map);
      v1::StreamQueriesResponse response;
      EXPECT_TRUE(stream->Write(request) && stream->Read(&response));
      return response;
    };
    EXPECT_FALSE(ask("room").has_error());
    const v1::StreamQueriesResponse refused = ask("hall");
    EXPECT_EQ(refused.error().code(), grpc::UNAVAILABLE);
    EXPECT_EQ(ReasonOf(refused.error()), "NOT_OWNER");
    EXPECT_EQ(DetailOf<google::rpc::ErrorInfo>(refused.error()).metadata().at("owner"), b->address());
    EXPECT_FALSE(ask("room").has_error()) << "the stream goes on";
    stream->WritesDone();
    EXPECT_OK(stream->Finish());
  }
  EXPECT_EQ(a->server.Call(&FleetStub::ListMapOwners).value().owners_size(), 2);
}

TEST_F(PostgresFleet, AnEditWithAnIdIsMadeOnceWhicheverServerReceivesIt) {
  v1::UpdateMapRequest rename;
  rename.mutable_map()->set_name("maps/room");
  rename.mutable_map()->set_display_name("Room");
  rename.mutable_update_mask()->add_paths("display_name");
  rename.set_request_id("6f1c3a0e-2f8b-4d6e-9a3b-0c1d2e3f4a5b");
  const auto first = b->server.Call(&MapStub::UpdateMap, rename);
  ASSERT_OK(first);
  ASSERT_OK(Move(*a, *b));
  const auto again = a->server.Call(&MapStub::UpdateMap, rename);
  ASSERT_OK(again);
  EXPECT_EQ(again->revision(), first->revision());
}

}  // namespace
}  // namespace dhpmap::testing
