// SPDX-License-Identifier: BSD-3-Clause
// Which files the SQLite store opens, and how.
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "storage/schema/migrate.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::OpenMode;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::SqliteStoreTest;

TEST_F(SqliteStoreTest, AFileThatIsNoDatabaseIsDataLossAndStaysAsItIs) {
  for (const std::string& content : {std::string("hello"), std::string(5000, 'x'), std::string(100'000, '\0')}) {
    WriteFile(content);
    for (const bool read_only : {false, true}) {
      const Status opened = TryOpen(read_only);
      EXPECT_EQ(opened.code(), StatusCode::kDataLoss) << opened.ToString();
      ExpectDiscreet(opened, Path());
    }
    EXPECT_EQ(fs::file_size(Path()), content.size());
  }
  EXPECT_FALSE(fs::exists(Path() + "-lock"));
}

TEST_F(SqliteStoreTest, AnEmptyFileBecomesADatabase) {
  WriteFile("");
  Open();
  CreateSample("house");
}

TEST_F(SqliteStoreTest, ADatabaseOfAnotherApplicationIsRefusedAndStaysAsItIs) {
  Tamper("CREATE TABLE theirs (x)");
  EXPECT_EQ(TryOpen().reason(), Reason("FOREIGN_DATABASE"));
  Tamper("PRAGMA application_id = 77");
  for (const bool read_only : {false, true}) {
    const Status opened = TryOpen(read_only);
    EXPECT_EQ(opened.code(), StatusCode::kFailedPrecondition);
    EXPECT_EQ(opened.reason(), Reason("FOREIGN_DATABASE"));
  }
  EXPECT_EQ(Query("SELECT count(*) FROM sqlite_schema"), 1);
  EXPECT_EQ(Query("PRAGMA application_id"), 77);
}

TEST_F(SqliteStoreTest, ANewerSchemaIsRefused) {
  Open();
  CreateSample("house");
  store_ = nullptr;
  Tamper("PRAGMA user_version = 99");
  for (const bool read_only : {false, true}) {
    const Status opened = TryOpen(read_only);
    EXPECT_EQ(opened.code(), StatusCode::kFailedPrecondition);
    EXPECT_EQ(opened.reason(), Reason("NEWER_SCHEMA"));
    EXPECT_NE(opened.message().find("99"), std::string::npos);
  }
}

TEST_F(SqliteStoreTest, MarksItsFiles) {
  Open();
  EXPECT_EQ(Query("PRAGMA application_id"), kApplicationId);
  EXPECT_EQ(Query("PRAGMA user_version"), SchemaVersion());
  EXPECT_EQ(Query("PRAGMA page_size"), 4096);
}

TEST_F(SqliteStoreTest, AMissingTableOrTriggerIsDataLoss) {
  for (const char* damage : {"DROP TRIGGER submaps_delete_box", "DROP TABLE tiles"}) {
    fs::remove(Path());
    Open();
    store_ = nullptr;
    Tamper(damage);
    for (const bool read_only : {false, true}) {
      const Status opened = TryOpen(read_only);
      EXPECT_EQ(opened.code(), StatusCode::kDataLoss) << opened.ToString();
      ExpectDiscreet(opened, Path());
    }
  }
}

TEST_F(SqliteStoreTest, ATruncatedFileIsDataLoss) {
  Open();
  CreateSample("house");
  store_ = nullptr;
  const auto size = fs::file_size(Path());
  for (const auto kept : {size - 4096, size / 2, std::uintmax_t{4096}, std::uintmax_t{1000}}) {
    fs::resize_file(Path(), kept);
    const Status opened = TryOpen();
    EXPECT_EQ(opened.code(), StatusCode::kDataLoss) << kept << ": " << opened.ToString();
    ExpectDiscreet(opened, Path());
  }
}

TEST_F(SqliteStoreTest, AMissingFolderIsNotFound) {
  for (const bool read_only : {false, true}) {
    const auto opened = OpenSqliteStore((folder_.path() / "none" / "maps.db").string(), {.read_only = read_only});
    EXPECT_EQ(opened.status().code(), StatusCode::kNotFound) << opened.status().ToString();
    ExpectDiscreet(opened.status(), folder_.path().string());
  }
}

TEST_F(SqliteStoreTest, AFolderInPlaceOfTheFileIsRefused) {
  fs::create_directory(Path());
  EXPECT_EQ(TryOpen().code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(TryOpen(true).code(), StatusCode::kFailedPrecondition);
}

// Read-only.

TEST_F(SqliteStoreTest, AStoreOpenedReadOnlyReadsAndRefusesToWrite) {
  Open();
  const auto map = CreateSample("house");
  Open(true);
  ExpectStored(*map->published());
  const auto before = map->published();
  map->mutable_info().num_frames = 5;
  const Status committed = store_->Commit(*before, *map->Publish(20), Durability::kNormal);
  EXPECT_EQ(committed.code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(committed.reason(), Reason("NOT_WRITABLE"));
  EXPECT_EQ(store_->DeleteMap("house").code(), StatusCode::kFailedPrecondition);
  Map other(generator_.Info("other"));
  EXPECT_EQ(store_->CreateMap(*other.Publish(1)).code(), StatusCode::kFailedPrecondition);
}

TEST_F(SqliteStoreTest, ReadsBesideAWriter) {
  Open();
  const auto map = CreateSample("house");
  const auto reader = OpenSqliteStore(Path(), {.read_only = true});
  ASSERT_TRUE(reader.ok()) << reader.status().ToString();
  const auto before = map->published();
  generator_.Change(*map);
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(20), Durability::kNormal).ok());
  ExpectSameMap(*map->published(), **(*reader)->LoadMap("house"));
}

/// Runs `body` in a child process, as a user without rights if we are root; returns its exit code.
int RunWithoutRights(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(99);
    _exit(body());
  }
  int state = 0;
  waitpid(child, &state, 0);
  return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

TEST_F(SqliteStoreTest, AFileWithoutWriteAccessIsRefusedForWritingAndReadOtherwise) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  // With and without access to the folder: SQLite then cannot put its own files there.
  for (const auto folder_access : {fs::perms::all, fs::perms::owner_read | fs::perms::owner_exec |
                                                       fs::perms::others_read | fs::perms::others_exec}) {
    fs::permissions(folder_.path(), folder_access);
    fs::permissions(Path(), fs::perms::owner_read | fs::perms::others_read);
    EXPECT_EQ(RunWithoutRights([&] {
                const Status opened = TryOpen();
                if (opened.code() != StatusCode::kFailedPrecondition) return 1;
                if (opened.reason() != "NOT_WRITABLE") return 2;
                if (!TryOpen(true).ok()) return 3;
                const auto loaded = store_->LoadMap("house");
                store_ = nullptr;
                return loaded.ok() && (*loaded)->submaps().size() == map->submaps().size() ? 0 : 4;
              }),
              0);
    fs::permissions(folder_.path(), fs::perms::all);
    EXPECT_FALSE(fs::exists(Path() + "-lock"));
    for (const char* left : {"-wal", "-shm"}) fs::remove(Path() + left);  // a reader of SQLite's may leave them
  }
}

}  // namespace
}  // namespace dhpmap
