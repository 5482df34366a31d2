// SPDX-License-Identifier: BSD-3-Clause
// Keys, the audit log and makers of maps in a PostgreSQL database.
#include "storage/auth_tables.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "storage/postgres/connection.h"
#include "storage/postgres_store.h"
#include "tests/support/assert_ok.h"
#include "tests/support/postgres_cluster.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap::testing {
namespace {

class AuthTablesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    schema_ = PostgresCluster::Get()->NewSchema();
  }
  std::unique_ptr<AuthTables> Open(std::int64_t most_audit_rows = 1000, std::int64_t most_audit_age_s = 1000) {
    auto opened =
        OpenAuthTables(PostgresCluster::Get()->Url(),
                       {.schema = schema_, .most_audit_rows = most_audit_rows, .most_audit_age_s = most_audit_age_s});
    EXPECT_OK(opened);
    return opened.ok() ? std::move(opened).value() : nullptr;
  }
  void Execute(const std::string& sql) {
    auto connection = postgres::Connection::Open({.url = PostgresCluster::Get()->Url(), .schema = schema_});
    ASSERT_OK(connection);
    ASSERT_OK(connection->Execute(sql, "test"));
  }
  static std::vector<std::int64_t> NumbersOf(AuthTables& tables, const AuditQuery& query = {}) {
    const auto rows = tables.ListAudit(query);
    EXPECT_OK(rows);
    std::vector<std::int64_t> numbers;
    for (const AuditRow& row : *rows) numbers.push_back(row.number);
    return numbers;
  }

  std::string schema_;
};

TEST_F(AuthTablesTest, AKeyThatOneServerWritesIsReadByAnother) {
  const auto one = Open(), other = Open();
  const std::int64_t before = other->KeysVersion().value();
  EXPECT_TRUE(other->ReadKeys()->rows.empty());
  const std::vector<KeyRow> keys = {{"b", "{\"id\":\"b\"}"}, {"a", "first"}};
  ASSERT_OK(one->WriteKeys(before, keys));
  const KeyRows read = other->ReadKeys().value();
  EXPECT_NE(read.version, before);
  EXPECT_EQ(read.version, other->KeysVersion().value());
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_EQ(read.rows[0].id + read.rows[0].record, "afirst");
  EXPECT_EQ(read.rows[1].record, "{\"id\":\"b\"}");
  ASSERT_OK(other->WriteKeys(read.version, std::vector<KeyRow>{{"a", "second"}}));
  EXPECT_EQ(one->ReadKeys()->rows[0].record, "second");
}

TEST_F(AuthTablesTest, KeysAreNotWrittenOverAnothersChange) {
  const auto one = Open(), other = Open();
  const std::int64_t seen = one->KeysVersion().value();
  ASSERT_OK(one->WriteKeys(seen, std::vector<KeyRow>{{"a", "one"}}));
  EXPECT_EQ(other->WriteKeys(seen, std::vector<KeyRow>{{"a", "other"}}).code(), StatusCode::kAborted);
  EXPECT_EQ(other->ReadKeys()->rows[0].record, "one");
}

TEST_F(AuthTablesTest, AuditRowsAreListedTheNewestFirst) {
  const auto tables = Open();
  const std::vector<AuditRow> rows = {
      {.time_s = 10,
       .server = 1,
       .number = 1,
       .principal = "anna",
       .key_id = "k",
       .rpc = "/x",
       .map = "hall",
       .decision = "allowed"},
      {.time_s = 11, .server = 1, .number = 2, .rpc = "/y", .decision = "NO_CREDENTIAL", .num_left_out = 7},
      {.time_s = 12, .server = 2, .number = 3, .principal = "anna", .rpc = "/z", .map = "room", .decision = "allowed"}};
  ASSERT_OK(tables->AppendAudit(rows));
  ASSERT_OK(tables->AppendAudit(rows)) << "a repetition after a lost answer";
  EXPECT_EQ(NumbersOf(*tables), (std::vector<std::int64_t>{3, 2, 1}));
  EXPECT_EQ(NumbersOf(*tables, {.max = 1}), (std::vector<std::int64_t>{3}));
  EXPECT_EQ(NumbersOf(*tables, {.since_s = 11}), (std::vector<std::int64_t>{3, 2}));
  EXPECT_EQ(NumbersOf(*tables, {.principal = "anna"}), (std::vector<std::int64_t>{3, 1}));
  EXPECT_EQ(NumbersOf(*tables, {.map = "hall"}), (std::vector<std::int64_t>{1}));
  const AuditRow refused = tables->ListAudit({}).value()[1];
  EXPECT_EQ(refused.principal + refused.map, "");
  EXPECT_EQ(refused.rpc + refused.decision, "/yNO_CREDENTIAL");
  EXPECT_EQ(refused.num_left_out, 7);
}

