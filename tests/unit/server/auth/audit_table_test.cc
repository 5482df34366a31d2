// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/audit_table.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"
#include "tests/support/fake_auth_tables.h"

namespace dhpmap::auth {
namespace {

class AuditTableTest : public ::testing::Test {
 protected:
  std::unique_ptr<AuditTable> Open(double flush_s = 0) {
    return std::make_unique<AuditTable>(
        tables, AuditTableOptions{.server = 5,
                                  .flush_s = flush_s,
                                  .now_s = [this] { return now_s; },
                                  .on_fault = [this](const Status& fault) { faults.push_back(fault); }});
  }
  void Admit(AuditTable& table, const std::string& map) {
    table.Write({.principal = &anna, .rpc = "/dhpmap.v1.MapService/DeleteMap", .map = map, .decision = Status::Ok()});
  }
  std::vector<AuditRow> Stored() { return tables->ListAudit({}).value(); }

  const Principal anna{.name = "anna", .key_id = "0123456789ab"};
  const Status no_key = Status(StatusCode::kUnauthenticated, "").WithReason("NO_CREDENTIAL");
  std::shared_ptr<testing::FakeAuthTables> tables = std::make_shared<testing::FakeAuthTables>();
  std::int64_t now_s = 10;
  std::vector<Status> faults;
};

TEST_F(AuditTableTest, ARowSaysWhoDidWhat) {
  const auto table = Open();
  Admit(*table, "hall");
  table->Write({.principal = nullptr, .rpc = "/x", .map = {}, .decision = no_key});
  EXPECT_TRUE(Stored().empty()) << "rows wait for a flush";
  ASSERT_OK(table->Flush());
  const auto rows = Stored();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].time_s, 10);
  EXPECT_EQ(rows[1].server, 5);
  EXPECT_EQ(rows[1].principal + rows[1].key_id + rows[1].map + rows[1].decision, "anna0123456789abhallallowed");
  EXPECT_EQ(rows[1].rpc, "/dhpmap.v1.MapService/DeleteMap");
  EXPECT_EQ(rows[0].principal + rows[0].decision, "NO_CREDENTIAL");
  EXPECT_LT(rows[1].number, rows[0].number);
}

TEST_F(AuditTableTest, RefusalsBeyondTheLimitAreCountedInTheNextRow) {
  const auto table = Open();
  for (int n = 0; n < RefusalLimit::kMostRefusals + 7; ++n) {
    table->Write({.principal = nullptr, .rpc = "/x", .map = {}, .decision = no_key});
  }
  Admit(*table, "hall");
  ASSERT_OK(table->Flush());
  const auto rows = Stored();
  ASSERT_EQ(rows.size(), RefusalLimit::kMostRefusals + 1u);
  EXPECT_EQ(rows[0].num_left_out, 7);
}

TEST_F(AuditTableTest, RowsWaitForADatabaseThatDoesNotAnswer) {
  const auto table = Open();
  tables->FailWith(Unavailable("gone"));
  Admit(*table, "a");
  EXPECT_EQ(table->Flush().code(), StatusCode::kUnavailable);
  Admit(*table, "b");
  EXPECT_EQ(table->Flush().code(), StatusCode::kUnavailable);
  EXPECT_EQ(faults.size(), 1u) << "one message for each outage";
  tables->FailWith(Status::Ok());
  ASSERT_OK(table->Flush());
  EXPECT_EQ(Stored().size(), 2u);
  EXPECT_EQ(table->num_dropped(), 0);
}

TEST_F(AuditTableTest, WaitingRowsAreBoundedAndDroppedOnesAreCounted) {
  const auto table = Open();
  tables->FailWith(Unavailable("gone"));
  for (std::size_t n = 0; n < AuditTable::kMostWaiting + 3; ++n) Admit(*table, "a");
  EXPECT_EQ(table->num_dropped(), 3);
  EXPECT_EQ(faults.size(), 1u);
  tables->FailWith(Status::Ok());
  ASSERT_OK(table->Flush());
  Admit(*table, "last");
  ASSERT_OK(table->Flush());
  const auto rows = Stored();
  ASSERT_EQ(rows.size(), AuditTable::kMostWaiting + 1);
  EXPECT_EQ(rows[0].map, "last");
  EXPECT_EQ(rows[0].num_left_out, 3);
}

TEST_F(AuditTableTest, RowsThatTheDatabaseRefusesBlockNoOthers) {
  const auto table = Open();
  tables->FailWith(Internal("bad rows"));
  Admit(*table, "a");
  EXPECT_FALSE(table->Flush().ok());
  tables->FailWith(Status::Ok());
  Admit(*table, "b");
  ASSERT_OK(table->Flush());
  ASSERT_EQ(Stored().size(), 1u);
  EXPECT_EQ(Stored()[0].num_left_out, 1);
  EXPECT_EQ(table->num_dropped(), 1);
}

TEST_F(AuditTableTest, TextOfAStrangerIsMadePlainAndShort) {
  const auto table = Open();
  table->Write({.principal = nullptr,
                .rpc = std::string_view("/a\0\xff\n", 5),
                .map = std::string(1000, 'm'),
                .decision = no_key});
  ASSERT_OK(table->Flush());
  EXPECT_EQ(Stored()[0].rpc, "/a???");
  EXPECT_EQ(Stored()[0].map.size(), AuditEntry::kMostTextBytes);
}

TEST_F(AuditTableTest, AThreadStoresTheRowsAndTheEndStoresTheRest) {
  auto table = Open(0.01);
  Admit(*table, "a");
  EXPECT_TRUE(testing::Eventually([&] { return Stored().size() == 1; }));
  table = Open(3600);
  Admit(*table, "b");
  table.reset();
  EXPECT_EQ(Stored().size(), 2u);
}

}  // namespace
}  // namespace dhpmap::auth
