// SPDX-License-Identifier: BSD-3-Clause
#include "storage/space_reclaimer.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "storage/connection.h"
#include "storage/files/backup.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/free_pages.h"
#include "storage/sqlite/transaction.h"
#include "tests/support/eventually.h"
#include "tests/support/places.h"
#include "tests/unit/storage/disk_fault.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::Transaction;
using testing::DiskFault;
using testing::SqliteStoreTest;
using Progress = SpaceReclaimer::Progress;

constexpr std::int64_t kPageBytes = 4096;

/// A reclaimer that keeps nothing spare, stepped by hand on a connection of its own.
class SteppedReclaimer {
 public:
  explicit SteppedReclaimer(const std::string& path)
      : writer_(OpenWriter(path, 50).value()),
        reclaimer_({.write = [this](const auto& body) { return Write(body); },
                    .hold = [](const auto& body) { return body(); }},
                   OpenForLog(path).value(), 0) {}

  Progress Step() { return reclaimer_.Step(); }
  /// Steps until there is nothing more to do, or no way to do it.
  Progress Run() {
    Progress progress = Progress::kMore;
    while (progress == Progress::kMore) progress = Step();
    return progress;
  }

 private:
  Status Write(const std::function<Status(Database&)>& body) {
    DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginWrite(writer_));
    DHPMAP_RETURN_IF_ERROR(body(writer_));
    return transaction.Commit();
  }

  Database writer_;
  SpaceReclaimer reclaimer_;
};

class SpaceReclaimerTest : public SqliteStoreTest {
 protected:
  /// Objects of some 30 KB each.
  std::unique_ptr<Map> CreateMap(const std::string& name, int num_objects) {
    auto map = std::make_unique<Map>(generator_.Info(name));
    for (int n = 0; n < num_objects; ++n) generator_.AddSubmap(*map, 30);
    const Status created = store_->CreateMap(*map->Publish(11));
    EXPECT_TRUE(created.ok()) << created.ToString();
    return map;
  }
  void Delete(const std::string& name) {
    const Status deleted = store_->DeleteMap(name);
    ASSERT_TRUE(deleted.ok()) << deleted.ToString();
  }
  [[nodiscard]] std::int64_t FileBytes() const { return static_cast<std::int64_t>(fs::file_size(Path())); }
  [[nodiscard]] std::int64_t LogBytes() const {
    std::error_code none;
    const auto bytes = fs::file_size(Path() + "-wal", none);
    return none ? 0 : static_cast<std::int64_t>(bytes);
  }
  void ExpectSound() {
    EXPECT_EQ(Query("SELECT count(*) FROM pragma_integrity_check WHERE integrity_check = 'ok'"), 1);
    EXPECT_EQ(Query("SELECT count(*) FROM pragma_foreign_key_check"), 0);
  }
  /// Without the store, which is opened again by who needs it.
  Progress Reclaim() {
    store_ = nullptr;
    return SteppedReclaimer(Path()).Run();
  }
};

TEST_F(SpaceReclaimerTest, AfterADeletionTheFileIsAsIfTheMapHadNeverBeen) {
  Open();
  const auto kept = CreateMap("kept", 3);
  store_ = nullptr;
  const std::int64_t bytes_before = FileBytes();
  Open();
  CreateMap("house", 20);
  Delete("house");
  store_ = nullptr;
  ASSERT_GT(FileBytes(), bytes_before + 400'000) << "what was deleted is still in the file";
  EXPECT_EQ(Reclaim(), Progress::kDone);
  EXPECT_LE(FileBytes(), bytes_before + 2 * kPageBytes);
  ExpectSound();
  Open();
  ExpectStored(*kept->published());
}

TEST_F(SpaceReclaimerTest, TheOrderOfDeletionsDoesNotMatter) {
  std::vector<std::string> names{"attic", "barn", "cellar"};
  std::vector<std::int64_t> sizes;
  do {
    fs::remove(Path());
    generator_ = testing::MapGenerator(9);
    Open();
    std::vector<std::unique_ptr<Map>> kept;
    for (const char* name : {"attic", "first", "barn", "second", "cellar", "third"}) {
      const bool is_kept = std::find(names.begin(), names.end(), name) == names.end();
      auto map = CreateMap(name, is_kept ? 1 : 3);
      if (is_kept) kept.push_back(std::move(map));
    }
    for (const std::string& name : names) {
      Delete(name);
      EXPECT_EQ(Reclaim(), Progress::kDone);
      Open();
    }
    for (const auto& map : kept) ExpectStored(*map->published());
    store_ = nullptr;
    ExpectSound();
    EXPECT_EQ(Query("PRAGMA freelist_count"), 0);
    sizes.push_back(FileBytes());
  } while (std::next_permutation(names.begin(), names.end()) && !HasFailure());
  ASSERT_EQ(sizes.size(), 6u);
  const auto [smallest, largest] = std::minmax_element(sizes.begin(), sizes.end());
  EXPECT_LE(*largest - *smallest, 4 * kPageBytes);
}

TEST_F(SpaceReclaimerTest, RemovedSubmapsGiveTheirSpaceBackToo) {
  Open();
  const auto map = CreateMap("house", 20);
  const auto before = map->published();
  while (map->submaps().size() > 3) map->Remove(map->submaps().back()->id());
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(12), Durability::kNormal).ok());
  store_ = nullptr;
  const std::int64_t bytes_before = FileBytes();
  EXPECT_EQ(Reclaim(), Progress::kDone);
  EXPECT_LT(FileBytes(), bytes_before / 4);
  ExpectSound();
  Open();
  ExpectStored(*map->published());
}

