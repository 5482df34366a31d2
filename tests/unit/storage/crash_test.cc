// SPDX-License-Identifier: BSD-3-Clause
// Failing disks, killed processes, and two processes on one file.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <functional>

#include "tests/unit/storage/disk_fault.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::OpenMode;
using testing::DiskFault;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::SqliteStoreTest;

/// Each of the calls by which the commit writes or syncs fails once: a full disk, a broken one, a failing sync.
class BrokenDiskTest : public SqliteStoreTest, public ::testing::WithParamInterface<DiskFault::Kind> {};

TEST_P(BrokenDiskTest, AnyFailingCallIsATypedErrorAndTheStoreGoesOn) {
  Open();
  const auto map = CreateSample("house");
  int num_failed = 0;
  for (int nth = 1; nth < 200; ++nth) {
    SCOPED_TRACE("call " + std::to_string(nth));
    const auto before = map->published();
    generator_.AddBlocks(*map->FindMutable(SubmapId(2)), 2);
    const auto after = map->Publish(nth);
    Status committed;
    {
      const DiskFault fault(GetParam(), nth);
      committed = store_->Commit(*before, *after, Durability::kFull);
      if (!fault.has_struck()) break;
    }
    if (committed.ok()) {  // the failing call was not needed: a checkpoint, which is tried again
      ExpectStored(*after);
      continue;
    }
    ++num_failed;
    EXPECT_EQ(committed.code(),
              GetParam() == DiskFault::Kind::kFull ? StatusCode::kResourceExhausted : StatusCode::kUnavailable)
        << committed.ToString();
    ExpectDiscreet(committed, Path());
    ExpectStored(*before);
    ASSERT_TRUE(store_->Commit(*before, *after, Durability::kFull).ok()) << "the same commit, the disk mended";
    ExpectStored(*after);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(num_failed, 0);
  Open();
  ExpectStored(*map->published());
}

INSTANTIATE_TEST_SUITE_P(Faults, BrokenDiskTest,
                         ::testing::Values(DiskFault::Kind::kFull, DiskFault::Kind::kBroken, DiskFault::Kind::kNoSync),
                         [](const auto& kind) {
                           return kind.param == DiskFault::Kind::kFull     ? "FullDisk"
                                  : kind.param == DiskFault::Kind::kBroken ? "BrokenDisk"
                                                                           : "FailingSync";
                         });

// Other processes.

/// Runs `body` in a child process that ends when body does, or before.
pid_t Spawn(const std::function<void()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    body();
    _exit(0);
  }
  return child;
}

int WaitFor(pid_t child) {
  int state = 0;
  waitpid(child, &state, 0);
  return state;
}

TEST_F(SqliteStoreTest, ASecondStoreOnAFileIsRefusedUntilTheFirstIsClosed) {
  Open();
  fs::create_symlink(Path(), folder_.path() / "other-name.db");
  for (const char* name : {"maps.db", "other-name.db"}) {
    const Status second = OpenSqliteStore((folder_.path() / name).string()).status();
    EXPECT_EQ(second.code(), StatusCode::kFailedPrecondition);
    EXPECT_EQ(second.reason(), Reason("DATABASE_IN_USE"));
    EXPECT_NE(second.message().find(std::to_string(getpid())), std::string::npos) << second.ToString();
  }
  CreateSample("house");  // the first is not disturbed
  store_ = nullptr;
  EXPECT_FALSE(fs::exists(Path() + "-lock"));
  Open();
}

TEST_F(SqliteStoreTest, TheLockOfAProcessEndsWithItHoweverItEnds) {
  std::array<int, 2> ready{};
  ASSERT_EQ(pipe(ready.data()), 0);
  const pid_t child = Spawn([&] {
    const auto store = OpenSqliteStore(Path());
    const char opened = store.ok() ? 'y' : 'n';
    if (write(ready[1], &opened, 1) == 1) pause();
  });
  char opened = 0;
  ASSERT_EQ(read(ready[0], &opened, 1), 1);
  ASSERT_EQ(opened, 'y');
  const Status refused = TryOpen();
  EXPECT_EQ(refused.reason(), Reason("DATABASE_IN_USE"));
  EXPECT_NE(refused.message().find(std::to_string(child)), std::string::npos) << refused.ToString();
  EXPECT_TRUE(TryOpen(true).ok()) << "reading is allowed";
  kill(child, SIGKILL);
  WaitFor(child);
  Open();
  for (const int end : ready) close(end);
}

