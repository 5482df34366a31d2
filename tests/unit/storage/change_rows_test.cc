// SPDX-License-Identifier: BSD-3-Clause
// Rows of changes in a database: what becomes of damaged ones, and of those of another history.
#include <fstream>

#include "storage/codec/change_codec.h"
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::ExpectDiscreet;
using testing::StoreKind;

class ChangeRowsTest : public AnyStoreTest {
 protected:
  void CommitSome(Map& map, int count) {
    for (int n = 0; n < count; ++n) {
      const auto before = map.published();
      generator_.Change(map);
      const Status committed = store_->Commit(*before, *map.Publish(100 + n), Durability::kNormal);
      ASSERT_TRUE(committed.ok()) << committed.ToString();
    }
  }
  Status ReadAll(std::int64_t after, std::int64_t* last = nullptr) {
    while (true) {
      const auto list = store_->ListChanges("house", after, 1);
      if (!list.ok()) return list.status();
      if (list->changes.empty()) return Status::Ok();
      after = list->changes.back()->last_revision;
      if (last != nullptr) *last = after;
    }
  }
};

/// By SQL of SQLite's own.
class ChangeRowsTestInAFile : public ChangeRowsTest {};

TEST_P(ChangeRowsTest, ADamagedOneIsSeenAndDoesTheMapNoHarm) {
  const std::string middle = " WHERE last_revision = 3";
  for (const std::string& change : std::vector<std::string>{
           "UPDATE changes SET blob = substr(blob, 1, 9)" + middle,
           "UPDATE changes SET blob = (SELECT blob FROM changes WHERE last_revision = 4)" + middle,
           "UPDATE changes SET first_revision = 2" + middle, "UPDATE changes SET previous_revision = 1" + middle,
           "UPDATE changes SET time_ns = 7" + middle, "UPDATE changes SET checksum = checksum + 1" + middle,
           "UPDATE changes SET checksum_version = 9" + middle, "DELETE FROM changes" + middle,
           "UPDATE changes SET last_revision = 77" + middle, "DELETE FROM changes WHERE last_revision = 6"}) {
    SCOPED_TRACE(change);
    BeginAnew();
    const auto map = CreateSample("house");
    CommitSome(*map, 5);
    ASSERT_TRUE(ReadAll(0).ok());
    store_ = nullptr;
    Tamper(change);
    Open();
    const Status read = ReadAll(0);
    EXPECT_EQ(read.code(), StatusCode::kDataLoss) << read.ToString();
    EXPECT_EQ(read.reason(), Reason("DAMAGED_CHANGES"));
    ExpectDiscreet(read, kept_.Path());
    ExpectStored(*map->published());
    CommitSome(*map, 2);
    ExpectStored(*map->published());
    EXPECT_TRUE(ReadAll(7).ok()) << "what is told after the damage";
    store_ = nullptr;
  }
}

TEST_P(ChangeRowsTest, WithoutAnIntactLogTheyBeginAnew) {
  for (const char* change : {"UPDATE change_logs SET complete_after = 1", "UPDATE change_logs SET num_bytes = 1",
                             "UPDATE change_logs SET history_id = 1", "UPDATE change_logs SET last_revision = 9",
                             "DELETE FROM change_logs"}) {
    SCOPED_TRACE(change);
    BeginAnew();
    const auto map = CreateSample("house");
    CommitSome(*map, 5);
    store_ = nullptr;
    Tamper(change);
    Open();
    EXPECT_FALSE(ReadAll(0).ok());
    ExpectStored(*map->published());
    CommitSome(*map, 1);
    EXPECT_EQ(ReadAll(5).reason(), Reason("COMPACTED"));
    std::int64_t last = 0;
    EXPECT_TRUE(ReadAll(6, &last).ok());
    EXPECT_EQ(last, 7);
    EXPECT_EQ(Query("SELECT count(*) FROM changes"), 1) << "what nobody can read is deleted";
    store_ = nullptr;
  }
}

