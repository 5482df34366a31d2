// SPDX-License-Identifier: BSD-3-Clause
// Tiles in the SQLite store: what clones and moves cost, and what becomes of blobs that nothing refers to.
#include <algorithm>
#include <set>
#include <vector>

#include "storage/rows/tile_rows.h"
#include "tests/support/eventually.h"
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::StoreKind;

class TilesTest : public AnyStoreTest {
 protected:
  std::int64_t NumBlobs() { return Query("SELECT count(*) FROM tile_blobs"); }
  std::int64_t NewestBlob() { return Query("SELECT coalesce(max(blob_key), 0) FROM tile_blobs"); }

  void Commit(Map& map) {
    const auto before = map.published();
    const Status committed = store_->Commit(*before, *map.Publish(++time_ns_), Durability::kNormal);
    ASSERT_TRUE(committed.ok()) << committed.ToString();
    ExpectStored(*map.published());
    const auto report = store_->VerifyMap(map.info().name, false, {});
    ASSERT_TRUE(report.ok()) << report.status().ToString();
    EXPECT_EQ(report->num_faults, 0) << report->faults[0].place << " " << report->faults[0].what;
    if (GetParam() == StoreKind::kSqlite) ExpectRightCounts();
  }

  /// The tables of shared and dead blobs against what follows from the rows.
  void ExpectRightCounts() {
    EXPECT_EQ(
        Query("SELECT count(*) FROM tiles LEFT JOIN tile_blobs USING (blob_key) WHERE tile_blobs.blob_key IS NULL"), 0)
        << "missing";
    EXPECT_EQ(Query("SELECT count(*) FROM (SELECT blob_key, count(*) - 1 AS num_more FROM tiles GROUP BY blob_key "
                    "HAVING num_more > 0 EXCEPT SELECT blob_key, num_more FROM shared_blobs)"),
              0);
    EXPECT_EQ(
        Query("SELECT count(*) FROM (SELECT blob_key, num_more FROM shared_blobs EXCEPT SELECT blob_key, count(*) "
              "- 1 FROM tiles GROUP BY blob_key)"),
        0);
    EXPECT_EQ(Query("SELECT count(*) FROM tile_blobs b WHERE NOT EXISTS (SELECT 1 FROM tiles t WHERE t.blob_key = "
                    "b.blob_key) AND NOT EXISTS (SELECT 1 FROM dead_blobs d WHERE d.blob_key = b.blob_key)"),
              0)
        << "orphans";
    EXPECT_EQ(Query("SELECT count(*) FROM dead_blobs WHERE blob_key IN (SELECT blob_key FROM tiles)"), 0);
  }

  /// Until the store has deleted what nothing refers to.
  void AwaitCollection() {
    EXPECT_TRUE(testing::Eventually([this] { return Query("SELECT count(*) FROM dead_blobs") == 0; }));
    ExpectRightCounts();
  }

  std::int64_t time_ns_ = 100;
};

/// By SQL of SQLite's own.
class TilesTestInAFile : public TilesTest {};

TEST_P(TilesTestInAFile, ACloneIsRowsAndNoBlob) {
  Open();
  const auto map = CreateSample("house");
  const std::int64_t newest = NewestBlob();
  map->Clone(SubmapId(2));
  Commit(*map);
  EXPECT_EQ(NewestBlob(), newest);
  EXPECT_EQ(Query("SELECT count(*) FROM shared_blobs"),
            Query("SELECT count(*) FROM tiles JOIN submaps ON owner_key = submap_key WHERE submap_id = 2"));

  // The same from a state that was loaded, and of a clone of a clone.
  Open();
  const auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok());
  Map again(*loaded);
  const SubmapId clone = again.Clone(SubmapId(4))->id();
  again.Clone(clone);
  again.Clone(clone);
  Commit(again);
  EXPECT_EQ(NewestBlob(), newest);
}

TEST_P(TilesTest, ALoadedCloneSharesItsTilesInMemoryToo) {
  Open();
  const auto map = CreateSample("house");
  map->Clone(SubmapId(2));
  Commit(*map);
  const auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok());
  const BlockTable &one = (*loaded)->Find(SubmapId(2))->blocks(), &other = (*loaded)->submaps().back()->blocks();
  ASSERT_FALSE(one.tiles().empty());
  for (const TileEntry& entry : one.tiles()) EXPECT_EQ(other.FindTile(entry.index)->tile, entry.tile);
}

TEST_P(TilesTest, AMoveWritesNoTile) {
  Open();
  const auto map = CreateSample("house");
  const std::int64_t newest = NewestBlob();
  map->FindMutable(SubmapId(2))->mutable_info().T_map_submap.translation().x() += 1;
  Commit(*map);
  EXPECT_EQ(NewestBlob(), newest);
}

