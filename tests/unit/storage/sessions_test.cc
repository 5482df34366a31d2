// SPDX-License-Identifier: BSD-3-Clause
// How far clients' sessions have got is stored with their frames, or not at all.
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::StoreKind;

class SessionsTest : public AnyStoreTest {
 protected:
  /// Commits the map with `mark` set, and nothing else changed but the number of frames.
  void CommitMark(Map& map, SessionMark mark) {
    const auto before = map.published();
    map.mutable_info().num_frames += 1;
    map.mutable_info().sessions.Set(std::move(mark));
    const Status committed = store_->Commit(*before, *map.Publish(30), Durability::kNormal);
    ASSERT_TRUE(committed.ok()) << committed.ToString();
  }
};

/// By SQL of SQLite's own.
class SessionsTestInAFile : public SessionsTest {};

TEST_P(SessionsTest, ComeBackWithTheFramesOfTheirCommit) {
  Open();
  const auto map = CreateSample("house");
  const auto other = CreateSample("other");
  for (std::int64_t i = 0; i < 5; ++i) CommitMark(*map, {"robot", 10 * i, i});
  CommitMark(*map, {"zeta", -5, 99});
  Open();
  ExpectStored(*map->published());
  ExpectStored(*other->published());
  EXPECT_EQ(store_->GetMap("house")->info.sessions.LastOf("robot"), 40);
  EXPECT_EQ(store_->GetMap("house")->info.sessions.LastOf("zeta"), -5);
  EXPECT_EQ((*store_->ListMaps())[0].info.sessions, map->info().sessions);
}

TEST_P(SessionsTestInAFile, OnlyTheOneThatMovedIsWritten) {
  Open();
  const auto map = CreateSample("house");
  for (const char* name : {"a", "b", "c"}) CommitMark(*map, {name, 1, 1});
  Tamper(
      "CREATE TABLE written (what TEXT);"
      "CREATE TRIGGER a AFTER INSERT ON feed_sessions BEGIN INSERT INTO written VALUES (NEW.session); END;"
      "CREATE TRIGGER b AFTER UPDATE ON feed_sessions BEGIN INSERT INTO written VALUES (NEW.session); END;");
  CommitMark(*map, {"b", 2, 2});
  EXPECT_EQ(Query("SELECT count(*) FROM written"), 1);
  EXPECT_EQ(Query("SELECT count(*) FROM written WHERE what = 'b'"), 1);
  ExpectStored(*map->published());
}

TEST_P(SessionsTest, OfTooManyTheLongestUnusedIsErased) {
  Open();
  const auto map = CreateSample("house");
  const auto before = map->published();
  for (std::size_t i = 0; i < SessionMarks::kMost; ++i) {
    map->mutable_info().sessions.Set({"s" + std::to_string(i), 1, static_cast<std::int64_t>(10 + i)});
  }
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(40), Durability::kNormal).ok());
  CommitMark(*map, {"new", 3, 10'000'000'000'000'000});
  EXPECT_EQ(Query("SELECT count(*) FROM feed_sessions"), static_cast<std::int64_t>(SessionMarks::kMost));
  Open();
  ExpectStored(*map->published());
  EXPECT_EQ(store_->GetMap("house")->info.sessions.LastOf("new"), 3);
}

TEST_P(SessionsTest, AnyChangeBehindOurBackIsDamage) {
  for (const char* change :
       {"UPDATE feed_sessions SET sequence = sequence + 1", "UPDATE feed_sessions SET time_ns = 1",
        "UPDATE feed_sessions SET session = session || 'x'", "DELETE FROM feed_sessions WHERE session = 'Robot.2'",
        "DELETE FROM feed_sessions", "INSERT INTO feed_sessions SELECT map_key, 'new', 1, 2 FROM maps",
        "UPDATE maps SET sessions_checksum = 0", "UPDATE maps SET checksum_version = 2"}) {
    BeginAnew();
    CreateSample("house");
    store_ = nullptr;
    Tamper(change);
    Open();
    EXPECT_EQ(store_->LoadMap("house").status().code(), StatusCode::kDataLoss) << change;
    EXPECT_EQ(store_->ListMaps()->at(0).damage.code(), StatusCode::kDataLoss) << change;
    store_ = nullptr;
  }
}

TEST_P(SessionsTestInAFile, StayWhenNumbersAreReservedOrGoOnAboveTheirMarks) {
  Open();
  const auto map = CreateSample("house");
  ASSERT_TRUE(store_->Reserve("house", {.revision = 500, .next_submap_id = SubmapId(70)}).ok());
  ExpectStored(*map->published());
  Open();
  EXPECT_EQ(store_->GetMap("house")->info.revision, 501);
  EXPECT_EQ(store_->GetMap("house")->info.sessions, map->info().sessions);
}

DHPMAP_ON_STORES_THAT_KEEP(SessionsTest);
INSTANTIATE_TEST_SUITE_P(Stores, SessionsTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
