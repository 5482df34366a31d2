// SPDX-License-Identifier: BSD-3-Clause
// What a commit to the SQLite store writes.
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::OpenMode;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::SqliteStoreTest;

// Writing.

TEST_F(SqliteStoreTest, OnlyChangedLayersOfTilesAreWritten) {
  Open();
  const auto map = CreateSample("house");
  Tamper(
      "CREATE TABLE written (what TEXT);"
      "CREATE TRIGGER a AFTER INSERT ON tile_blobs BEGIN INSERT INTO written VALUES (hex(substr(NEW.blob, 1, 1))); END;"
      "CREATE TRIGGER b AFTER UPDATE ON tile_blobs BEGIN INSERT INTO written VALUES ('update'); END;"
      "CREATE TRIGGER c AFTER INSERT ON tiles BEGIN INSERT INTO written VALUES ('row'); END;"
      "CREATE TRIGGER d AFTER UPDATE ON tiles BEGIN INSERT INTO written VALUES ('row'); END;"
      "CREATE TRIGGER e AFTER UPDATE OF pose ON submaps BEGIN INSERT INTO written VALUES ('submap'); END;");
  const auto num_written = [this](const std::string& what) {
    return Query("SELECT count(*) FROM written WHERE what = '" + what + "'");
  };
  const auto before = map->published();
  Submap& submap = *map->FindMutable(SubmapId(2));
  const std::span<const TileEntry> tiles = submap.blocks().tiles();
  ASSERT_GT(tiles.size(), 2u);
  const BlockIndex first = tiles[0].tile->entries().front().index, second = tiles[1].tile->entries().front().index;
  submap.MutableTsdf(first).weight[0] += 1;
  submap.MutableTsdf(second).weight[0] += 1;
  submap.MutableLabels(second).AddObservation(0, ClassId(9));
  map->FindMutable(SubmapId(3))->mutable_info().T_map_submap.translation().x() = 4;
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(20), Durability::kNormal).ok());
  EXPECT_EQ(num_written("12"), 2) << "TSDF";
  EXPECT_EQ(num_written("22"), 1) << "labels";
  EXPECT_EQ(num_written("row"), 3);
  EXPECT_EQ(num_written("submap"), 2);
  ExpectStored(*map->published());

  for (const std::uint64_t blocks : {5u, 2u}) {
    const auto last = map->published();
    FreeBlocks seen;
    seen.full = blocks;
    map->mutable_free_space().Add({50, 0, 0}, seen, 7);
    ASSERT_TRUE(store_->Commit(*last, *map->Publish(21), Durability::kNormal).ok());
  }
  EXPECT_EQ(num_written("31"), 2) << "one added, then that one changed";
  EXPECT_EQ(num_written("12"), 2);
  EXPECT_EQ(num_written("update"), 0) << "a blob is never written again";
  ExpectStored(*map->published());
}

TEST_F(SqliteStoreTest, KeepsTotalsAndBoxesInStep) {
  Open();
  const auto map = CreateSample("house");
  for (int step = 0; step < 12; ++step) {
    const auto before = map->published();
    generator_.Change(*map);
    ASSERT_TRUE(store_->Commit(*before, *map->Publish(step), Durability::kNormal).ok());
    EXPECT_EQ(store_->GetMap("house")->blob_bytes,
              Query("SELECT total(length(blob)) FROM tiles JOIN tile_blobs USING (blob_key)"));
    std::int64_t num_spheres = 0;
    for (const auto& submap : map->submaps()) num_spheres += !submap->bounding_sphere().IsEmpty();
    EXPECT_EQ(Query("SELECT count(*) FROM submap_boxes"), num_spheres);
  }
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  EXPECT_EQ(Query("SELECT (SELECT count(*) FROM submaps) + (SELECT count(*) FROM tiles) + (SELECT count(*) FROM "
                  "shared_blobs) + (SELECT count(*) FROM submap_boxes) + (SELECT count(*) FROM map_config) + (SELECT "
                  "count(*) FROM feed_sessions)"),
            0);
}

TEST_F(SqliteStoreTest, ABoxEnclosesItsSphereInTheMapFrame) {
  Open();
  const auto map = CreateSample("house");
  auto database = Database::Open(Path(), OpenMode::kReadOnly, 1000);
  ASSERT_TRUE(database.ok());
  auto select = database->Prepare(
      "SELECT min_x_m, max_x_m, min_y_m, max_y_m, min_z_m, max_z_m FROM submap_boxes JOIN submaps USING (submap_key) "
      "WHERE submap_id = 2",
      "look");
  ASSERT_TRUE(select.ok());
  ASSERT_TRUE(*select->Step());
  const BoundingSphere sphere = map->Find(SubmapId(2))->BoundingSphereInMap();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(select->Real(2 * axis), sphere.center_m[axis] - sphere.radius_m);
    EXPECT_GE(select->Real(2 * axis + 1), sphere.center_m[axis] + sphere.radius_m);
    EXPECT_NEAR(select->Real(2 * axis + 1) - select->Real(2 * axis), 2 * sphere.radius_m, 1e-4);
  }
}

TEST_F(SqliteStoreTest, TheWriterDoesNotKeepThePagesOfALargeMap) {
  Open();
  auto map = std::make_unique<Map>(generator_.Info("house"));
  const std::int64_t before = Database::BytesInUse();
  for (int n = 0; n < 5; ++n) generator_.AddSubmap(*map, 3000);
  ASSERT_TRUE(store_->CreateMap(*map->Publish(1)).ok());
  const std::int64_t stored = store_->GetMap("house")->blob_bytes;
  ASSERT_GT(stored, 4'000'000);
  EXPECT_LT(Database::BytesInUse() - before, stored / 4);
}

}  // namespace
}  // namespace dhpmap
