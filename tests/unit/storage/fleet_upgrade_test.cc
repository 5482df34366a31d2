// SPDX-License-Identifier: BSD-3-Clause
// Servers of two versions on one PostgreSQL database, and when its schema changes.
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "storage/postgres/fleet/upgrade.h"
#include "storage/postgres/schema.h"
#include "tests/unit/storage/fleet_fixture.h"

namespace dhpmap {
namespace {

using testing::PostgresCluster;

constexpr char kTask[] = "test";
const std::string kRowOfLastRelease =
    "INSERT INTO servers (server, beat, address, version, is_draining) VALUES (77, 1, 'last:1', '0.9', 0) ON CONFLICT "
    "(server) DO UPDATE SET beat = servers.beat + 1, address = excluded.address, version = excluded.version, "
    "is_draining = excluded.is_draining";

class FleetUpgradeTest : public testing::FleetOfStores {
 protected:
  void SetUp() override {
    FleetOfStores::SetUp();
    today_ = postgres::ReleasedSteps().back().number;
  }
  /// A store of the next version, whose schema has one step more. While it starts, `beating` do.
  PostgresStoreOptions Next(const std::string& address, std::vector<Server*> beating = {}) {
    PostgresStoreOptions options = OptionsOf(address);
    options.later_steps = {"CREATE TABLE of_the_next_version (x bigint)"};
    options.fleet.version = "2.0";
    options.fleet.await_beats = [beating] {
      for (const Server* server : beating) EXPECT_OK(server->fleet().Beat());
    };
    return options;
  }
  postgres::Connection Connect() {
    auto opened = postgres::Connection::Open({.url = PostgresCluster::Get()->Url(), .schema = schema_});
    EXPECT_OK(opened);
    return std::move(opened).value();
  }
  /// The database as the last release makes it.
  void MakeDatabaseOfLastRelease() {
    postgres::Connection connection = Connect();
    ASSERT_OK(postgres::ReadSchema(connection, schema_));
    for (const postgres::SchemaStep& step : postgres::ReleasedSteps()) {
      if (step.number > postgres::kOldestSchema) continue;
      ASSERT_OK(connection.Execute(step.sql, kTask));
      ASSERT_OK(connection.Execute("INSERT INTO schema_steps VALUES (" + std::to_string(step.number) + ")", kTask));
    }
  }
  std::int64_t SchemaOfDatabase() {
    postgres::Connection connection = Connect();
    const auto schema = postgres::ReadSchema(connection, schema_);
    EXPECT_OK(schema);
    return schema.ok() ? *schema : -1;
  }
  static std::int64_t InForce(const Server& server) { return server.fleet().Schema().in_force; }