/// What another process is answered that opens `path` for writing: 'o' for OK, 'u' for in use, 'e' for all else.
char OpenElsewhere(const std::string& path) {
  const int state = WaitFor(Spawn([&] {
    const auto store = OpenSqliteStore(path);
    if (store.ok()) _exit('o');
    _exit(store.status().reason() == Reason("DATABASE_IN_USE") ? 'u' : 'e');
  }));
  return WIFEXITED(state) ? static_cast<char>(WEXITSTATUS(state)) : 'k';
}

/// Whether another process sees SQLite's lock on the database: without it, others take it for closed.
bool HasSqliteLock(const std::string& path) {
  const int state = WaitFor(Spawn([&] {
    struct flock shared {};
    shared.l_type = F_WRLCK;
    shared.l_whence = SEEK_SET;
    shared.l_start = 0x40000002;  // SHARED_FIRST of SQLite's file format
    shared.l_len = 510;
    const int file = open(path.c_str(), O_RDWR);
    _exit(file >= 0 && fcntl(file, F_GETLK, &shared) == 0 && shared.l_type == F_RDLCK ? 'y' : 'n');
  }));
  return WIFEXITED(state) && WEXITSTATUS(state) == 'y';
}

TEST_F(SqliteStoreTest, TheLockFollowsTheFileNotItsName) {
  Open();
  const auto map = CreateSample("house");
  const std::string link = (folder_.path() / "hard-link.db").string();
  fs::create_hard_link(Path(), link);
  ASSERT_TRUE(HasSqliteLock(Path()));
  EXPECT_EQ(OpenElsewhere(link), 'u');
  EXPECT_EQ(OpenSqliteStore(link).status().reason(), Reason("DATABASE_IN_USE"));
  ASSERT_TRUE(fs::remove(Path() + "-lock"));
  EXPECT_EQ(OpenElsewhere(Path()), 'u');
  EXPECT_EQ(OpenSqliteStore(Path()).status().reason(), Reason("DATABASE_IN_USE"));
  EXPECT_FALSE(fs::exists(link + "-lock"));

  // Those that were refused have not disturbed the first.
  EXPECT_TRUE(HasSqliteLock(Path()));
  const auto before = map->published();
  generator_.Change(*map);
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(20), Durability::kFull).ok());
  ExpectStored(*map->published());

  store_ = nullptr;
  EXPECT_EQ(OpenElsewhere(link), 'o');
  Open();
}

TEST_F(SqliteStoreTest, KilledAtAnyWriteOfACommitItHasTheStateBeforeOrAfter) {
  Open();
  const auto map = CreateSample("house");
  int num_before = 0, num_after = 0;
  for (int nth = 1; nth < 300; nth += 1 + nth / 8) {
    SCOPED_TRACE("call " + std::to_string(nth));
    const auto before = map->published();
    generator_.AddBlocks(*map->FindMutable(SubmapId(2)), 2);
    generator_.AddSubmap(*map, 1);
    if (nth % 3 == 0) map->Remove(map->submaps().back()->id());
    map->mutable_info().sessions.Set({"robot", nth, nth});
    const auto after = map->Publish(nth);
    store_ = nullptr;
    const int state = WaitFor(Spawn([&] {
      auto store = OpenSqliteStore(Path());
      if (!store.ok()) _exit(1);
      const DiskFault fault(DiskFault::Kind::kKill, nth);
      const Status committed = (*store)->Commit(*before, *after, Durability::kFull);
      store->reset();  // with a checkpoint, in which it may be killed too
      _exit(committed.ok() ? 0 : 2);
    }));
    Open();
    const auto stored = store_->GetMap("house");
    ASSERT_TRUE(stored.ok()) << stored.status().ToString();
    if (WIFEXITED(state)) {
      ASSERT_EQ(WEXITSTATUS(state), 0);
      ExpectStored(*after);
      break;  // it needs no more than nth calls
    }
    const bool is_after = stored->info.revision == after->revision();
    ++(is_after ? num_after : num_before);
    ExpectStored(is_after ? *after : *before);
    ASSERT_TRUE(is_after || store_->Commit(*before, *after, Durability::kNormal).ok());
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(num_before, 3);
  EXPECT_GT(num_after, 1);
}

}  // namespace
}  // namespace dhpmap