TEST_F(SpaceReclaimerTest, AReaderKeepsItsStateAndTheFileIsCutWhenItHasGone) {
  Open();
  CreateMap("house", 20);
  store_ = nullptr;
  const std::int64_t bytes_before = FileBytes();
  auto reader = Database::Open(Path(), sqlite::OpenMode::kReadOnly, 0);
  ASSERT_TRUE(reader.ok());
  SteppedReclaimer reclaimer(Path());  // keeps the log, so that the reader can be the last to leave
  {
    auto reading = Transaction::BeginRead(*reader);
    ASSERT_TRUE(reading.ok());
    const std::int64_t num_blobs = reader->QueryInt("SELECT count(*) FROM tile_blobs", "look").value();
    ASSERT_GT(num_blobs, 300);
    Tamper("PRAGMA foreign_keys = ON; DELETE FROM maps");
    EXPECT_EQ(reclaimer.Run(), Progress::kBlocked);
    EXPECT_EQ(FileBytes(), bytes_before);
    EXPECT_EQ(reader->QueryInt("SELECT count(*) FROM tile_blobs", "look").value(), num_blobs);
    EXPECT_EQ(
        reader->QueryInt("SELECT count(*) FROM pragma_integrity_check WHERE integrity_check = 'ok'", "look").value(),
        1);
  }
  EXPECT_EQ(reclaimer.Run(), Progress::kDone);
  EXPECT_LT(FileBytes(), bytes_before / 4);
  EXPECT_EQ(LogBytes(), 0);
  EXPECT_EQ(reader->QueryInt("SELECT count(*) FROM tile_blobs", "look").value(), 0);
}

TEST_F(SpaceReclaimerTest, TheLogIsCutWhoeverFilledIt) {
  Open();
  CreateMap("house", 1);
  store_ = nullptr;
  SteppedReclaimer reclaimer(Path());
  ASSERT_EQ(reclaimer.Run(), Progress::kDone);
  Tamper("CREATE TABLE others (bytes BLOB); INSERT INTO others VALUES (zeroblob(1000000))");
  const std::int64_t short_log_bytes = LogBytes();
  EXPECT_EQ(reclaimer.Run(), Progress::kDone);
  EXPECT_EQ(LogBytes(), short_log_bytes) << "not worth a sync";
  Tamper("INSERT INTO others VALUES (zeroblob(" + std::to_string(SpaceReclaimer::kMaxLogBytes) + "))");
  ASSERT_GT(LogBytes(), SpaceReclaimer::kMaxLogBytes);
  EXPECT_EQ(reclaimer.Run(), Progress::kDone);
  EXPECT_EQ(LogBytes(), 0);
  ExpectSound();
}

TEST_F(SpaceReclaimerTest, AStepDoesABoundedShareOfTheWork) {
  Open();
  CreateMap("house", 50);
  store_ = nullptr;
  Tamper("PRAGMA foreign_keys = ON; DELETE FROM maps");
  SteppedReclaimer reclaimer(Path());
  const auto num_dead = [&] { return Query("SELECT count(*) FROM dead_blobs"); };
  ASSERT_GT(num_dead(), SpaceReclaimer::kMaxAStep);
  for (std::int64_t dead = num_dead(), pages = Query("PRAGMA page_count"); reclaimer.Step() == Progress::kMore;) {
    EXPECT_LE(dead - num_dead(), SpaceReclaimer::kMaxAStep);
    EXPECT_LE(pages - Query("PRAGMA page_count"), SpaceReclaimer::kMaxAStep + 1) << "one that says who refers to them";
    dead = num_dead();
    pages = Query("PRAGMA page_count");
  }
  EXPECT_EQ(num_dead(), 0);
}

