// SPDX-License-Identifier: BSD-3-Clause
// What a store on PostgreSQL promises beyond any other: few round trips, and answers that got lost. Owners:
// owners_test.cc.
#include "storage/postgres_store.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "storage/postgres/commit/writer.h"
#include "storage/postgres/owners/map_ownership.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/schema.h"
#include "tests/support/cut_connection.h"
#include "tests/support/postgres_cluster.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::CutConnection;
using testing::ExpectSameMap;
using testing::MapGenerator;
using testing::PostgresCluster;

class PostgresStoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    schema_ = PostgresCluster::Get()->NewSchema();
  }
  std::unique_ptr<MapStore> Open(const std::string& url = PostgresCluster::Get()->Url()) {
    auto opened = OpenPostgresStore(url, {.schema = schema_, .max_connections = 3, .answer_s = 20});
    EXPECT_TRUE(opened.ok()) << opened.status().ToString();
    return opened.ok() ? std::move(opened).value() : nullptr;
  }
  std::unique_ptr<Map> Create(MapStore& store) {
    auto map = std::make_unique<Map>(generator_.Info("house"));
    for (int n = 0; n < 3; ++n) generator_.AddSubmap(*map, 8);
    const Status created = store.CreateMap(*map->Publish(11));
    EXPECT_TRUE(created.ok()) << created.ToString();
    return map;
  }
  /// Commits some change.
  Status Commit(MapStore& store, Map& map, std::int64_t time_ns) {
    const auto before = map.published();
    generator_.Change(map);
    return store.Commit(*before, *map.Publish(time_ns), Durability::kFull);
  }
  void ExpectStored(MapStore& store, const MapSnapshot& expected) {
    const auto loaded = store.LoadMap("house");
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    ExpectSameMap(expected, **loaded);
  }

  MapGenerator generator_{17};
  std::string schema_;
};

TEST_F(PostgresStoreTest, ACommitTakesTwoRoundTripsWhateverItHolds) {
  const std::string url = PostgresCluster::Get()->Url();
  ASSERT_NE(Open(), nullptr);  // makes the tables
  postgres::Pool pool({.url = url, .schema = schema_}, 1);
  postgres::Peers peers(1, 2, {});
  postgres::MapOwnership maps(pool, peers, {});
  const postgres::KeepingLimits limits;
  postgres::Writer writer(pool, maps, limits, std::chrono::seconds(20));
  Map map(generator_.Info("house"));
  generator_.AddSubmap(map, 4);
  ASSERT_TRUE(writer.Create(*map.Publish(1)).ok());
  for (const int num_submaps : {0, 1, 40}) {
    const auto before = map.published();
    map.mutable_info().num_frames += 1;
    for (int n = 0; n < num_submaps; ++n) generator_.AddSubmap(map, 20);
    const std::int64_t trips_before = pool.num_round_trips();
    const Status done = writer.Commit({StateMarks(*before), *map.Publish(2)});
    ASSERT_TRUE(done.ok()) << done.ToString();
    EXPECT_EQ(pool.num_round_trips() - trips_before, 2) << num_submaps;
  }
  const auto before = map.published();
  map.FindMutable(SubmapId(2))->mutable_info().display_name = "edited";
  const auto after = map.Publish(3);
  const EditRecord edit{.entry = {after->revision(), 3, {.request_id = "1"}, {}}, .answer = "done", .before = before};
  const std::int64_t trips_before = pool.num_round_trips();
  ASSERT_TRUE(writer.Commit({StateMarks(*before), *after, &edit}).ok());
  EXPECT_EQ(pool.num_round_trips() - trips_before, 2) << "an edit with its log and what undoes it";
}

TEST_F(PostgresStoreTest, ACommitContinuesAfterAllConnectionsWereCut) {
  const auto store = Open();
  const auto map = Create(*store);
  PostgresCluster::Get()->CutConnections();
  const Status done = Commit(*store, *map, 20);
  EXPECT_TRUE(done.ok()) << done.ToString();
  PostgresCluster::Get()->CutConnections();
  ExpectStored(*store, *map->published());
}