TEST_P(TilesTest, AWrittenCloneGetsBlobsOfItsOwnForWhatWasWritten) {
  Open();
  const auto map = CreateSample("house");
  const SubmapId clone = map->Clone(SubmapId(2))->id();
  Commit(*map);
  const std::int64_t newest = NewestBlob();
  Submap& submap = *map->FindMutable(clone);
  submap.MutableLabels(submap.blocks().entries().front().index).AddObservation(0, ClassId(9));
  Commit(*map);
  EXPECT_EQ(NewestBlob(), newest + 1) << "its labels, not its TSDF";
  // The rest goes on to be known as stored: a clone of it needs no new blob.
  map->Clone(clone);
  Commit(*map);
  EXPECT_EQ(NewestBlob(), newest + 1);
}

TEST_P(TilesTest, AnObjectThatIsWrittenAndClonedInOneCommitIsStoredOnce) {
  Open();
  const auto map = CreateSample("house");
  const std::int64_t newest = NewestBlob();
  Submap& submap = *map->FindMutable(SubmapId(2));
  submap.MutableTsdf(submap.blocks().entries().front().index).weight[0] += 1;
  map->Clone(SubmapId(2));
  Commit(*map);
  EXPECT_EQ(NewestBlob(), newest + 1);
}

TEST_P(TilesTest, AnObjectMayBeClonedWrittenAndRemovedInOneCommit) {
  Open();
  const auto map = CreateSample("house");
  const std::int64_t newest = NewestBlob();
  const SubmapId clone = map->Clone(SubmapId(2))->id();
  const BlockIndex block = map->Find(clone)->blocks().entries().front().index;
  map->FindMutable(clone)->MutableLabels(block).AddObservation(0, ClassId(9));
  map->FindMutable(SubmapId(2))->MutableTsdf(block).weight[0] += 1;
  map->Clone(clone);
  map->Remove(SubmapId(2));
  Commit(*map);
  EXPECT_EQ(NewestBlob(), newest + 1) << "the labels of the clone and its clone";
}

TEST_P(TilesTestInAFile, BlobsAreDeletedWhenTheLastOfTheirObjectsHasGone) {
  Open();
  const auto map = CreateSample("house");
  const SubmapId clone = map->Clone(SubmapId(2))->id();
  Commit(*map);
  const std::int64_t num_blobs = NumBlobs();
  map->Remove(SubmapId(2));
  Commit(*map);
  AwaitCollection();
  EXPECT_EQ(NumBlobs(), num_blobs) << "the clone still has them";
  EXPECT_EQ(Query("SELECT count(*) FROM shared_blobs"), 0);
  const std::int64_t num_tiles =
      Query("SELECT count(*) FROM tiles WHERE owner_key = (SELECT max(submap_key) FROM submaps)");
  map->Remove(clone);
  Commit(*map);
  AwaitCollection();
  EXPECT_EQ(NumBlobs(), num_blobs - num_tiles);
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  AwaitCollection();
  EXPECT_EQ(NumBlobs(), 0);
}

TEST_P(TilesTestInAFile, WhatWasRemovedComesBackFromMemoryCollectedOrNot) {
  for (const bool is_collected : {false, true}) {
    SCOPED_TRACE(is_collected);
    const std::string name = is_collected ? "house" : "barn";
    Open();
    const auto map = CreateSample(name);
    Map fork = map->Fork();
    map->Remove(SubmapId(2));
    Commit(*map);
    if (is_collected) AwaitCollection();
    // The state of before once more, as after a frame that failed: its tiles name keys of blobs that may be no more.
    const auto before = map->published();
    fork.mutable_info() = before->info();
    fork.mutable_info().num_frames += 1;
    const Status committed = store_->Commit(*before, *fork.Publish(++time_ns_), Durability::kNormal);
    ASSERT_TRUE(committed.ok()) << committed.ToString();
    ExpectStored(*fork.published());
    ExpectRightCounts();
    AwaitCollection();
    ExpectStored(*fork.published());
  }
}

TEST_P(TilesTestInAFile, ACommitThatFailsLeavesNoKeysBehind) {
  Open();
  const auto map = CreateSample("house");
  const auto before = map->published();
  generator_.AddBlocks(*map->FindMutable(SubmapId(1)), 3);
  const auto after = map->Publish(++time_ns_);
  Tamper("CREATE TRIGGER stop BEFORE UPDATE OF tiles_sum ON submaps BEGIN SELECT RAISE(ABORT, 'no'); END");
  ASSERT_FALSE(store_->Commit(*before, *after, Durability::kNormal).ok());
  Tamper("DROP TRIGGER stop");
  // Its keys are given out to other tiles now; a clone of what failed must not refer to those.
  generator_.AddBlocks(*map->FindMutable(SubmapId(3)), 4);
  map->Clone(SubmapId(1));
  const auto next = map->Publish(++time_ns_);
  ASSERT_TRUE(store_->Commit(*before, *next, Durability::kNormal).ok());
  ExpectStored(*next);
  ExpectRightCounts();
}