TEST_P(ChangeRowsTestInAFile, AMapThatGoesOnFromABackupTellsNothingOfBefore) {
  Open();
  const auto map = CreateSample("house");
  CommitSome(*map, 3);
  auto backup = store_->Backup({});
  ASSERT_TRUE(backup.ok());
  std::string bytes;
  for (std::string part = *(*backup)->Read(1 << 20); !part.empty(); part = *(*backup)->Read(1 << 20)) bytes += part;
  store_ = nullptr;
  std::filesystem::remove(kept_.Path() + "-wal");
  std::ofstream(kept_.Path(), std::ios::binary) << bytes;
  Open();
  const auto list = store_->ListChanges("house", 4, 1);
  ASSERT_TRUE(list.ok()) << list.status().ToString();
  EXPECT_NE(list->history_id, map->info().history_id);
  EXPECT_EQ(list->complete_after, 4);
  EXPECT_EQ(ReadAll(3).reason(), Reason("COMPACTED"));
  const auto loaded = *store_->LoadMap("house");
  Map next(loaded);
  next.mutable_info().num_frames += 1;
  ASSERT_TRUE(store_->Commit(*loaded, *next.Publish(20), Durability::kNormal).ok());
  EXPECT_EQ(store_->ListChanges("house", 4, 1)->changes.size(), 1u);
  EXPECT_EQ(ReadAll(3).reason(), Reason("COMPACTED"));
}

TEST_P(ChangeRowsTestInAFile, TheyGoWithTheMap) {
  Open();
  CommitSome(*CreateSample("house"), 3);
  CommitSome(*CreateSample("other"), 3);
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  EXPECT_EQ(Query("SELECT count(*) FROM changes"), 4);
  EXPECT_EQ(Query("SELECT count(*) FROM change_logs"), 1);
}

TEST_P(ChangeRowsTest, WhatACrashLeavesOutIsNoGap) {
  Open();
  const auto map = CreateSample("house");
  CommitSome(*map, 1);
  ASSERT_TRUE(store_->Reserve("house", {50, SubmapId(90)}).ok());
  Open();  // without lowering them again
  const auto loaded = *store_->LoadMap("house");
  EXPECT_EQ(loaded->revision(), 51);
  EXPECT_EQ(store_->ListChanges("house", 2, 1)->revision, 51);
  EXPECT_TRUE(store_->ListChanges("house", 2, 1)->changes.empty());
  Map next(loaded);
  next.mutable_info().num_frames += 1;
  ASSERT_TRUE(store_->Commit(*loaded, *next.Publish(20), Durability::kNormal).ok());
  const auto list = store_->ListChanges("house", 2, 1);
  ASSERT_EQ(list->changes.size(), 1u);
  EXPECT_EQ(list->changes[0]->first_revision, 52);
}

TEST(ChangeCodec, GivesBackWhatItWasGivenAndNothingElse) {
  testing::MapGenerator generator(3);
  Map map(generator.Info("house"));
  for (int n = 0; n < 4; ++n) generator.AddSubmap(map, 5);
  const auto before = map.Publish(1);
  for (int n = 0; n < 6; ++n) generator.Change(map);
  map.mutable_info().display_name = "other";
  const auto after = map.Publish(2);
  const MapChange change = DescribeChange(*before, *after, DiffTiles(*before, *after));
  const Bytes blob = EncodeChange(change);
  MapChange read;
  read.last_revision = change.last_revision;
  ASSERT_TRUE(DecodeChange(blob, read).ok());
  EXPECT_EQ(read.display_name, change.display_name);
  ASSERT_EQ(read.submaps.size(), change.submaps.size());
  for (std::size_t i = 0; i < read.submaps.size(); ++i) {
    const SubmapEvent &expected = change.submaps[i], &actual = read.submaps[i];
    EXPECT_EQ(expected.kind, actual.kind);
    EXPECT_EQ(expected.parts, actual.parts);
    testing::ExpectSameInfo(expected.info, actual.info);
    EXPECT_EQ(expected.observed.radius_m, actual.observed.radius_m);
    EXPECT_EQ(expected.num_blocks, actual.num_blocks);
    EXPECT_EQ(expected.tiles, actual.tiles);
    EXPECT_EQ(expected.into, actual.into);
    ASSERT_EQ(expected.before.has_value(), actual.before.has_value());
    if (expected.before) {
      EXPECT_EQ(expected.before->sphere.center_m, actual.before->sphere.center_m);
    }
  }
  EXPECT_EQ(EncodeChange(read), blob);
  read.last_revision += 1;
  EXPECT_EQ(DecodeChange(blob, read).code(), StatusCode::kDataLoss) << "of another revision";
}