TEST_F(PostgresStoreTest, ACommitWhoseAnswerWasLostIsFoundToBeMade) {
  CutConnection between(PostgresCluster::Get()->Folder());
  const auto store = Open(between.Url());
  const auto map = Create(*store);
  for (int n = 0; n < 5; ++n) {
    const std::int64_t revision = map->published()->revision();
    between.LoseNextCommitsAnswer();
    const Status done = Commit(*store, *map, 20 + n);
    EXPECT_TRUE(done.ok()) << done.ToString();
    EXPECT_EQ(between.num_lost(), n + 1) << "no answer was lost: this shows nothing";
    EXPECT_EQ(store->GetMap("house")->info.revision, revision + 1);
  }
  ExpectStored(*store, *map->published());
  EXPECT_EQ(store->ListChanges("house", 0, 1 << 20)->changes.size(), 6u) << "each is there once";
}

TEST_F(PostgresStoreTest, AMapWhoseCreationsAnswerWasLostIsThereOnce) {
  CutConnection between(PostgresCluster::Get()->Folder());
  const auto store = Open(between.Url());
  between.LoseNextCommitsAnswer();
  const auto map = Create(*store);
  EXPECT_EQ(between.num_lost(), 1);
  ExpectStored(*store, *map->published());
  EXPECT_EQ(store->CreateMap(*map->published()).code(), StatusCode::kAlreadyExists);
}

/// A store whose database made a commit and is away since: for longer than the store waits.
class CommitInDoubt : public PostgresStoreTest {
 protected:
  void SetUp() override {
    PostgresStoreTest::SetUp();
    if (IsSkipped()) return;
    between_ = std::make_unique<CutConnection>(PostgresCluster::Get()->Folder());
    auto opened =
        OpenPostgresStore(between_->Url(), {.schema = schema_, .max_connections = 3, .answer_s = kPatience_s});
    ASSERT_TRUE(opened.ok()) << opened.status().ToString();
    store_ = std::move(opened).value();
    map_ = Create(*store_);
    before_ = map_->published();
    between_->LoseNextCommitsAnswer();
    between_->GoAway();
  }
  static constexpr double kPatience_s = 1;
  std::unique_ptr<CutConnection> between_;
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<Map> map_;
  std::shared_ptr<const MapSnapshot> before_;
};

TEST_F(CommitInDoubt, IsAcknowledgedWhenItIsTriedAgain) {
  EXPECT_EQ(Commit(*store_, *map_, 20).code(), StatusCode::kUnavailable);
  between_->ComeBack();
  const Status again = store_->Commit(*before_, *map_->published(), Durability::kFull);
  EXPECT_TRUE(again.ok()) << again.ToString();
  ExpectStored(*store_, *map_->published());
  EXPECT_EQ(store_->ListChanges("house", 0, 1 << 20)->changes.size(), 2u) << "made once";
}

TEST_F(CommitInDoubt, IsGoneOnFromByALaterState) {
  EXPECT_EQ(Commit(*store_, *map_, 20).code(), StatusCode::kUnavailable);
  between_->ComeBack();
  generator_.Change(*map_);
  const auto later = map_->Publish(30);
  const Status done = store_->Commit(*before_, *later, Durability::kFull);
  EXPECT_TRUE(done.ok()) << done.ToString();
  ExpectStored(*store_, *later);
  EXPECT_TRUE(Commit(*store_, *map_, 40).ok());
  ExpectStored(*store_, *map_->published());
}

TEST_F(CommitInDoubt, IsNotTakenForAnotherStateOfItsRevision) {
  EXPECT_EQ(Commit(*store_, *map_, 20).code(), StatusCode::kUnavailable);
  const auto made = map_->published();
  between_->ComeBack();
  Map other(before_);  // as it was loaded before the commit was to be seen
  other.mutable_info().display_name = "other";
  EXPECT_EQ(Commit(*store_, other, 30).reason(), Reason("STALE_REVISION"));
  ASSERT_EQ(other.published()->revision(), made->revision());
  ExpectStored(*store_, *made);
}

