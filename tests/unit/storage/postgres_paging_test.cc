// SPDX-License-Identifier: BSD-3-Clause
// Maps whose voxels stay in a PostgreSQL database until somebody reads them, against the same maps read as a whole.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "mapping/base/status_error.h"
#include "mapping/paging/tile_page.h"
#include "storage/postgres/connection.h"
#include "storage/postgres_store.h"
#include "tests/support/map_equality.h"
#include "tests/support/postgres_cluster.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::ExpectSameMap;
using testing::MapGenerator;
using testing::PostgresCluster;

/// Why the voxels of a submap cannot be read, or OK.
Status ReadVoxelsInDatabase(const Submap& submap) {
  try {
    for (const BlockEntry& entry : submap.blocks().entries()) {
      EXPECT_TRUE(entry.tsdf != nullptr || entry.gone != nullptr);
    }
    return Status::Ok();
  } catch (const StatusError& error) {
    return error.status();
  }
}

class PostgresPagingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    schema_ = PostgresCluster::Get()->NewSchema();
    Open(false);
    map_ = std::make_unique<Map>(generator_.Info("house"));
    for (int n = 0; n < 4; ++n) generator_.AddSubmap(*map_, 12);
    ASSERT_TRUE(store_->CreateMap(*map_->Publish(11)).ok());
    whole_ = Load();
  }
  void Open(bool pages_tiles) {
    store_ = nullptr;
    auto opened = OpenPostgresStore(
        PostgresCluster::Get()->Url(),
        {.schema = schema_, .dead_grace_s = 0, .max_connections = 3, .pages_tiles = pages_tiles, .answer_s = 20});
    ASSERT_TRUE(opened.ok()) << opened.status().ToString();
    store_ = *std::move(opened);
  }
  std::shared_ptr<const MapSnapshot> Load() {
    auto loaded = store_->LoadMap("house");
    EXPECT_TRUE(loaded.ok()) << loaded.status().ToString();
    return loaded.ok() ? *loaded : nullptr;
  }
  Status Commit(Map& map) {
    const auto before = map.published();
    generator_.Change(map);
    return store_->Commit(*before, *map.Publish(12), Durability::kFull);
  }
  void Tamper(const std::string& sql) {
    auto connection = postgres::Connection::Open({.url = PostgresCluster::Get()->Url(), .schema = schema_});
    ASSERT_TRUE(connection.ok());
    const Status done = connection->Execute(sql, "tamper");
    ASSERT_TRUE(done.ok()) << done.ToString();
  }
  static void ExpectDamaged(const Status& status) {
    EXPECT_EQ(status.code(), StatusCode::kDataLoss) << status.ToString();
    EXPECT_EQ(status.reason(), Reason("DAMAGED_MAP"));
    EXPECT_NE(status.message().find("map 'house': submap 2"), std::string::npos) << status.ToString();
  }

  MapGenerator generator_{23};
  std::string schema_;
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<Map> map_;
  std::shared_ptr<const MapSnapshot> whole_;
};

TEST_F(PostgresPagingTest, AMapOpensWithoutVoxelsAndHasTheSame) {
  Open(true);
  const std::uint64_t before = CountPages().num_reads;
  const auto paged = Load();
  EXPECT_TRUE(DiffTiles(StateMarks(*paged), *paged).empty());
  std::size_t num_tiles = 0;
  for (const auto& submap : whole_->submaps()) {
    const Submap& other = *paged->Find(submap->id());
    ASSERT_EQ(submap->blocks().size(), other.blocks().size());
    for (const TileEntry& tile : submap->blocks().tiles()) {
      EXPECT_EQ(other.blocks().FindTile(tile.index)->tile->CellsWith(BlockLayer::kTsdf),
                tile.tile->CellsWith(BlockLayer::kTsdf));
      ++num_tiles;
    }
  }
  EXPECT_EQ(CountPages().num_reads, before) << "nobody has asked for a voxel";
  EXPECT_TRUE(testing::MapsAreEqual(*whole_, *paged));
  EXPECT_EQ(CountPages().num_reads, before + num_tiles) << "each once";
}

TEST_F(PostgresPagingTest, AMapThatIsChangedAndEvictedIsStoredAsIfItHadBeenInMemory) {
  Open(true);
  Map paged(Load());
  for (int n = 0; n < 6; ++n) {
    const Status done = Commit(paged);
    ASSERT_TRUE(done.ok()) << done.ToString();
    (void)paged.EvictPages(true);
  }
  const auto expected = paged.published();
  for (const auto& submap : expected->submaps()) ASSERT_TRUE(ReadVoxelsInDatabase(*submap).ok());  // while it is open
  Open(false);
  ExpectSameMap(*expected, *Load());
}

TEST_F(PostgresPagingTest, AStateThatTheMapHasLeftBehindIsExpiredOnceItsBlobsAreGone) {
  Open(true);
  const auto held = Load();
  Map map(Load());
  for (const auto& submap : held->submaps()) {
    if (submap->blocks().size() > 0) generator_.AddBlocks(*map.FindMutable(submap->id()), 3);
  }
  const auto before = map.published();
  ASSERT_TRUE(store_->Commit(*before, *map.Publish(12), Durability::kFull).ok());
  ASSERT_TRUE(Commit(map).ok());
  int num_expired = 0;
  for (const auto& submap : held->submaps()) {
    const Status status = ReadVoxelsInDatabase(*submap);
    if (status.ok()) continue;
    EXPECT_EQ(status.code(), StatusCode::kAborted) << status.ToString();
    EXPECT_EQ(status.reason(), Reason("SNAPSHOT_EXPIRED"));
    ++num_expired;
  }
  EXPECT_GE(num_expired, 4);
}

TEST_F(PostgresPagingTest, LostVoxelsAreDataLossForTheirReadersOnly) {
  const std::string of_second = "map_key = (SELECT map_key FROM maps) AND owner_id = 2";
  const std::string its_blobs = "blob_key IN (SELECT blob_key FROM tiles WHERE " + of_second + ")";
  Open(true);
  const auto cut_off = Load(), without_rows = Load();
  Tamper("UPDATE tile_blobs SET blob = blob || '\\x00' WHERE " + its_blobs);
  ExpectDamaged(ReadVoxelsInDatabase(*cut_off->Find(SubmapId(2))));
  EXPECT_TRUE(ReadVoxelsInDatabase(*cut_off->Find(SubmapId(1))).ok());
  Tamper("DELETE FROM tile_blobs WHERE " + its_blobs);
  ExpectDamaged(ReadVoxelsInDatabase(*Load()->Find(SubmapId(2))));
  Tamper("DELETE FROM tiles WHERE " + of_second + " AND layer = 1");
  ExpectDamaged(ReadVoxelsInDatabase(*without_rows->Find(SubmapId(2))));
}

TEST_F(PostgresPagingTest, ALostConnectionIsReplacedAndAClosedStoreIsUnavailable) {
  Open(true);
  const auto paged = Load();
  ASSERT_TRUE(ReadVoxelsInDatabase(*paged->Find(SubmapId(1))).ok());
  PostgresCluster::Get()->CutConnections();
  const Status again = ReadVoxelsInDatabase(*paged->Find(SubmapId(2)));
  EXPECT_TRUE(again.ok()) << again.ToString();
  store_ = nullptr;
  const Status closed = ReadVoxelsInDatabase(*paged->Find(SubmapId(3)));
  EXPECT_EQ(closed.code(), StatusCode::kUnavailable) << closed.ToString();
}

}  // namespace
}  // namespace dhpmap