TEST_F(SpaceReclaimerTest, StepsAreBoundedInBlobsAndBytesAndEndWithAllThatIsUsedAndNothingElse) {
  constexpr std::int64_t kLargest = SpaceReclaimer::kMaxBytesAStep + 100'000;
  Open();
  const auto kept = CreateMap("kept", 2);
  store_ = nullptr;
  const std::int64_t bytes_before = FileBytes();
  const std::string used =
      "SELECT group_concat(blob_key || ' ' || length(blob)) = (SELECT words FROM seen) FROM (SELECT "
      "* FROM tile_blobs ORDER BY blob_key)";
  Tamper(
      "CREATE TABLE seen (words TEXT); INSERT INTO seen SELECT group_concat(blob_key || ' ' || length(blob)) FROM "
      "(SELECT * FROM tile_blobs ORDER BY blob_key);"
      // Of all sizes, and two that are larger than a step.
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 900) INSERT INTO tile_blobs "
      "(num_blocks, blob) SELECT 1, zeroblob(CASE WHEN i % 450 = 7 THEN " +
      std::to_string(kLargest) +
      " ELSE 40 + i % 31 * 997 END) FROM n; INSERT INTO dead_blobs SELECT blob_key FROM tile_blobs EXCEPT SELECT "
      "blob_key FROM blob_references");
  ASSERT_EQ(Query("SELECT count(*) FROM dead_blobs"), 900);
  SteppedReclaimer reclaimer(Path());
  const auto look = [&] {
    return std::pair(Query("SELECT count(*) FROM tile_blobs"), Query("SELECT total(length(blob)) FROM tile_blobs"));
  };
  int num_steps = 0, num_large = 0;
  auto [blobs, bytes] = look();
  for (; reclaimer.Step() == Progress::kMore; ++num_steps) {
    const auto [blobs_now, bytes_now] = look();
    EXPECT_LE(blobs - blobs_now, SpaceReclaimer::kMaxAStep);
    if (bytes - bytes_now > SpaceReclaimer::kMaxBytesAStep) {
      EXPECT_EQ(blobs - blobs_now, 1) << "a large one has a step of its own";
      ++num_large;
    }
    std::tie(blobs, bytes) = std::tie(blobs_now, bytes_now);
    ASSERT_EQ(Query(used.substr(0, used.rfind("FROM (")) + "FROM (SELECT * FROM tile_blobs WHERE blob_key NOT IN "
                                                           "(SELECT blob_key FROM dead_blobs) ORDER BY blob_key)"),
              1)
        << "something that is used went in step " << num_steps;
  }
  EXPECT_EQ(num_large, 2);
  EXPECT_GT(num_steps, 5);
  EXPECT_EQ(Query("SELECT count(*) FROM dead_blobs"), 0);
  EXPECT_EQ(Query(used), 1) << "and nothing else is left";
  Tamper("DROP TABLE seen");
  EXPECT_EQ(reclaimer.Run(), Progress::kDone);
  EXPECT_LE(FileBytes(), bytes_before + 4 * kPageBytes) << "the space is given back";
  ExpectSound();
  Open();
  ExpectStored(*kept->published());
}

TEST_F(SpaceReclaimerTest, WhatHasTakenItsTimeEndsAfterOneBlob) {
  Open();
  CreateMap("house", 5);
  store_ = nullptr;
  Tamper("PRAGMA foreign_keys = ON; DELETE FROM maps");
  auto database = OpenWriter(Path(), 50);
  ASSERT_TRUE(database.ok());
  const std::int64_t num_dead = Query("SELECT count(*) FROM dead_blobs");
  const auto collected = CollectDeadBlobs(*database, {.max_blobs = num_dead, .end = std::chrono::steady_clock::now()});
  ASSERT_TRUE(collected.ok());
  EXPECT_EQ(collected->num_blobs, 1);
  EXPECT_TRUE(collected->has_more);
  EXPECT_EQ(Query("SELECT count(*) FROM dead_blobs"), num_dead - 1);
  const auto rest = CollectDeadBlobs(*database, {.max_blobs = num_dead});
  ASSERT_TRUE(rest.ok());
  EXPECT_EQ(rest->num_blobs, num_dead - 1);
  EXPECT_FALSE(rest->has_more);
}

