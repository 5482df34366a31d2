// SPDX-License-Identifier: BSD-3-Clause
// A copy of the database is kept before it is brought up to date: whole, in time, and only where there is room.
#include "storage/files/upgrade_copy.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <set>
#include <vector>

#include "storage/connection.h"
#include "storage/files/file_lock.h"
#include "tests/support/places.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::ExpectDiscreet;
using testing::SqliteStoreTest;

constexpr std::int64_t kOldSchema = 12;

class UpgradeCopy : public SqliteStoreTest {
 protected:
  void SetUp() override { BringBackOld(); }

  void BringBackOld() {
    const std::string name = "tests/unit/storage/released/schema-" + std::to_string(kOldSchema) + ".sqlite";
    fs::copy_file(testing::SourceDir() / name, Path(), fs::copy_options::overwrite_existing);
    fs::permissions(Path(), fs::perms::owner_write, fs::perm_options::add);
  }
  [[nodiscard]] std::string Copy() const { return Path() + ".before-v" + std::to_string(SchemaVersion()); }

  /// As the server opens it.
  Status OpenAsServer() {
    store_ = nullptr;
    told_.clear();
    auto opened = OpenSqliteStore(Path(), {.on_progress = [this](const std::string& what) { told_.push_back(what); },
                                           .keeps_copy_before_migration = true});
    if (opened.ok()) store_ = std::move(opened).value();
    return opened.status();
  }
  [[nodiscard]] bool IsTold(const std::string& what) const {
    for (const std::string& message : told_) {
      if (message.find(what) != std::string::npos) return true;
    }
    return false;
  }
  [[nodiscard]] std::set<std::string> Names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.insert(entry.path().filename().string());
    return names;
  }
  [[nodiscard]] bool HasUnfinished() const {
    for (const std::string& name : Names()) {
      if (name.starts_with("maps.db-backup-")) return true;
    }
    return false;
  }
  static std::int64_t Ask(const std::string& file, const std::string& sql) {
    auto database = sqlite::Database::Open(file, sqlite::OpenMode::kReadOnly, 1000);
    return database.ok() ? database->QueryInt(sql, "look").value() : -1;
  }

  std::vector<std::string> told_;
};

/// Rows that one file has and the other has not, over all tables; -1 if that cannot be told.
std::int64_t NumDifferentRows(const std::string& a, const std::string& b) {
  auto database = sqlite::Database::Open(a, sqlite::OpenMode::kReadOnly, 1000);
  if (!database.ok() || !database->Execute("ATTACH '" + b + "' AS other", "compare").ok()) return -1;
  auto tables = database->Prepare(
      "SELECT name FROM main.sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%' AND sql NOT LIKE "
      "'CREATE VIRTUAL%'",
      "compare");
  if (!tables.ok()) return -1;
  std::int64_t num_different = 0, num_tables = 0;
  for (auto has_row = tables->Step(); has_row.ok() && *has_row; has_row = tables->Step(), ++num_tables) {
    const std::string name = tables->Text(0);
    for (const auto& [from, to] : {std::pair("main.", "other."), std::pair("other.", "main.")}) {
      const auto count = database->QueryInt(
          "SELECT count(*) FROM (SELECT * FROM " + (from + name) + " EXCEPT SELECT * FROM " + (to + name) + ")",
          "compare");
      if (!count.ok()) return -1;
      num_different += *count;
    }
  }
  return num_tables > 5 ? num_different : -1;
}

TEST_F(UpgradeCopy, IsTheDatabaseAsItWas) {
  const std::string before = Path() + ".given";
  fs::copy_file(Path(), before);
  const Status opened = OpenAsServer();
  ASSERT_TRUE(opened.ok()) << opened.ToString();
  EXPECT_EQ(Query("PRAGMA user_version"), SchemaVersion());
  EXPECT_EQ(Ask(Copy(), "PRAGMA user_version"), kOldSchema);
  EXPECT_EQ(Ask(Copy(), "PRAGMA application_id"), kApplicationId);
  EXPECT_EQ(NumDifferentRows(before, Copy()), 0);
  EXPECT_TRUE(IsTold("kept in " + fs::canonical(Copy()).string())) << "where it is";
  store_ = nullptr;
  const auto gone_back = OpenSqliteStore(Copy());
  EXPECT_TRUE(gone_back.ok()) << gone_back.status().ToString();
}