TEST(ChangeCodec, BoxesOfWhatWasMovedComeBackInABlobOfTheirOwnKind) {
  MapChange change;
  change.last_revision = 5;
  change.submaps.resize(2);
  EXPECT_EQ(EncodeChange(change)[0], 0x62);
  const Eigen::Vector3d low(-1, 0.25, 3), high(2, 4, 8);
  change.submaps[1].pose_boxes = PoseBoxes{{low, high}, {high, 2 * high}};
  const Bytes blob = EncodeChange(change);
  EXPECT_EQ(blob[0], 0x64);
  MapChange read;
  read.last_revision = 5;
  ASSERT_TRUE(DecodeChange(blob, read).ok());
  ASSERT_EQ(read.submaps.size(), 2u);
  EXPECT_FALSE(read.submaps[0].pose_boxes);
  ASSERT_TRUE(read.submaps[1].pose_boxes);
  EXPECT_EQ(read.submaps[1].pose_boxes->before_m.min(), low);
  EXPECT_EQ(read.submaps[1].pose_boxes->before_m.max(), high);
  EXPECT_EQ(read.submaps[1].pose_boxes->after_m.max(), 2 * high);
}

TEST(ChangeCodec, OnlyRegionsMakeABlobThatVersionsBeforeThemCannotRead) {
  MapChange change;
  change.first_revision = 4;
  change.last_revision = 5;
  change.display_name = "house";
  EXPECT_EQ(EncodeChange(change)[0], 0x62);
  change.regions = {{.kind = RegionEventKind::kKeptClear, .region = BoundingSphere{{1, 2, 3}, 0.5}, .name = "door"},
                    {.region = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3)),
                     .submap = SubmapId(3),
                     .classes = {ClassId(1), ClassId(65534)},
                     .num_voxels = 1'000'000}};
  const Bytes blob = EncodeChange(change);
  EXPECT_EQ(blob[0], 0x63);
  MapChange read;
  read.last_revision = 5;
  read.regions = {{.name = "of before"}};
  ASSERT_TRUE(DecodeChange(blob, read).ok());
  EXPECT_EQ(read.display_name, "house");
  ASSERT_EQ(read.regions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const RegionEvent &expected = change.regions[i], &actual = read.regions[i];
    EXPECT_EQ(expected.kind, actual.kind);
    EXPECT_TRUE(IsSame(expected.region, actual.region));
    EXPECT_EQ(expected.name, actual.name);
    EXPECT_EQ(expected.submap, actual.submap);
    EXPECT_EQ(expected.classes, actual.classes);
    EXPECT_EQ(expected.num_voxels, actual.num_voxels);
  }
  change.regions.clear();
  ASSERT_TRUE(DecodeChange(EncodeChange(change), read).ok());
  EXPECT_TRUE(read.regions.empty());
}

DHPMAP_ON_STORES_THAT_KEEP(ChangeRowsTest);
INSTANTIATE_TEST_SUITE_P(Stores, ChangeRowsTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