  std::int64_t today_ = 0;
};

TEST_F(FleetUpgradeTest, ANewerServerWorksOnTheSchemaOfAnOlderOneThatLives) {
  auto old = Open("old:1");
  const auto house = Create(old);
  auto next = Open(Next("next:2", {&old}));
  EXPECT_EQ(SchemaOfDatabase(), today_);
  EXPECT_EQ(InForce(next), today_);
  EXPECT_EQ(next.fleet().Schema().newest, today_ + 1);
  const auto garden = Create(next, "garden");
  EXPECT_OK(Commit(next, *garden));
  EXPECT_OK(Commit(old, *house));
  Pass(1, {&old, &next});
  EXPECT_EQ(OwnerIn(next.store->LoadMap("house").status()), "old:1");
  EXPECT_EQ(OwnerIn(old.store->LoadMap("garden").status()), "next:2");
}

TEST_F(FleetUpgradeTest, AServerAloneBringsTheDatabaseToItsSchema) {
  { auto old = Open("old:1"); }
  auto next = Open(Next("next:2"));
  EXPECT_EQ(SchemaOfDatabase(), today_ + 1);
  EXPECT_EQ(InForce(next), today_ + 1);
}

TEST_F(FleetUpgradeTest, AServerThatHasDiedDelaysNoUpgrade) {
  auto died = Open("died:1");  // its row stays, and it does not beat while the next version starts
  const auto map = Create(died);
  auto next = Open(Next("next:2"));
  EXPECT_EQ(SchemaOfDatabase(), today_ + 1);
  EXPECT_EQ(died.fleet().Beat().reason(), Reason("NEWER_SCHEMA")) << "it has come back";
  EXPECT_EQ(died.fleet().Counts().num_failed_beats, 1);
  Pass(2.5, {&next});
  EXPECT_FALSE(died.fleet().MayAnswer());
  EXPECT_OK(next.store->LoadMap("house")) << "its maps are taken over";
  EXPECT_EQ(Commit(died, *map).reason(), Reason("NOT_OWNER"));
}

TEST_F(FleetUpgradeTest, TheUpgradeIsFinishedOnceAllLivingServersKnowTheNewestSchema) {
  auto old = std::make_unique<Server>(Open("old:1"));
  auto next = Open(Next("next:2", {old.get()}));
  Pass(1, {old.get(), &next});
  for (const Server* asked : {&next, old.get()}) {  // a server that does not know the steps itself refuses, too
    const auto refused = asked->fleet().FinishUpgrade();
    EXPECT_EQ(refused.status().code(), StatusCode::kFailedPrecondition);
    EXPECT_NE(refused.status().message().find("old:1 (version 1.0, schema " + std::to_string(today_) + ")"),
              std::string::npos)
        << refused.status().ToString();
    EXPECT_EQ(refused.status().message().find("next:2"), std::string::npos) << "it is no obstacle";
  }
  EXPECT_EQ(SchemaOfDatabase(), today_) << "nothing has changed";

  old.reset();
  auto last = Open(Next("last:3", {&next}));
  EXPECT_EQ(SchemaOfDatabase(), today_) << "only on demand, though all know it";
  const auto finished = last.fleet().FinishUpgrade();
  ASSERT_OK(finished);
  EXPECT_EQ(finished->in_force, today_ + 1);
  EXPECT_EQ(SchemaOfDatabase(), today_ + 1);
  EXPECT_EQ(InForce(next), today_) << "it learns of it by its next beat";
  ASSERT_OK(next.fleet().Beat());
  EXPECT_EQ(InForce(next), today_ + 1);
  EXPECT_OK(next.fleet().FinishUpgrade()) << "no effect";
}

TEST_F(FleetUpgradeTest, AnOlderServerThatStartsAfterTheUpgradeIsRefused) {
  { auto next = Open(Next("next:2")); }
  const auto refused = OpenPostgresStore(PostgresCluster::Get()->Url(), OptionsOf("old:1"));
  EXPECT_EQ(refused.status().reason(), Reason("NEWER_SCHEMA"));
  EXPECT_NE(refused.status().message().find("schema " + std::to_string(today_ + 1)), std::string::npos);
}

TEST_F(FleetUpgradeTest, AnOlderServerThatBeatsDuringTheUpgradePreventsIt) {
  auto old = Open("old:1");
  postgres::Schema schema({{today_ + 1, "CREATE TABLE of_the_next_version (x bigint)"}});
  schema.Raise(today_);
  postgres::Connection connection = Connect();
  const auto rows = postgres::ReadRows(connection);
  ASSERT_OK(rows);
  ASSERT_OK(old.fleet().Beat());
  EXPECT_EQ(postgres::Upgrade(connection, schema, *rows).code(), StatusCode::kUnavailable);
  EXPECT_EQ(SchemaOfDatabase(), today_);
  EXPECT_OK(old.fleet().Beat()) << "nothing of it is there";
  EXPECT_EQ(schema.in_force(), today_);
}

TEST_F(FleetUpgradeTest, ServersThatStartAtOnceBringTheDatabaseUpTogether) {
  { auto old = Open("old:1"); }
  std::vector<Server> started(4);
  std::vector<std::thread> threads;
  threads.reserve(started.size());
  for (std::size_t n = 0; n < started.size(); ++n) {
    threads.emplace_back([&, n] { started[n] = Open(Next("next:" + std::to_string(n))); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Server& server : started) EXPECT_EQ(InForce(server), today_ + 1);
}

TEST_F(FleetUpgradeTest, AServerOfTheLastReleaseWorksBesideThisOne) {
  MakeDatabaseOfLastRelease();
  postgres::Connection last = Connect();
  ASSERT_OK(last.Execute(kRowOfLastRelease, kTask));
  PostgresStoreOptions options = OptionsOf("this:2");
  options.fleet.await_beats = [&] { EXPECT_OK(last.Execute(kRowOfLastRelease, kTask)); };
  auto server = Open(options);
  EXPECT_EQ(SchemaOfDatabase(), postgres::kOldestSchema);
  const auto map = Create(server);
  EXPECT_OK(Commit(server, *map));
  EXPECT_OK(last.Execute(kRowOfLastRelease, kTask)) << "its beats have no column that this version added";
  const auto servers = server.fleet().ListServers();
  ASSERT_OK(servers);
  ASSERT_EQ(servers->size(), 2U);
  for (const FleetServer& each : *servers) {
    EXPECT_EQ(each.newest_schema, each.is_me ? today_ : postgres::kOldestSchema);
    EXPECT_FALSE(each.following) << "the schema has no place for it";
  }
  const auto refused = server.fleet().FinishUpgrade();
  EXPECT_NE(refused.status().message().find("last:1 (version 0.9, schema 4)"), std::string::npos)
      << refused.status().ToString();

  ASSERT_OK(last.Execute("DELETE FROM servers WHERE server = 77", kTask));
  ASSERT_OK(server.fleet().FinishUpgrade());
  EXPECT_FALSE(last.Execute(kRowOfLastRelease, kTask).ok()) << "a server of that release that begins now";
  ASSERT_OK(server.fleet().Beat());
  EXPECT_TRUE(server.fleet().ListServers()->front().following);
}

TEST_F(FleetUpgradeTest, ADatabaseOlderThanTheLastReleaseIsRefusedWhileOthersUseIt) {
  MakeDatabaseOfLastRelease();
  postgres::Connection last = Connect();
  ASSERT_OK(last.Execute("DELETE FROM schema_steps WHERE step = 4; DROP TABLE incoming_maps", kTask));
  ASSERT_OK(last.Execute(kRowOfLastRelease, kTask));
  PostgresStoreOptions options = OptionsOf("this:2");
  options.fleet.await_beats = [&] { EXPECT_OK(last.Execute(kRowOfLastRelease, kTask)); };
  const auto refused = OpenPostgresStore(PostgresCluster::Get()->Url(), options);
  EXPECT_EQ(refused.status().code(), StatusCode::kFailedPrecondition);
  EXPECT_NE(refused.status().message().find("in use by last:1"), std::string::npos) << refused.status().ToString();
  options.fleet.await_beats = [] {};
  EXPECT_OK(OpenPostgresStore(PostgresCluster::Get()->Url(), options)) << "it has died";
  EXPECT_EQ(SchemaOfDatabase(), today_);
}

TEST_F(FleetUpgradeTest, ServersSayWhenTheyHaveBeatenAndHowFarTheirCopiesAreBehind) {
  auto one = Open("one:1"), two = Open("two:2");
  one.fleet().MeasureFollowing([] { return FollowingState{.num_copies = 3, .bytes = 100, .behind_s = 1.5}; });
  Pass(1, {&one, &two});
  Pass(0.7, {&two});
  const auto servers = two.fleet().ListServers();
  ASSERT_OK(servers);
  for (const FleetServer& server : *servers) {
    ASSERT_TRUE(server.beat_age_s && server.following);
    EXPECT_DOUBLE_EQ(*server.beat_age_s, server.is_me ? 0 : 0.7);
    EXPECT_EQ(server.following->num_copies, server.is_me ? 0 : 3);
    EXPECT_DOUBLE_EQ(server.following->behind_s, server.is_me ? 0 : 1.5);
  }
}

TEST_F(FleetUpgradeTest, TakeoversAreCountedWhereTheyAreMadeAndWhereTheyAreSuffered) {
  auto one = Open("one:1"), two = Open("two:2");
  const auto map = Create(one);
  Pass(1, {&one, &two});
  EXPECT_EQ(one.fleet().Counts().num_owned, 1);
  Pass(2.5, {&two});
  ASSERT_OK(two.store->LoadMap("house"));
  EXPECT_EQ(two.fleet().Counts().num_taken_over, 1);
  EXPECT_EQ(two.fleet().Counts().num_owned, 1);
  EXPECT_FALSE(Commit(one, *map).ok());
  EXPECT_EQ(one.fleet().Counts().num_lost, 1);
  EXPECT_EQ(one.fleet().Counts().num_owned, 0);
  EXPECT_EQ(one.fleet().Counts().num_taken_over, 0);
}

}  // namespace
}  // namespace dhpmap
