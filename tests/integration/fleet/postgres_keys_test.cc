// SPDX-License-Identifier: BSD-3-Clause
// Two servers on one PostgreSQL database that has their keys.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "server/auth/keys/key_book.h"
#include "server/auth/keys/key_table.h"
#include "server/auth/map_owners_table.h"
#include "storage/auth_tables.h"
#include "storage/postgres_store.h"
#include "tests/integration/auth/locked_server.h"
#include "tests/integration/fleet/fleet_of_two.h"
#include "tests/support/postgres_cluster.h"

namespace dhpmap::testing {
namespace {

/// Its clock of leases stands still, so maps stay where they are; it looks at the keys when a test says so.
struct LockedProcess {
  LockedProcess(const std::string& schema, std::shared_ptr<AuthTables> auth_tables, const auth::CallLimits& limits)
      : tables(std::move(auth_tables)),
        store(OpenPostgresStore(
                  PostgresCluster::Get()->Url(),
                  {.schema = schema, .fleet = {.version = "1.0", .time_ns = [] { return std::int64_t{1} << 40; }}})
                  .value()),
        audit(std::make_shared<auth::AuditTable>(
            tables, auth::AuditTableOptions{.server = store->fleet()->Me().id, .flush_s = 0})),
        gate(MakeGate(limits)),
        server(*store, {}, {.gate = gate, .fleet = store->fleet()}) {
    store->fleet()->Announce("127.0.0.1:" + std::to_string(server.grpc().port()));
  }
  std::shared_ptr<auth::Gate> MakeGate(const auth::CallLimits& limits) {
    auto made = auth::Gate::WithKeys({.keys = std::make_shared<auth::KeyTableSource>(tables),
                                      .owners = std::make_shared<auth::MapOwnersTable>(tables),
                                      .audit_table = audit,
                                      .limits = limits,
                                      .look_s = 0});
    EXPECT_OK(made);
    (*made)->TakeFleetKey(*auth::FleetKey::Make(kFleetSecret, "a test"));
    return *made;
  }
  template <typename Stub, typename Request, typename Response>
  Answer<Response> Call(const std::string& key,
                        grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                        const std::type_identity_t<Request>& request = Request()) {
    grpc::ClientContext context;
    LockedServer::Show(key, context);
    Response response;
    Stub stub(server.channel());
    grpc::Status status = (stub.*method)(&context, request, &response);
    return {std::move(status), std::move(response)};
  }

  const std::shared_ptr<AuthTables> tables;
  std::unique_ptr<MapStore> store;
  const std::shared_ptr<auth::AuditTable> audit;
  const std::shared_ptr<auth::Gate> gate;
  TestServer server;
};

class PostgresKeys : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    const std::string schema = PostgresCluster::Get()->NewSchema();
    tables = OpenAuthTables(PostgresCluster::Get()->Url(), {.schema = schema}).value();
    admin = Make({.name = "ann", .role = auth::Role::kAdmin});
    for (auto* process : {&a, &b})
      *process = std::make_unique<LockedProcess>(schema, tables, auth::CallLimits{.maps = 2});
  }
  std::string Make(const auth::NewKey& key) {
    std::string text;
    EXPECT_OK(auth::ChangeKeyTable(*tables, [&](std::vector<auth::KeyRecord>& records) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auth::ShownKey shown, AddKey(key, 0, auth::SystemRandomness(), records));
      text = shown.text;
      return Status::Ok();
    }));
    return text;
  }
  void Revoke(const std::string& name) {
    EXPECT_OK(auth::ChangeKeyTable(
        *tables, [&](std::vector<auth::KeyRecord>& records) { return auth::RevokeKeys(name, 0, records).status(); }));
  }
  void LookAtKeys() const {
    for (const auto* process : {&a, &b}) (*process)->gate->Look();
  }

  std::shared_ptr<AuthTables> tables;
  std::string admin;
  std::unique_ptr<LockedProcess> a, b;
};

TEST_F(PostgresKeys, ANewKeyIsAcceptedAndARevokedKeyRefusedByBothServers) {
  const std::string vic = Make({.name = "vic"});
  LookAtKeys();
  for (const auto* asked : {&a, &b}) EXPECT_OK((*asked)->Call(vic, &MapStub::ListMaps));
  Revoke("vic");
  LookAtKeys();
  for (const auto* asked : {&a, &b}) {
    EXPECT_EQ((*asked)->Call(vic, &MapStub::ListMaps).code(), grpc::UNAUTHENTICATED);
  }
  EXPECT_OK(b->Call(admin, &MapStub::ListMaps)) << "other keys stay";
}