TEST_F(AuthTablesTest, OldAuditRowsAreDeletedByAgeAndByNumber) {
  const auto fill = [this](std::int64_t most_rows, std::int64_t most_age_s) {
    const auto tables = Open(most_rows, most_age_s);
    Execute("DELETE FROM audit_rows");
    std::vector<AuditRow> rows;
    for (int n = 1; n <= 20; ++n) rows.push_back({.time_s = n, .server = 1, .number = n});
    EXPECT_OK(tables->AppendAudit(rows));
    return NumbersOf(*tables, {});
  };
  EXPECT_EQ(fill(1000, 1000).size(), 20u);
  EXPECT_EQ(fill(3, 1000), (std::vector<std::int64_t>{20, 19, 18}));
  EXPECT_EQ(fill(1000, 4), (std::vector<std::int64_t>{20, 19, 18, 17, 16}));
}

TEST_F(AuthTablesTest, TheMakerOfAMapIsKnownToAllServersAsLongAsTheMapIsThere) {
  auto store = OpenPostgresStore(PostgresCluster::Get()->Url(), {.schema = schema_}).value();
  MapGenerator generator(3);
  Map map(generator.Info("hall"));
  ASSERT_OK(store->CreateMap(*map.Publish(11)));
  const std::uint64_t id = store->GetMap("hall")->info.history_id;
  const auto one = Open(), other = Open();
  ASSERT_OK(one->AddMapMaker(id, "anna"));
  ASSERT_OK(one->AddMapMaker(id + 1, "anna")) << "a map that is gone";
  EXPECT_EQ(other->MakerOf(id).value(), "anna");
  EXPECT_EQ(other->MakerOf(id + 2).value(), std::nullopt);
  EXPECT_EQ(other->MapsMadeBy("anna").value(), (std::vector<std::uint64_t>{id}));
  EXPECT_TRUE(other->MapsMadeBy("bert")->empty());
  ASSERT_OK(store->DeleteMap("hall"));
  EXPECT_TRUE(other->MapsMadeBy("anna")->empty());
  for (std::uint64_t n = 0; n < 100; ++n) ASSERT_OK(one->AddMapMaker(1000 + n, "bert"));
  EXPECT_EQ(other->MakerOf(id).value(), std::nullopt) << "rows of gone maps do not pile up";
}

TEST_F(AuthTablesTest, GoOnAfterTheConnectionsWereCut) {
  const auto tables = Open();
  ASSERT_OK(tables->WriteKeys(tables->KeysVersion().value(), std::vector<KeyRow>{{"a", "x"}}));
  PostgresCluster::Get()->CutConnections();
  EXPECT_EQ(tables->ReadKeys()->rows.size(), 1u);
  PostgresCluster::Get()->CutConnections();
  EXPECT_OK(tables->AppendAudit(std::vector<AuditRow>{{.time_s = 1, .server = 1, .number = 1}}));
}

TEST_F(AuthTablesTest, TablesOfAnEarlierVersionAreLeftToItsServers) {
  Execute("CREATE SCHEMA " + schema_ + "; CREATE TABLE schema_steps (step bigint PRIMARY KEY)");
  const auto opened = OpenAuthTables(PostgresCluster::Get()->Url(), {.schema = schema_});
  EXPECT_EQ(opened.status().reason(), Reason("OLDER_SCHEMA"));
}

TEST_F(AuthTablesTest, AStoreOpensOnTablesThatWereMadeForItsFirstKey) {
  ASSERT_OK(Open()->WriteKeys(0, std::vector<KeyRow>{{"a", "x"}}));
  EXPECT_OK(OpenPostgresStore(PostgresCluster::Get()->Url(), {.schema = schema_}));
  EXPECT_EQ(Open()->ReadKeys()->rows.size(), 1u);
}

}  // namespace
}  // namespace dhpmap::testing
