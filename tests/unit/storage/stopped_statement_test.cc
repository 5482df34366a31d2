// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stop_token>
#include <thread>
#include <utility>

#include "storage/sqlite/database.h"

namespace dhpmap::sqlite {
namespace {

constexpr char kForHours[] = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n";

TEST(StoppedBy, EndsAStatementThatRuns) {
  auto database = Database::OpenInMemory();
  ASSERT_TRUE(database.ok());
  std::stop_source caller;
  const StoppedBy stopped(*database, caller.get_token());
  const std::jthread hanging_up([&caller] { caller.request_stop(); });
  EXPECT_EQ(database->QueryInt(kForHours, "count").status().code(), StatusCode::kCancelled);
}

TEST(StoppedBy, EndsAStatementThatBeginsAfterTheStop) {
  auto database = Database::OpenInMemory();
  ASSERT_TRUE(database.ok());
  std::stop_source caller;
  const StoppedBy stopped(*database, caller.get_token());
  caller.request_stop();
  EXPECT_EQ(database->QueryInt(kForHours, "count").status().code(), StatusCode::kCancelled);
}

/// One step of SQLite's machine, however large the file.
TEST(StoppedBy, EndsTheCheckOfAWholeFile) {
  constexpr char kCheck[] = "SELECT count(*) FROM pragma_integrity_check";
  auto database = Database::OpenInMemory();
  ASSERT_TRUE(database.ok());
  ASSERT_TRUE(database
                  ->Execute("CREATE TABLE t (a INTEGER PRIMARY KEY, b); CREATE INDEX i ON t (b); INSERT INTO t "
                            "WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n LIMIT 300000) "
                            "SELECT k, hex(randomblob(40)) FROM n",
                            "fill")
                  .ok());
  constexpr int kTries = 20;  // the stop may come too early or too late
  std::chrono::duration<double> whole(0), stopped(std::numeric_limits<double>::infinity());
  const auto check = [&](std::stop_source& caller) {
    const auto begin = std::chrono::steady_clock::now();
    const StoppedBy stopped_by(*database, caller.get_token());
    const Status status = database->QueryInt(kCheck, "check").status();
    return std::pair(status.code(), std::chrono::duration<double>(std::chrono::steady_clock::now() - begin));
  };
  std::stop_source nobody;
  const auto [first_code, first_time] = check(nobody);
  ASSERT_EQ(first_code, StatusCode::kOk);
  whole = first_time;
  for (int i = 0; i < kTries && stopped > whole / 2; ++i) {
    std::stop_source caller;
    const std::jthread hanging_up([&] {
      std::this_thread::sleep_for(whole / 10);
      caller.request_stop();
    });
    const auto [code, time] = check(caller);
    if (code == StatusCode::kCancelled) stopped = std::min(stopped, time);
    else whole = std::min(whole, time);
  }
  EXPECT_LT(stopped, whole / 2);
}

TEST(StoppedBy, LeavesAloneWhatBeginsWhenItIsGone) {
  auto database = Database::OpenInMemory();
  ASSERT_TRUE(database.ok());
  std::stop_source caller;
  caller.request_stop();
  { const StoppedBy stopped(*database, caller.get_token()); }
  const auto count = database->QueryInt(
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 1000) SELECT count(*) FROM n", "count");
  ASSERT_TRUE(count.ok()) << count.status().ToString();
  EXPECT_EQ(*count, 1000);
}

}  // namespace
}  // namespace dhpmap::sqlite
