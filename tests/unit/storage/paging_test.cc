// SPDX-License-Identifier: BSD-3-Clause
// Maps whose voxels stay in the file or the database until somebody reads them, against the same maps read as a whole.
#include <memory>
#include <string>

#include "mapping/base/status_error.h"
#include "mapping/paging/tile_page.h"
#include "tests/support/diff_snapshots.h"
#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::MapsAreEqual;
using testing::StoreKind;

/// Why the voxels of a submap cannot be read, or OK.
Status ReadVoxelsOf(const Submap& submap) {
  try {
    for (const BlockEntry& entry : submap.blocks().entries())
      EXPECT_TRUE(entry.tsdf != nullptr || entry.gone != nullptr);
    return Status::Ok();
  } catch (const StatusError& error) {
    return error.status();
  }
}

class PagingTest : public AnyStoreTest {
 protected:
  void OpenPaged() { Open(); }
  /// A condition on rows of table tiles, of a store with one map.
  [[nodiscard]] std::string IsOfSubmap(int id) const {
    const std::string number = std::to_string(id);
    return kept_.IsPostgres() ? "owner_id = " + number
                              : "owner_key = (SELECT submap_key FROM submaps WHERE submap_id = " + number + ")";
  }
  /// An expression of bytes as a blob.
  [[nodiscard]] std::string AsBlob(const std::string& bytes) const {
    return "CAST(" + bytes + " AS " + (kept_.IsPostgres() ? "bytea" : "BLOB") + ")";
  }
  std::shared_ptr<const MapSnapshot> Load() {
    auto loaded = store_->LoadMap("house");
    EXPECT_TRUE(loaded.ok()) << loaded.status().ToString();
    return loaded.ok() ? *loaded : nullptr;
  }
  /// As it is when it is read as a whole.
  std::shared_ptr<const MapSnapshot> MakeSample() {
    Open({.reads_all = true});
    CreateSample("house");
    return Load();
  }
  /// What a state says of the second submap when first its blobs and then its rows were lost.
  void ExpectLost(const std::string& lose_rows) {
    MakeSample();
    OpenPaged();
    const auto held = Load();
    Tamper("DELETE FROM tile_blobs WHERE blob_key IN (SELECT blob_key FROM tiles WHERE " + IsOfSubmap(2) + ")");
    Tamper(lose_rows);
    const Status status = ReadVoxelsOf(*held->Find(SubmapId(2)));
    EXPECT_EQ(status.code(), StatusCode::kDataLoss) << status.ToString();
    EXPECT_EQ(status.reason(), Reason("DAMAGED_MAP"));
  }
  static std::uint64_t NumReads() { return CountPages().num_reads; }
  static std::int64_t ResidentBytes() { return CountPages().resident_bytes; }
};
INSTANTIATE_TEST_SUITE_P(Stores, PagingTest, ::testing::ValuesIn(testing::StoresThatPage()), testing::NameOfKind);

/// What a file alone has: opening for reading, blobs that go with the commit that drops them, and a repair after which
/// a held state finds other rows than its own.
class PagingTestInAFile : public PagingTest {};
INSTANTIATE_TEST_SUITE_P(Stores, PagingTestInAFile, ::testing::Values(StoreKind::kPaged), testing::NameOfKind);

TEST_P(PagingTestInAFile, AMapOpensWithoutVoxelsAndHasTheSame) {
  const auto whole = MakeSample();
  for (const bool read_only : {false, true}) {
    store_ = nullptr;
    store_ = OpenSqliteStore(kept_.Path(), {.read_only = read_only, .pages_tiles = true}).value();
    const std::uint64_t before = NumReads();
    const auto paged = Load();
    const StateMarks marks(*paged);
    EXPECT_TRUE(DiffTiles(marks, *paged).empty());
    std::size_t num_tiles = 0;
    for (std::size_t s = 0; s < whole->submaps().size(); ++s) {
      const Submap &a = *whole->submaps()[s], &b = *paged->submaps()[s];
      EXPECT_EQ(a.blocks().size(), b.blocks().size());
      for (const TileEntry& tile : a.blocks().tiles()) {
        const BlockTile& other = *b.blocks().FindTile(tile.index)->tile;
        for (const auto layer : {BlockLayer::kTsdf, BlockLayer::kLabels, BlockLayer::kGone}) {
          EXPECT_EQ(other.CellsWith(layer), tile.tile->CellsWith(layer));
        }
        ++num_tiles;
      }
    }
    EXPECT_EQ(NumReads(), before) << "nobody has asked for a voxel";
    EXPECT_TRUE(MapsAreEqual(*whole, *paged));
    EXPECT_EQ(NumReads(), before + num_tiles) << "each once";
    for (const auto& submap : paged->submaps()) {
      for (const BlockEntry& entry : submap->blocks().entries()) EXPECT_TRUE(marks.Has(submap->id(), entry));
    }
  }
}