TEST_F(PostgresStoreTest, AConnectionWhoseReaderThrewIsNotUsedAgain) {
  auto connection = postgres::Connection::Open({.url = PostgresCluster::Get()->Url()});
  ASSERT_TRUE(connection.ok()) << connection.status().ToString();
  const std::string sql = "SELECT generate_series(1, 3)";
  const auto read = [&] {
    return connection->Stream({&sql}, "count", [](postgres::Answer&) -> Status { throw std::bad_alloc(); });
  };
  EXPECT_THROW((void)read(), std::bad_alloc);
  EXPECT_TRUE(connection->IsBroken()) << "the next statement would get the rest of the answer";
}

TEST_F(CommitInDoubt, OfAnEditThatItsMapHasDroppedEndsTheMapsCommits) {
  map_->mutable_info().display_name = "edited";
  const auto after = map_->Publish(20);
  const EditRecord edit{.entry = {after->revision(), 20, {.request_id = "1"}, {}}, .answer = "done", .before = before_};
  EXPECT_EQ(store_->CommitEdit(*before_, *after, edit).code(), StatusCode::kUnavailable);
  between_->ComeBack();
  for (int n = 0; n < 2; ++n) {
    Map without(before_);
    EXPECT_EQ(Commit(*store_, without, 30).reason(), Reason("STALE_REVISION")) << "it would undo what is in the log";
  }
  EXPECT_TRUE(store_->FindAnswer("house", "1")->has_value());
  ExpectStored(*store_, *after);
}

TEST_F(PostgresStoreTest, ReservedNumbersAreLeftByTheNextOwner) {
  auto first = Open();
  const auto map = Create(*first);
  const MapInfo info = map->published()->info();
  ASSERT_TRUE(first->Reserve("house", {info.revision + 5, SubmapId(40)}).ok());
  first.reset();
  const auto second = Open();
  const auto loaded = second->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  EXPECT_EQ((*loaded)->revision(), info.revision + 6);
  EXPECT_EQ((*loaded)->info().next_submap_id, SubmapId(40));
  const auto stored = second->GetMap("house");
  ASSERT_TRUE(stored.ok());
  ASSERT_EQ(stored->lost_revisions.size(), 1u);
  EXPECT_EQ(stored->lost_revisions[0].first, info.revision + 1);
  EXPECT_EQ(stored->lost_revisions[0].last, info.revision + 5);
}

TEST_F(PostgresStoreTest, AQueryAfterSingleRowModeIsAnsweredCompletely) {
  postgres::ConnectionOptions options;
  options.url = PostgresCluster::Get()->Url();
  auto connection = postgres::Connection::Open(options);
  ASSERT_TRUE(connection.ok()) << connection.status().ToString();
  const std::string numbers = "SELECT n FROM generate_series(1, 3) AS n";
  for (int round = 0; round < 3; ++round) {
    std::int64_t sum = 0;
    const Status streamed = connection->Stream({&numbers}, "count", [&sum](postgres::Answer& row) {
      sum += row.Int();
      return Status::Ok();
    });
    ASSERT_TRUE(streamed.ok()) << streamed.ToString();
    EXPECT_EQ(sum, 6);
    const auto asked = connection->Query({&numbers}, "count");
    ASSERT_TRUE(asked.ok()) << asked.status().ToString();
    EXPECT_EQ(asked->num_rows(), 3) << "in round " << round;
  }
}

TEST_F(PostgresStoreTest, IsNotBackedUpAsAFile) {
  EXPECT_EQ(Open()->Backup({}).status().reason(), Reason("NOT_A_FILE"));
}

TEST_F(PostgresStoreTest, ErrorsShowNoConnectionString) {
  const auto opened = OpenPostgresStore("postgresql://anna:secret@/nowhere?host=/no/such/folder");
  ASSERT_EQ(opened.status().code(), StatusCode::kUnavailable);
  for (const char* word : {"anna", "secret", "nowhere", "folder"}) {
    EXPECT_EQ(opened.status().ToString().find(word), std::string::npos) << opened.status().ToString();
  }
}

}  // namespace
}  // namespace dhpmap