TEST_F(UpgradeCopy, IsNotMadeOfADatabaseThatIsUpToDateNorUnlessItIsWanted) {
  Open();  // without
  EXPECT_FALSE(fs::exists(Copy()));
  ASSERT_TRUE(OpenAsServer().ok());
  EXPECT_FALSE(fs::exists(Copy()));
  store_ = nullptr;
  fs::remove(Path());
  ASSERT_TRUE(OpenAsServer().ok()) << "a new one";
  EXPECT_FALSE(fs::exists(Copy()));
  EXPECT_TRUE(told_.empty());
}

TEST_F(UpgradeCopy, WithoutRoomForItTheDatabaseStaysAsItIs) {
  const std::uintmax_t size_bytes = fs::file_size(Path());
  std::int64_t free_bytes = kFreeBesideCopy_bytes + static_cast<std::int64_t>(size_bytes) / 2;
  const UpgradeCopyOptions options{.is_kept = true, .free_bytes = [&](const std::string&) { return free_bytes; }};
  const auto refused = OpenWriter(Path(), 50, options);
  EXPECT_EQ(refused.status().code(), StatusCode::kFailedPrecondition) << refused.status().ToString();
  EXPECT_NE(refused.status().message().find("--no-backup"), std::string::npos);
  ExpectDiscreet(refused.status(), Path());
  EXPECT_EQ(Query("PRAGMA user_version"), kOldSchema);
  EXPECT_FALSE(fs::exists(Copy()));
  free_bytes = kFreeBesideCopy_bytes + static_cast<std::int64_t>(size_bytes);
  EXPECT_TRUE(OpenWriter(Path(), 50, options).ok());
  EXPECT_TRUE(fs::exists(Copy()));
}

/// Opens the database in a process that may write files of half its size at most: the copy of it fails half-way, and
/// with it the process (`is_killed`) or the opening. Whether that is what came of it.
bool FailHalfWay(const std::string& path, bool is_killed) {
  const auto half = static_cast<rlim_t>(fs::file_size(path) / 2);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0}, limit{half, half};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, is_killed ? SIG_DFL : SIG_IGN);
    _exit(OpenSqliteStore(path, {.keeps_copy_before_migration = true}).ok() ? 1 : 0);
  }
  int state = 0;
  waitpid(child, &state, 0);
  return is_killed ? WIFSIGNALED(state) && WTERMSIG(state) == SIGXFSZ : WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

TEST_F(UpgradeCopy, OfAServerThatIsKilledWhileItIsWrittenLeavesNothingHalf) {
  ASSERT_TRUE(FailHalfWay(Path(), true));
  EXPECT_FALSE(fs::exists(Copy()));
  EXPECT_EQ(Query("PRAGMA user_version"), kOldSchema);
  EXPECT_TRUE(HasUnfinished()) << "or the kill came too early to be one";
  ASSERT_TRUE(OpenAsServer().ok());
  EXPECT_EQ(Ask(Copy(), "PRAGMA user_version"), kOldSchema);
  EXPECT_FALSE(HasUnfinished());
}

TEST_F(UpgradeCopy, ThatCannotBeWrittenLeavesNothingAndTheDatabaseAsItIs) {
  const std::set<std::string> before = Names();
  ASSERT_TRUE(FailHalfWay(Path(), false));
  EXPECT_EQ(Names(), before);
  EXPECT_EQ(Query("PRAGMA user_version"), kOldSchema);
}

TEST_F(UpgradeCopy, OfAnUpgradeThatWasInterruptedIsKept) {
  ASSERT_TRUE(OpenAsServer().ok());
  store_ = nullptr;
  BringBackOld();
  {
    auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadWrite, 1000);
    ASSERT_TRUE(MigrateSchema(*database, ReleasedSteps().first(kOldSchema + 1)).ok());
  }
  const auto made = fs::last_write_time(Copy());
  ASSERT_TRUE(OpenAsServer().ok());
  EXPECT_EQ(Ask(Copy(), "PRAGMA user_version"), kOldSchema) << "not what was half-way";
  EXPECT_EQ(fs::last_write_time(Copy()), made);
  EXPECT_TRUE(IsTold("goes on")) << "and says where the copy is";
}