TEST_P(PagingTest, WhatWasReadGoesOnRequestFirstWhatNobodyUsed) {
  MakeSample();
  OpenPaged();
  const std::int64_t before = ResidentBytes();
  Map map(Load());
  const StateMarks marks(*map.published());
  ASSERT_TRUE(ReadVoxelsOf(*map.Find(SubmapId(1))).ok());
  const std::int64_t of_one = ResidentBytes() - before;
  EXPECT_GT(of_one, 0);
  EXPECT_EQ(map.EvictPages(false), map.published());
  EXPECT_EQ(ResidentBytes() - before, of_one) << "somebody has just used it";
  ASSERT_TRUE(ReadVoxelsOf(*map.Find(SubmapId(2))).ok());
  const std::int64_t of_both = ResidentBytes() - before;
  EXPECT_GT(of_both, of_one);
  map.EvictPages(false);
  EXPECT_EQ(ResidentBytes() - before, of_both - of_one) << "of the first nobody has asked since";
  auto held = map.published();
  ASSERT_TRUE(ReadVoxelsOf(*held->submaps()[1]).ok());
  const auto same = map.EvictPages(true);
  EXPECT_EQ(same, map.published());
  EXPECT_NE(same, held);
  EXPECT_EQ(same->revision(), held->revision());
  EXPECT_GT(ResidentBytes(), before) << "of who holds the state";
  EXPECT_TRUE(DiffTiles(marks, *same).empty()) << "the same parts";
  EXPECT_TRUE(DiffSnapshots(held.get(), *same).empty());
  held = nullptr;
  EXPECT_EQ(ResidentBytes(), before);
}

TEST_P(PagingTest, ATileThatCannotBeReadIsAnErrorOfWhoAsksForItAlone) {
  const auto whole = MakeSample();
  OpenPaged();
  const auto paged = Load();
  const std::string of_a_tile =
      " WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE layer = 1 AND " + IsOfSubmap(2) + ")";
  Tamper("UPDATE tile_blobs SET blob = " + AsBlob("blob || x'00'") + of_a_tile);
  for (int n = 0; n < 2; ++n) {
    const Status status = ReadVoxelsOf(*paged->Find(SubmapId(2)));
    EXPECT_EQ(status.code(), StatusCode::kDataLoss);
    EXPECT_EQ(status.reason(), Reason("DAMAGED_MAP"));
    EXPECT_NE(status.message().find("map 'house': submap 2: tsdf tile ("), std::string::npos) << status.message();
    testing::ExpectDiscreet(status, kept_.Path());
  }
  for (const auto id : {1u, 3u}) EXPECT_TRUE(ReadVoxelsOf(*paged->Find(SubmapId(id))).ok());
  Map map(paged);
  EXPECT_THROW(map.FindMutable(SubmapId(2))->DropLabels(), StatusError);
  Tamper("UPDATE tile_blobs SET blob = " + AsBlob("substr(blob, 1, length(blob) - 1)") + of_a_tile);
  EXPECT_TRUE(MapsAreEqual(*whole, *paged)) << "it is tried again";
}

TEST_P(PagingTest, WhatCannotBeReadKeepsNoCommitWaiting) {
  MakeSample();
  OpenPaged();
  Map map(Load());
  Tamper("DELETE FROM tile_blobs WHERE blob_key IN (SELECT blob_key FROM tiles WHERE layer = 1)");
  const auto before = map.published();
  map.FindMutable(SubmapId(2))->mutable_info().display_name = "lost";
  map.FindMutable(SubmapId(3))->mutable_info().num_frames_observed += 1;
  const Status stored = store_->Commit(*before, *map.Publish(50), Durability::kNormal);
  EXPECT_TRUE(stored.ok()) << stored.ToString();
  const auto after = map.published();
  EXPECT_TRUE(map.Remove(SubmapId(3))) << "it can be deleted";
  EXPECT_TRUE(store_->Commit(*after, *map.Publish(51), Durability::kNormal).ok());
}