TEST_F(SpaceReclaimerTest, KeepsUpWithAWriterWhoseEveryCommitLeavesBlobs) {
  constexpr int kBlobsACommit = 40;
  Open();
  CreateMap("house", 30);
  store_ = nullptr;
  Tamper("PRAGMA foreign_keys = ON; DELETE FROM maps");
  const std::int64_t bytes_before = FileBytes();
  SteppedReclaimer reclaimer(Path());
  const auto commit = [&] {  // as many come as go
    Tamper("INSERT INTO dead_blobs SELECT blob_key FROM tile_blobs EXCEPT SELECT blob_key FROM dead_blobs");
    Tamper(
        "INSERT INTO tile_blobs (num_blocks, blob) WITH RECURSIVE count(n) AS (VALUES (1) UNION ALL SELECT n + 1 "
        "FROM count WHERE n < " +
        std::to_string(kBlobsACommit) + ") SELECT 1, randomblob(6000) FROM count");
  };
  int num_commits = 0;
  for (; num_commits < 200 && (FileBytes() > bytes_before / 4 || num_commits < 20); ++num_commits) {
    commit();
    ASSERT_NE(reclaimer.Step(), Progress::kBlocked);  // one turn a commit
  }
  EXPECT_LE(FileBytes(), bytes_before / 4) << "after " << num_commits << " commits";
  EXPECT_LE(Query("SELECT count(*) FROM dead_blobs"), 2 * kBlobsACommit);
  ExpectSound();
}