TEST_P(TilesTestInAFile, AStoreDoesNotTakeTheKeysOfAnother) {
  Open();
  const auto map = CreateSample("house");
  auto other = OpenSqliteStore(kept_.Path() + ".other");
  ASSERT_TRUE(other.ok());
  Map filler(generator_.Info("filler"));
  generator_.AddSubmap(filler, 40);
  ASSERT_TRUE((*other)->CreateMap(*filler.Publish(1)).ok());
  ASSERT_TRUE((*other)->CreateMap(*map->published()).ok());
  const auto loaded = (*other)->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  testing::ExpectSameMap(*map->published(), **loaded);
}

TEST_P(TilesTest, RandomHistoriesKeepTheCountsOfReferencesRight) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Open();
    testing::MapGenerator generator(seed);
    Map map(generator.Info("map-" + std::to_string(seed)));
    generator.AddSubmap(map, 6);
    ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
    for (int step = 0; step < 20; ++step) {
      generator.Change(map);
      if (generator.Below(3) == 0) map.Clone(map.submaps().back()->id());
      Commit(map);
      if (HasFatalFailure()) return;
    }
    if (GetParam() != StoreKind::kSqlite) continue;  // the other collects after a grace
    AwaitCollection();
    EXPECT_EQ(NumBlobs(), Query("SELECT count(DISTINCT blob_key) FROM tiles"));
  }
}

TEST_P(TilesTestInAFile, CommitsHelpWhereManyBlobsAreDead) {
  Open();
  store_ = nullptr;  // and its collector with it
  auto database = sqlite::Database::Open(kept_.Path(), sqlite::OpenMode::kReadWrite, 1000);
  ASSERT_TRUE(database.ok());
  const auto num_dead = [&] { return database->QueryInt("SELECT count(*) FROM dead_blobs", "look").value(); };
  const auto fill = [&](std::int64_t count) {
    const std::string numbers =
        "WITH RECURSIVE n(i) AS (VALUES (1) UNION ALL SELECT i + 1 FROM n WHERE i < " + std::to_string(count) + ") ";
    EXPECT_TRUE(database
                    ->Execute("DELETE FROM dead_blobs; DELETE FROM tile_blobs; INSERT INTO tile_blobs "
                              "(blob_key, num_blocks, blob) " +
                                  numbers +
                                  "SELECT i, 1, x'00' FROM n; INSERT INTO dead_blobs SELECT blob_key FROM tile_blobs",
                              "fill")
                    .ok());
  };
  fill(kMaxBacklog);
  ASSERT_TRUE(CollectBacklog(*database, 100).ok());
  EXPECT_EQ(num_dead(), kMaxBacklog) << "few enough for the collector";
  fill(kMaxBacklog + 500);
  ASSERT_TRUE(CollectBacklog(*database, 100).ok());
  EXPECT_EQ(num_dead(), kMaxBacklog + 300) << "more than the commit made";
  EXPECT_EQ(database->QueryInt("SELECT count(*) FROM tile_blobs", "look").value(), kMaxBacklog + 300);
}

TEST_P(TilesTestInAFile, AKeyIsNeverGivenOutAgain) {
  Open();
  const auto map = CreateSample("house");
  const std::int64_t newest = NewestBlob();
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  AwaitCollection();
  Open();
  CreateSample("house");
  EXPECT_EQ(Query("SELECT min(blob_key) FROM tile_blobs"), newest + 1);
}

TEST_P(TilesTestInAFile, ACommitReadsNoMoreTilesThanItWrites) {
  Open();
  Map map(generator_.Info("house"));
  const SubmapId large = generator_.AddSubmap(map, 0).id();
  for (int x = 0; x < 60; ++x) generator_.FillTsdf(map.FindMutable(large)->MutableTsdf({4 * x, 0, 0}), 0.2);
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  // What else is stored of the object may be damaged: nobody looks at it, or counts it.
  Tamper("DELETE FROM tile_blobs WHERE blob_key <> (SELECT blob_key FROM tiles WHERE x = 7)");
  const auto before = map.published();
  map.FindMutable(large)->MutableTsdf({28, 0, 0}).weight[0] += 1;
  const Status committed = store_->Commit(*before, *map.Publish(2), Durability::kNormal);
  EXPECT_TRUE(committed.ok()) << committed.ToString();
  EXPECT_EQ(Query("SELECT num_tsdf_blocks FROM submaps WHERE submap_id = 1"), 60);
}

DHPMAP_ON_STORES_THAT_KEEP(TilesTest);
INSTANTIATE_TEST_SUITE_P(Stores, TilesTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