TEST_P(PagingTest, AnObjectOfWhichRowsAreLostIsTheOnlyOneThatCannotBeRead) {
  MakeSample();
  OpenPaged();
  Tamper("DELETE FROM tiles WHERE layer = 2 AND " + IsOfSubmap(2));
  Map map(Load());
  const auto before = map.published();
  for (int n = 0; n < 2; ++n) {
    const Status status = ReadVoxelsOf(*before->Find(SubmapId(2)));
    EXPECT_EQ(status.code(), StatusCode::kDataLoss);
    EXPECT_EQ(status.reason(), Reason("DAMAGED_MAP"));
    EXPECT_EQ(status.message(), "map 'house': submap 2: has other tiles than were stored");
  }
  EXPECT_THROW((void)before->Find(SubmapId(2))->blocks().Find({0, 0, 0}), StatusError) << "no hole in the map";
  for (const auto id : {1u, 3u}) EXPECT_TRUE(ReadVoxelsOf(*before->Find(SubmapId(id))).ok());
  EXPECT_THROW(map.FindMutable(SubmapId(2))->DropLabels(), StatusError);
  map.FindMutable(SubmapId(2))->mutable_info().display_name = "lost";
  map.FindMutable(SubmapId(3))->mutable_info().num_frames_observed += 1;
  const Status stored = store_->Commit(*before, *map.Publish(50), Durability::kNormal);
  EXPECT_TRUE(stored.ok()) << stored.ToString() << ": nobody's commit waits for a disk to be mended";
  const auto after = map.published();
  EXPECT_TRUE(map.Remove(SubmapId(2))) << "it can be deleted";
  EXPECT_TRUE(store_->Commit(*after, *map.Publish(51), Durability::kNormal).ok());
  EXPECT_TRUE(MapsAreEqual(*map.published(), *Load()));
}

TEST_P(PagingTest, ARowOfALayerToComeIsToldToWhoNeedsTheTile) {
  MakeSample();
  OpenPaged();
  Tamper("UPDATE tiles SET layer = 15 WHERE layer = 2 AND " + IsOfSubmap(2));
  const auto paged = Load();
  const Status status = ReadVoxelsOf(*paged->Find(SubmapId(2)));
  EXPECT_EQ(status.code(), StatusCode::kFailedPrecondition) << status.ToString();
  EXPECT_EQ(status.reason(), Reason("NEWER_LAYER"));
  EXPECT_TRUE(ReadVoxelsOf(*paged->Find(SubmapId(1))).ok());
}

TEST_P(PagingTest, ABlockIsFoundWithoutTheOtherTilesOfItsObject) {
  const auto whole = MakeSample();
  OpenPaged();
  const auto paged = Load();
  const std::uint64_t before = NumReads();
  const Submap& expected = *whole->Find(SubmapId(2));
  const BlockEntry& wanted = expected.blocks().entries().front();
  const BlockTable& blocks = paged->Find(SubmapId(2))->blocks();
  const BlockEntry* found = blocks.Find(wanted.index);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->tsdf->distance_m, wanted.tsdf->distance_m);
  EXPECT_EQ(blocks.Find({wanted.index.x + 4000, wanted.index.y, wanted.index.z}), nullptr);
  EXPECT_EQ(NumReads(), before + 1) << "one tile's voxels";
  EXPECT_EQ(blocks.size(), expected.blocks().size());
  EXPECT_EQ(blocks.Find(wanted.index), found) << "the same when all are known";
  EXPECT_EQ(NumReads(), before + 1);
}

TEST_P(PagingTest, ABlockOfALargeObjectIsFoundByItsRowAlone) {
  constexpr int kNumTiles = 1200;
  MapInfo info;
  info.name = "house";
  Map made(std::move(info));
  SubmapInfo wide;
  wide.panoptic = Panoptic::kThing;
  wide.voxel_size_m = 0.1;
  wide.truncation_m = 0.3;
  Submap& submap = made.Create(std::move(wide));
  for (int x = 0; x < kNumTiles; ++x) {
    for (const int cell : {0, 21})
      submap.MutableTsdf(BlockIn({x, 0, 0}, cell)).weight[static_cast<std::size_t>(x % 512)] = 1;
  }
  submap.UpdateBoundingSphere();
  const SubmapId id = submap.id();
  ASSERT_TRUE(store_->CreateMap(*made.Publish(1)).ok());
  OpenPaged();
  Map map(Load());
  const auto& held = map.published();
  const BlockTable& blocks = held->Find(id)->blocks();
  for (int n = 0; n < 2; ++n) {
    const BlockEntry* found = blocks.Find(BlockIn({700, 0, 0}, 21));
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->tsdf->weight[700 % 512], 1);
    EXPECT_EQ(blocks.Find(BlockIn({700, 0, 0}, 20)), nullptr);
    EXPECT_EQ(blocks.Find(BlockIn({700, 1, 0}, 21)), nullptr);
  }
  EXPECT_TRUE(blocks.tiles_if_read().empty());

  // Another session changes it.
  Map other(Load());
  const auto before = other.published();
  other.FindMutable(id)->MutableTsdf(BlockIn({800, 0, 0}, 21)).weight[0] = 3;
  ASSERT_TRUE(store_->Commit(*before, *other.Publish(50), Durability::kNormal).ok());
  EXPECT_NE(blocks.Find(BlockIn({700, 0, 0}, 21)), nullptr) << "what was found stays";
  try {
    (void)blocks.Find(BlockIn({800, 0, 0}, 21));
    FAIL() << "it must not be told what is there now";
  } catch (const StatusError& error) {
    EXPECT_EQ(error.status().reason(), Reason("SNAPSHOT_EXPIRED")) << error.status().ToString();
  }
}

