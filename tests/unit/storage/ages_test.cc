// SPDX-License-Identifier: BSD-3-Clause
// How old what is kept of edits and changes is, whatever the system's clock is set to: as both stores count it.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

using testing::SqliteStoreTest;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kDay_ns = 86'400 * kSecond_ns;
constexpr std::int64_t kNow_ns = 1'800'000'000 * kSecond_ns;

enum class AgedStore { kMemory, kSqlite };

class AgesTest : public SqliteStoreTest {
 protected:
  void OpenKind(AgedStore kind, const SqliteStoreOptions& limits = {}) {
    store_ = nullptr;
    SqliteStoreOptions options = limits;
    options.passing_time_ns = [this] { return passed_ns_; };
    if (kind == AgedStore::kMemory) {
      store_ = MakeMemoryStore(options.changes, options.edits, options.passing_time_ns);
      return;
    }
    auto opened = OpenSqliteStore(Path(), options);
    ASSERT_TRUE(opened.ok()) << opened.status().ToString();
    store_ = std::move(opened).value();
  }
  void Begin(AgedStore kind, const SqliteStoreOptions& limits = {}) {
    store_ = nullptr;
    std::filesystem::remove(Path());
    OpenKind(kind, limits);
    map_ = CreateSample("a");
  }
  /// An edit with this id, while the system's clock says so.
  void Edit(const std::string& request_id, std::int64_t time_ns) {
    const auto before = map_->published();
    map_->mutable_info().display_name = "named by " + request_id;
    const auto after = map_->Publish(time_ns);
    const EditRecord record{.entry = {after->revision(), time_ns, {.request_id = request_id}, {}},
                            .answer = "done " + request_id,
                            .before = before};
    const Status done = store_->CommitEdit(*before, *after, record);
    ASSERT_TRUE(done.ok()) << done.ToString();
  }
  /// The edits whose answers are known, and those that can be undone, the newest first.
  [[nodiscard]] std::string Kept() const {
    std::string text;
    const auto edits = store_->ListEdits("a", {});
    EXPECT_TRUE(edits.ok());
    for (const LoggedEdit& edit : *edits) {
      const std::string& id = edit.entry.source.request_id;
      EXPECT_TRUE(*store_->FindAnswer("a", id));
      text += id + (edit.is_kept ? "+ " : " ");
    }
    return text;
  }
  /// The revisions after which all changes can be read begin here.
  [[nodiscard]] std::int64_t CompleteAfter() const {
    const std::int64_t revision = map_->info().revision;
    return store_->ListChanges("a", revision, 1)->complete_after;
  }

  std::int64_t passed_ns_ = 0;
  std::unique_ptr<Map> map_;
};

class AgesInStoresTest : public AgesTest, public ::testing::WithParamInterface<AgedStore> {};

TEST_P(AgesInStoresTest, AClockThatIsSetForwardTakesNothingFreshAway) {
  Begin(GetParam());
  Edit("1", kNow_ns);
  Edit("2", kNow_ns + kSecond_ns);
  Edit("3", kNow_ns + 400 * kDay_ns);
  Edit("4", kNow_ns + 400 * kDay_ns);
  EXPECT_EQ(Kept(), "4+ 3+ 2+ 1+ ");
  EXPECT_EQ(CompleteAfter(), 0);
}

TEST_P(AgesInStoresTest, AClockThatIsSetBackKeepsNothingForEver) {
  Begin(GetParam(), {.changes = {.max_age_s = 60}, .edits = {.max_age_s = 60, .max_history_age_s = 30}});
  Edit("1", kNow_ns + 400 * kDay_ns);
  passed_ns_ += 40 * kSecond_ns;
  Edit("2", kNow_ns);
  EXPECT_EQ(Kept(), "2+ 1 ");
  passed_ns_ += 30 * kSecond_ns;
  Edit("3", kNow_ns - 400 * kDay_ns);
  EXPECT_EQ(Kept(), "3+ 2+ ");
  EXPECT_EQ(CompleteAfter(), 2) << "the map, and the first edit";
}

INSTANTIATE_TEST_SUITE_P(Stores, AgesInStoresTest, ::testing::Values(AgedStore::kMemory, AgedStore::kSqlite),
                         [](const auto& kind) { return kind.param == AgedStore::kMemory ? "Memory" : "Sqlite"; });

TEST_F(AgesTest, TheyGoOnOverRestartsWithTheClockSetInBetween) {
  const SqliteStoreOptions limits{.changes = {.max_age_s = 600}, .edits = {.max_age_s = 600}};
  Begin(AgedStore::kSqlite, limits);
  Edit("1", kNow_ns);
  passed_ns_ += 200 * kSecond_ns;  // and then it ends, with that noted
  store_ = nullptr;
  passed_ns_ = 77 * kDay_ns;  // another machine's start
  OpenKind(AgedStore::kSqlite, limits);
  passed_ns_ += 390 * kSecond_ns;
  Edit("2", kNow_ns + 400 * kDay_ns);
  EXPECT_EQ(Kept(), "2+ 1+ ") << "which is 590 s old";
  store_ = nullptr;
  OpenKind(AgedStore::kSqlite, limits);
  passed_ns_ += 20 * kSecond_ns;
  Edit("3", kNow_ns - 400 * kDay_ns);
  EXPECT_EQ(Kept(), "3+ 2+ ");
  EXPECT_EQ(CompleteAfter(), 2);
}

TEST_F(AgesTest, WhatSaysHowMuchTimeHasPassedMayBeDamagedOrMissing) {
  const SqliteStoreOptions limits{.edits = {.max_age_s = 600}};
  for (const char* damage : {"UPDATE seen_time SET seen_ns = seen_ns + 4611686018427387904", "DELETE FROM seen_time"}) {
    passed_ns_ = 0;
    Begin(AgedStore::kSqlite, limits);
    Edit("1", kNow_ns);
    passed_ns_ += 400 * kSecond_ns;
    Edit("2", kNow_ns);
    store_ = nullptr;
    Tamper(damage);
    OpenKind(AgedStore::kSqlite, limits);
    passed_ns_ += 100 * kSecond_ns;
    Edit("3", kNow_ns);
    EXPECT_EQ(Kept(), "3+ 2+ 1+ ") << damage;
    passed_ns_ += 200 * kSecond_ns;
    Edit("4", kNow_ns);
    EXPECT_EQ(Kept(), "4+ 3+ 2+ ") << damage;
  }
}

TEST_F(AgesTest, RowsOfAnOlderSchemaAreAsOldAsTheStepThatCountsThem) {
  const SqliteStoreOptions limits{.edits = {.max_age_s = 600}};
  Begin(AgedStore::kSqlite, limits);
  Edit("1", kNow_ns - 1000 * kDay_ns);
  store_ = nullptr;
  // As schema 13 had it: the row as version 1 of its checksum sealed it is read by released_test.
  Tamper("UPDATE edits SET seen_ns = 0; UPDATE changes SET seen_ns = 0; DELETE FROM seen_time");
  passed_ns_ = 5 * kDay_ns;
  OpenKind(AgedStore::kSqlite, limits);
  Edit("2", kNow_ns);
  const std::int64_t num_edits = Query("SELECT count(*) FROM edits");
  EXPECT_EQ(num_edits, 2);
  passed_ns_ += 601 * kSecond_ns;
  Edit("3", kNow_ns);
  EXPECT_EQ(Query("SELECT count(*) FROM edits"), 1) << "both are older than 600 s";
}

}  // namespace
}  // namespace dhpmap