/// A watch, which the asked server answers itself, and a stream of queries, which the owner of the map answers.
struct LiveStreamsOf {
  LiveStreamsOf(LockedProcess& asked, const std::string& key) {
    for (grpc::ClientContext* context : {&watching, &asking}) LockedServer::Show(key, *context);
    v1::WatchMapRequest watch;
    watch.set_map("maps/room");
    watch.set_start_revision(1);
    changes = asked.server.watches->WatchMap(&watching, watch);
    EXPECT_TRUE(changes->Read(&change));
    answers = asked.server.queries->StreamQueries(&asking);
    v1::StreamQueriesRequest query;
    query.mutable_query_relations()->set_map("maps/room");
    EXPECT_TRUE(answers->Write(query) && answers->Read(&answer));
  }
  /// Waits until both end.
  std::pair<grpc::StatusCode, grpc::StatusCode> End() {
    while (changes->Read(&change)) {
    }
    while (answers->Read(&answer)) {
    }
    const grpc::Status watched = changes->Finish(), asked = answers->Finish();
    return {watched.error_code(), asked.error_code()};
  }

  grpc::ClientContext watching, asking;
  std::unique_ptr<grpc::ClientReader<v1::WatchMapResponse>> changes;
  std::unique_ptr<grpc::ClientReaderWriter<v1::StreamQueriesRequest, v1::StreamQueriesResponse>> answers;
  v1::WatchMapResponse change;
  v1::StreamQueriesResponse answer;
};

TEST_F(PostgresKeys, StreamsOfARevokedKeyEndAtTheOwnerAndThroughTheOtherServer) {
  ASSERT_OK(a->Call(admin, &MapStub::CreateMap, CreateRequest("room")));
  const std::string vic = Make({.name = "vic"});
  LookAtKeys();
  LiveStreamsOf at_owner(*a, vic), through_other(*b, vic);
  Revoke("vic");
  LookAtKeys();
  const std::pair both(grpc::UNAUTHENTICATED, grpc::UNAUTHENTICATED);
  EXPECT_EQ(at_owner.End(), both);
  EXPECT_EQ(through_other.End(), both) << "also the stream that its owner has ended";
}

TEST_F(PostgresKeys, AMapThatWasMadeThroughOneServerCountsAtBoth) {
  const std::string spot = Make({.name = "spot", .role = auth::Role::kRobot});
  LookAtKeys();
  const auto create = [&](LockedProcess& asked, const char* id) {
    return asked.Call(spot, &MapStub::CreateMap, CreateRequest(id));
  };
  ASSERT_OK(create(*a, "first"));
  ASSERT_OK(create(*b, "second"));
  EXPECT_EQ(create(*a, "third").reason(), "OUT_OF_QUOTA");
  EXPECT_EQ(create(*b, "third").reason(), "OUT_OF_QUOTA");
  ASSERT_OK(b->Call(admin, &MapStub::DeleteMap, About<v1::DeleteMapRequest>("maps/first")));
  EXPECT_OK(create(*b, "third"));
}

TEST_F(PostgresKeys, TheAuditLogHasTheCallsOfAllServersAndNoKeys) {
  const std::string vic = Make({.name = "vic"});
  LookAtKeys();
  ASSERT_OK(a->Call(admin, &MapStub::CreateMap, CreateRequest("room")));
  EXPECT_EQ(b->Call(vic, &MapStub::DeleteMap, About<v1::DeleteMapRequest>("maps/room")).code(),
            grpc::PERMISSION_DENIED);
  ASSERT_OK(b->Call(admin, &MapStub::DeleteMap, About<v1::DeleteMapRequest>("maps/room"))) << "by way of the owner";
  for (const auto* process : {&a, &b}) ASSERT_OK((*process)->audit->Flush());
  const std::int64_t at_a = a->store->fleet()->Me().id, at_b = b->store->fleet()->Me().id;
  std::multiset<std::string> seen;
  const auto rows = tables->ListAudit({}).value();
  for (const AuditRow& row : rows) {
    const std::string where = row.server == at_a ? "a: " : row.server == at_b ? "b: " : "?: ";
    seen.insert(where + row.principal + " " + row.rpc + " " + row.map + " " + row.decision);
    for (const std::string& key : {admin, vic}) EXPECT_EQ((row.rpc + row.map).find(key), std::string::npos);
  }
  EXPECT_EQ(seen, (std::multiset<std::string>{"a: ann /dhpmap.v1.MapService/CreateMap room allowed",
                                              "a: ann /dhpmap.v1.MapService/DeleteMap room allowed",
                                              "b: vic /dhpmap.v1.MapService/DeleteMap  ROLE_NOT_ALLOWED"}));
}

}  // namespace
}  // namespace dhpmap::testing