TEST_P(PagingTestInAFile, AStateThatIsHeldWhileTheMapIsRepairedExpires) {
  MakeSample();
  OpenPaged();
  const auto held = Load();
  Tamper("UPDATE tiles SET extent = extent - (1 << 7) WHERE layer = 1");
  const auto repaired = store_->VerifyMap("house", true, {});
  ASSERT_TRUE(repaired.ok());
  EXPECT_GT(repaired->num_faults, 0);
  const Status status = ReadVoxelsOf(*held->Find(SubmapId(2)));
  EXPECT_EQ(status.reason(), Reason("SNAPSHOT_EXPIRED")) << status.ToString();
  EXPECT_THROW((void)held->Find(SubmapId(2))->blocks().Find({0, 0, 0}), StatusError);
  EXPECT_TRUE(ReadVoxelsOf(*Load()->Find(SubmapId(2))).ok());
}

TEST_P(PagingTest, ABlockOfAStateThatTheMapHasLeftBehindExpires) {
  MakeSample();
  OpenPaged();
  const auto held = Load();
  Map map(Load());  // by whoever opens it after it was closed
  const BlockIndex index = map.Find(SubmapId(2))->blocks().entries().front().index;
  const auto before = map.published();
  map.FindMutable(SubmapId(2))->MutableTsdf(index).weight[0] += 1;
  ASSERT_TRUE(store_->Commit(*before, *map.Publish(50), Durability::kNormal).ok());
  try {
    (void)held->Find(SubmapId(2))->blocks().Find(index);
    FAIL() << "it must not be told what is there now";
  } catch (const StatusError& error) {
    EXPECT_EQ(error.status().code(), StatusCode::kAborted) << error.status().ToString();
    EXPECT_EQ(error.status().reason(), Reason("SNAPSHOT_EXPIRED"));
  }
}

TEST_P(PagingTest, ATileThatIsMissingIsTold) {
  MakeSample();
  OpenPaged();
  const auto paged = Load();
  Tamper("DELETE FROM tile_blobs WHERE blob_key IN (SELECT blob_key FROM tiles WHERE layer = 2)");
  const Status status = ReadVoxelsOf(*paged->Find(SubmapId(2)));
  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_NE(status.message().find("is missing"), std::string::npos) << status.message();
}

TEST_P(PagingTestInAFile, AStateOfBeforeTheMapWasLoadedAnewIsNotCalledDamaged) {
  MakeSample();
  OpenPaged();
  const auto held = Load();
  ASSERT_TRUE(ReadVoxelsOf(*held->Find(SubmapId(1))).ok());
  ASSERT_FALSE(held->Find(SubmapId(2))->blocks().tiles().empty());
  Map map(Load());  // as who closes a map and opens it again
  const auto before = map.published();
  map.Remove(SubmapId(1));
  map.FindMutable(SubmapId(2))->DropLabels();
  ASSERT_TRUE(store_->Commit(*before, *map.Publish(50), Durability::kNormal).ok());
  ASSERT_TRUE(testing::Eventually([this] { return Query("SELECT count(*) FROM dead_blobs") == 0; }));
  const Status gone = ReadVoxelsOf(*held->Find(SubmapId(2)));
  EXPECT_EQ(gone.code(), StatusCode::kAborted) << gone.ToString();
  EXPECT_NE(gone.message().find("map 'house': submap 2: label tile ("), std::string::npos) << gone.message();
  EXPECT_TRUE(ReadVoxelsOf(*held->Find(SubmapId(1))).ok()) << "what was read is there";
  EXPECT_TRUE(ReadVoxelsOf(*held->Find(SubmapId(3))).ok()) << "what nobody has changed is, too";
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  ASSERT_TRUE(testing::Eventually([this] { return Query("SELECT count(*) FROM tile_blobs") == 0; }));
  EXPECT_EQ(ReadVoxelsOf(*before->Find(SubmapId(3))).code(), StatusCode::kAborted);
}