/// A file with much to give back and a map that stays, to be copied for each fault.
class BrokenReclaimTest : public SpaceReclaimerTest {
 protected:
  void SetUp() override {
    Open();
    CreateMap("house", 6);
    kept_ = CreateMap("kept", 1);
    Delete("house");
    store_ = nullptr;
    fs::copy_file(Path(), Template());
    ASSERT_EQ(Reclaim(), Progress::kDone);
    bytes_at_end_ = FileBytes();
    ASSERT_LT(bytes_at_end_ + 150'000, static_cast<std::int64_t>(fs::file_size(Template())));
  }
  [[nodiscard]] fs::path Template() const { return folder_.path() / "template.db"; }
  void Restart() { fs::copy_file(Template(), Path(), fs::copy_options::overwrite_existing); }

  void ExpectIntactAndReclaimable() {
    EXPECT_EQ(Reclaim(), Progress::kDone);
    EXPECT_EQ(FileBytes(), bytes_at_end_);
    ExpectSound();
    Open();
    ExpectStored(*kept_->published());
    store_ = nullptr;
  }

  std::unique_ptr<Map> kept_;
  std::int64_t bytes_at_end_ = 0;
};

/// The first calls one by one, later ones in growing strides.
int NextCallAfter(int nth) { return nth + 1 + nth / 2; }

TEST_F(BrokenReclaimTest, KilledAtAnyWriteNothingIsLostAndTheNextStartGoesOn) {
  int num_killed = 0;
  for (int nth = 1; nth < 5000; nth = NextCallAfter(nth)) {
    SCOPED_TRACE("call " + std::to_string(nth));
    Restart();
    const pid_t child = fork();
    if (child == 0) {
      SteppedReclaimer reclaimer(Path());
      const DiskFault fault(DiskFault::Kind::kKill, nth);
      _exit(reclaimer.Run() == Progress::kDone ? 0 : 1);
    }
    int state = 0;
    waitpid(child, &state, 0);
    ExpectIntactAndReclaimable();
    ASSERT_FALSE(HasFailure());
    if (WIFEXITED(state)) {
      ASSERT_EQ(WEXITSTATUS(state), 0);
      break;  // it needs no more than nth calls
    }
    ++num_killed;
  }
  EXPECT_GT(num_killed, 6);
}

TEST_F(BrokenReclaimTest, AFailingDiskStopsItUntilItWorksAgain) {
  for (const auto kind : {DiskFault::Kind::kFull, DiskFault::Kind::kBroken, DiskFault::Kind::kNoSync}) {
    int num_blocked = 0;
    for (int nth = 1; nth < 5000; nth = NextCallAfter(nth)) {
      SCOPED_TRACE("fault " + std::to_string(static_cast<int>(kind)) + ", call " + std::to_string(nth));
      Restart();
      {
        SteppedReclaimer reclaimer(Path());
        bool has_struck = false;
        {
          const DiskFault fault(kind, nth);
          num_blocked += reclaimer.Run() == Progress::kBlocked;
          has_struck = fault.has_struck();
        }
        if (!has_struck) break;
        EXPECT_EQ(reclaimer.Run(), Progress::kDone) << "the disk mended";
      }
      ExpectIntactAndReclaimable();
      ASSERT_FALSE(HasFailure());
    }
    EXPECT_GT(num_blocked, 0);
  }
}

TEST_F(SpaceReclaimerTest, AFileOfBeforeKeepsItsSpaceAndItsBackupDoesNot) {
  const fs::path released = testing::SourceDir() / "tests/unit/storage/released/schema-2.sqlite";
  fs::copy_file(released, Path());
  Open();
  EXPECT_EQ(Query("PRAGMA auto_vacuum"), 0);
  CreateMap("house", 20);
  const std::string copy = (folder_.path() / "copy.db").string();
  {
    auto database = Database::Open(Path(), sqlite::OpenMode::kReadOnly, 1000);
    ASSERT_TRUE(database.ok());
    const Status written = WriteBackup(*database, copy, {});
    ASSERT_TRUE(written.ok()) << written.ToString();
  }
  Delete("house");
  ASSERT_TRUE(testing::Eventually([&] { return Query("SELECT count(*) FROM dead_blobs") == 0; }))
      << "its thread collects";
  store_ = nullptr;
  const std::int64_t bytes_before = FileBytes();
  ASSERT_GT(bytes_before, 400'000);
  Open();
  CreateMap("house", 20);
  store_ = nullptr;
  EXPECT_LE(FileBytes(), bytes_before + 10 * kPageBytes) << "free pages are used again";

  fs::rename(copy, Path());
  Open();
  EXPECT_EQ(Query("PRAGMA auto_vacuum"), 2);
  Delete("house");
  EXPECT_EQ(Reclaim(), Progress::kDone);
  EXPECT_LT(FileBytes(), bytes_before / 4);
  ExpectSound();
}

/// The store's own thread.
class ReclaimingStoreTest : public SpaceReclaimerTest {
 protected:
  /// 10 MB of a table that is none of ours.
  void Fill() {
    Tamper(
        "CREATE TABLE filler (bytes BLOB); INSERT INTO filler WITH RECURSIVE count(n) AS "
        "(VALUES (1) UNION ALL SELECT n + 1 FROM count WHERE n < 2500) SELECT zeroblob(4000) FROM count");
  }
  /// What is committed after the log was cut is in it again, up to where it is cut the next time.
  [[nodiscard]] bool IsCut() const { return FileBytes() < 6'000'000 && LogBytes() <= SpaceReclaimer::kMaxLogBytes; }
  void ExpectCut() {
    EXPECT_TRUE(testing::Eventually([&] { return IsCut(); })) << FileBytes() << " bytes, log " << LogBytes();
  }
};

TEST_F(ReclaimingStoreTest, ADeletionCutsTheFileAndItsLogWhileOthersAreWritten) {
  Open();
  const auto kept = CreateMap("kept", 2);
  CreateMap("house", 2);
  Fill();
  Tamper("DROP TABLE filler");  // seen with the next commit
  ASSERT_GT(FileBytes(), 10'000'000);
  ASSERT_GT(LogBytes(), 5'000'000);
  Delete("house");
  for (int n = 1; n <= 20; ++n) {
    const auto before = kept->published();
    generator_.AddBlocks(*kept->FindMutable(SubmapId(1)), 2);
    ASSERT_TRUE(store_->Commit(*before, *kept->Publish(20 + n), Durability::kNormal).ok());
    ASSERT_TRUE(store_->LoadMap("kept").ok());
  }
  ExpectCut();
  EXPECT_GT(FileBytes(), 4'000'000) << "some stays for what is stored next";
  ExpectStored(*kept->published());
  ExpectSound();
}

TEST_F(ReclaimingStoreTest, CommitsAfterTheLastCutLeaveNoLongLog) {
  const auto is_log_short = [&] { return LogBytes() <= SpaceReclaimer::kMaxLogBytes; };
  Open();
  const auto map = CreateMap("house", 1);
  for (int n = 1; FileBytes() < 2 * SpaceReclaimer::kMaxLogBytes; ++n) {  // all of it went through the log
    const auto before = map->published();
    for (int i = 0; i < 4; ++i) generator_.AddSubmap(*map, 60);
    ASSERT_TRUE(store_->Commit(*before, *map->Publish(20 + n), Durability::kNormal).ok());
    ASSERT_TRUE(testing::Eventually(is_log_short)) << LogBytes();
  }
  ExpectSound();
}

TEST_F(ReclaimingStoreTest, GoesOnAfterARestart) {
  Open();
  Fill();
  store_ = nullptr;
  Tamper("DROP TABLE filler");
  ASSERT_GT(FileBytes(), 10'000'000);
  Open();
  ExpectCut();
}

}  // namespace
}  // namespace dhpmap
