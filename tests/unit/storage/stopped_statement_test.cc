// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <thread>
#include <utility>

#include "storage/sqlite/database.h"
#include "tests/support/scenes.h"

namespace dhpmap::sqlite {
namespace {

thread_local const std::function<void()>* before_read = nullptr;

/// While it lives, what happens before this thread reads at a place of a file.
class BeforeEachRead {
 public:
  explicit BeforeEachRead(std::function<void()> action) : action_(std::move(action)) { before_read = &action_; }
  ~BeforeEachRead() { before_read = nullptr; }
  BeforeEachRead(const BeforeEachRead&) = delete;
  BeforeEachRead& operator=(const BeforeEachRead&) = delete;

 private:
  const std::function<void()> action_;
};

}  // namespace
}  // namespace dhpmap::sqlite

// In place of the C library's, for SQLite too, as in disk_fault_test.cc.
extern "C" long pread64(int file, void* bytes, std::size_t size, long offset) {
  if (dhpmap::sqlite::before_read != nullptr) (*dhpmap::sqlite::before_read)();
  return syscall(SYS_pread64, file, bytes, size, offset);
}

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
  const testing::TempDir folder;
  auto database = Database::Open((folder.path() / "large.db").string(), OpenMode::kReadWriteOrCreate, 0);
  ASSERT_TRUE(database.ok());
  ASSERT_TRUE(database
                  ->Execute("PRAGMA cache_size = 10; CREATE TABLE t (a INTEGER PRIMARY KEY, b); "
                            "CREATE INDEX i ON t (b); INSERT INTO t "
                            "WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n LIMIT 20000) "
                            "SELECT k, hex(randomblob(40)) FROM n",
                            "fill")
                  .ok());
  const auto num_pages = database->QueryInt("PRAGMA page_count", "count");
  ASSERT_TRUE(num_pages.ok());
  ASSERT_GT(*num_pages, 500);
  std::stop_source caller;
  std::int64_t num_reads = 0, stop_at = -1;
  const auto check = [&] {
    const StoppedBy stopped(*database, caller.get_token());
    const BeforeEachRead counting([&] {
      if (num_reads++ == stop_at) caller.request_stop();
    });
    num_reads = 0;
    return database->QueryInt("SELECT count(*) FROM pragma_integrity_check", "check").status().code();
  };
  ASSERT_EQ(check(), StatusCode::kOk);
  ASSERT_GE(num_reads, *num_pages);
  stop_at = *num_pages / 10;
  EXPECT_EQ(check(), StatusCode::kCancelled);
  EXPECT_LT(num_reads, *num_pages / 5) << "it reads each page once before it looks at any row";
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