TEST_P(PagingTestInAFile, AStateOfBeforeTheMapWasOpenedAgainExpiresWhereTheMapHasGoneOn) {
  MakeSample();
  OpenPaged();
  const auto held = Load();
  Map map(Load());  // by whoever opens it after it was closed
  auto before = map.published();
  map.FindMutable(SubmapId(2))->DropLabels();
  ASSERT_TRUE(store_->Commit(*before, *map.Publish(50), Durability::kNormal).ok());
  before = map.published();
  map.Remove(SubmapId(3));
  ASSERT_TRUE(store_->Commit(*before, *map.Publish(51), Durability::kNormal).ok());
  ASSERT_TRUE(testing::Eventually([this] { return Query("SELECT count(*) FROM dead_blobs") == 0; }));
  for (const auto id : {2u, 3u, 2u}) {
    const Status status = ReadVoxelsOf(*held->Find(SubmapId(id)));
    EXPECT_EQ(status.code(), StatusCode::kAborted) << status.ToString();
    EXPECT_EQ(status.reason(), Reason("SNAPSHOT_EXPIRED"));
    EXPECT_NE(status.message().find("map 'house': submap " + std::to_string(id) + ": "), std::string::npos)
        << status.message();
    testing::ExpectDiscreet(status, kept_.Path());
  }
  EXPECT_TRUE(ReadVoxelsOf(*held->Find(SubmapId(1))).ok()) << "which is as it was";
  EXPECT_TRUE(MapsAreEqual(*map.published(), *Load()));
}

TEST_P(PagingTestInAFile, AStateOfADeletedMapExpires) {
  MakeSample();
  OpenPaged();
  const auto held = Load();
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  ASSERT_TRUE(testing::Eventually([this] { return Query("SELECT count(*) FROM dead_blobs") == 0; }));
  EXPECT_EQ(ReadVoxelsOf(*held->Find(SubmapId(2))).reason(), Reason("SNAPSHOT_EXPIRED"));
}

TEST_P(PagingTest, WhatWasLostWithItsRowsIsNotTakenForExpired) {
  ExpectLost("DELETE FROM tiles WHERE " + IsOfSubmap(2));
}

TEST_P(PagingTest, WhatWasLostWithItsSubmapIsNotTakenForExpired) {
  ExpectLost("DELETE FROM submaps WHERE submap_id = 2");
}

TEST_P(PagingTest, RowsThatSayOtherBlocksThanTheirBlobsAreToldAndRepaired) {
  const auto whole = MakeSample();
  OpenPaged();
  // As many blocks, at other cells.
  Tamper("UPDATE tiles SET cells = cells * 2 WHERE layer = 1 AND cells > 0 AND cells < 4611686018427387904");
  const auto paged = Load();
  Status first;
  for (const auto& submap : paged->submaps()) {
    if (first.ok()) first = ReadVoxelsOf(*submap);
  }
  EXPECT_EQ(first.code(), StatusCode::kDataLoss) << first.ToString();
  const auto repaired = store_->VerifyMap("house", true, {});
  ASSERT_TRUE(repaired.ok());
  EXPECT_GT(repaired->num_faults, 0);
  EXPECT_TRUE(MapsAreEqual(*whole, *Load()));
}

TEST_P(PagingTest, WithoutItsStoreAMapHasWhatWasRead) {
  MakeSample();
  OpenPaged();
  const auto paged = Load();
  ASSERT_TRUE(ReadVoxelsOf(*paged->Find(SubmapId(1))).ok());
  store_ = nullptr;
  EXPECT_TRUE(ReadVoxelsOf(*paged->Find(SubmapId(1))).ok());
  EXPECT_EQ(ReadVoxelsOf(*paged->Find(SubmapId(2))).code(), StatusCode::kUnavailable);
  Open();  // the file is free
}

TEST_P(PagingTest, ACloneOfWhatWasNotReadIsRows) {
  const auto whole = MakeSample();
  OpenPaged();
  Map map(Load());
  const std::int64_t num_blobs = Query("SELECT count(*) FROM tile_blobs");
  const auto state = map.published();
  map.Clone(SubmapId(2));
  ASSERT_TRUE(store_->Commit(*state, *map.Publish(50), Durability::kNormal).ok());
  EXPECT_EQ(Query("SELECT count(*) FROM tile_blobs"), num_blobs);
  Map same(whole);
  same.Clone(SubmapId(2));
  EXPECT_TRUE(MapsAreEqual(*same.Publish(50), *Load()));
}

}  // namespace
}  // namespace dhpmap