TEST_F(UpgradeCopy, IsMadeAnewIfTheDatabaseWasWrittenToSince) {
  ASSERT_TRUE(OpenAsServer().ok());
  store_ = nullptr;
  BringBackOld();  // an operator has gone back
  fs::last_write_time(Path(), fs::last_write_time(Copy()) - std::chrono::hours(1));
  ASSERT_TRUE(OpenAsServer().ok());
  EXPECT_TRUE(IsTold("goes on")) << "as if it had been killed before the first step";
  store_ = nullptr;
  BringBackOld();
  Tamper("UPDATE maps SET name = 'changed' WHERE map_key = (SELECT min(map_key) FROM maps)");
  fs::last_write_time(Path(), fs::last_write_time(Copy()) + std::chrono::hours(1));
  (void)OpenAsServer();
  EXPECT_EQ(Ask(Copy(), "SELECT count(*) FROM maps WHERE name = 'changed'"), 1);
}

TEST_F(UpgradeCopy, IsNamedToWhoStartsAnOlderVersion) {
  Open();
  store_ = nullptr;
  const std::string newer = std::to_string(SchemaVersion() + 84), known = std::to_string(SchemaVersion());
  const std::string copy = "maps.db.before-v" + newer;
  Tamper("PRAGMA user_version = " + newer);
  for (const bool read_only : {false, true}) {
    const Status refused = TryOpen(read_only);
    EXPECT_EQ(refused.reason(), Reason("NEWER_SCHEMA"));
    for (const std::string& part : {"schema " + newer, "up to " + known, std::string("a backup")}) {
      EXPECT_NE(refused.message().find(part), std::string::npos) << refused.message();
    }
  }
  fs::copy_file(Path(), folder_.path() / (copy + "9"));  // which we could not open either
  BringBackOld();
  fs::rename(Path(), folder_.path() / copy);
  Open();
  store_ = nullptr;
  Tamper("PRAGMA user_version = " + newer);
  const Status refused = TryOpen();
  EXPECT_NE(refused.message().find(copy + " beside it"), std::string::npos) << refused.message();
  ExpectDiscreet(refused, Path() + " ");
}

TEST_F(UpgradeCopy, IsForetoldByALookThatChangesNothing) {
  const std::set<std::string> before = Names();
  const auto written = fs::last_write_time(Path());
  const auto look = LookAtDatabase(Path());
  ASSERT_TRUE(look.ok()) << look.status().ToString();
  EXPECT_TRUE(look->is_there);
  EXPECT_EQ(look->schema, kOldSchema);
  EXPECT_EQ(look->server_schema, SchemaVersion());
  EXPECT_GT(look->copy_bytes, 0);
  EXPECT_LE(look->copy_bytes, static_cast<std::int64_t>(fs::file_size(Path())));
  EXPECT_EQ(look->copy_path, fs::weakly_canonical(Copy()).string());
  EXPECT_EQ(Names(), before);
  EXPECT_EQ(fs::last_write_time(Path()), written);
}

TEST_F(UpgradeCopy, ALookTellsWhatAnOpeningWould) {
  EXPECT_EQ(LookAtDatabase((folder_.path() / "none" / "maps.db").string()).status().code(), StatusCode::kNotFound);
  const auto absent = LookAtDatabase((folder_.path() / "other.db").string());
  ASSERT_TRUE(absent.ok());
  EXPECT_FALSE(absent->is_there);
  Open();
  const auto held = LookAtDatabase(Path());
  ASSERT_TRUE(held.ok());
  EXPECT_EQ(held->holder, "process " + std::to_string(getpid()));
  CreateSample("house");  // who holds it is not disturbed
  store_ = nullptr;
  EXPECT_EQ(LookAtDatabase(Path())->holder, "");
  EXPECT_EQ(LookAtDatabase(Path())->copy_bytes, 0);
  Tamper("PRAGMA user_version = 99");
  EXPECT_EQ(LookAtDatabase(Path()).status().reason(), Reason("NEWER_SCHEMA"));
  WriteFile("hello");
  EXPECT_EQ(LookAtDatabase(Path()).status().code(), StatusCode::kDataLoss);
}

}  // namespace
}  // namespace dhpmap
