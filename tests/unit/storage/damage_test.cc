// SPDX-License-Identifier: BSD-3-Clause
// What the SQLite store makes of files that were changed behind its back.
#include "storage/connection.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::OpenMode;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::MapGenerator;
using testing::SqliteStoreTest;

// Damage inside.

TEST_F(SqliteStoreTest, AFlippedByteInABlobNamesTheTileAndLeavesOtherMapsAlone) {
  Open();
  const auto map = CreateSample("house");
  const auto other = CreateSample("other");
  store_ = nullptr;
  Tamper(
      "UPDATE tile_blobs SET blob = CAST(substr(blob, 1, 40) || x'5A' || substr(blob, 42) AS BLOB) WHERE blob_key = "
      "(SELECT min(blob_key) FROM tiles WHERE layer = 2 AND owner_key = "
      "(SELECT submap_key FROM submaps JOIN maps USING (map_key) WHERE name = 'house' AND submap_id = 2))");
  Open();
  const Status loaded = store_->LoadMap("house").status();
  EXPECT_EQ(loaded.code(), StatusCode::kDataLoss);
  for (const char* part : {"map 'house'", "submap 2", "label tile ("}) {
    EXPECT_NE(loaded.message().find(part), std::string::npos) << loaded.ToString();
  }
  ExpectDiscreet(loaded, Path());
  ExpectStored(*other->published());
  EXPECT_EQ(store_->ListMaps()->size(), 2u);
  EXPECT_TRUE(store_->DeleteMap("house").ok());
}

TEST_F(SqliteStoreTest, AFlippedByteInATileNamesTheLayerAndATileOfALaterVersionIsNoDamage) {
  Open();
  CreateSample("house");
  CreateSample("other");
  CreateSample("third");
  store_ = nullptr;
  Tamper(
      "UPDATE tile_blobs SET blob = CAST(substr(blob, 1, 9) || x'5A' || substr(blob, 11) AS BLOB) WHERE blob_key IN "
      "(SELECT blob_key FROM tiles WHERE owner_key = -1)");
  Tamper("UPDATE tiles SET layer = 9 WHERE owner_key = -2");
  Tamper(
      "UPDATE tiles SET layer = 9 WHERE layer = 4 AND owner_key IN (SELECT submap_key FROM submaps WHERE map_key = 3)");
  Open();
  const Status loaded = store_->LoadMap("house").status();
  EXPECT_EQ(loaded.code(), StatusCode::kDataLoss) << loaded.ToString();
  for (const char* part : {"map 'house'", "free-space tile ("}) {
    EXPECT_NE(loaded.message().find(part), std::string::npos) << loaded.ToString();
  }
  ExpectDiscreet(loaded, Path());
  EXPECT_EQ(loaded.reason(), Reason("DAMAGED_MAP"));
  for (const char* name : {"other", "third"}) {
    const Status later = store_->LoadMap(name).status();
    EXPECT_EQ(later.code(), StatusCode::kFailedPrecondition) << later.ToString();
    EXPECT_NE(later.message().find("layer 9 tile ("), std::string::npos) << later.ToString();
    EXPECT_EQ(later.reason(), Reason("NEWER_LAYER"));
  }
}

TEST_F(SqliteStoreTest, AnyOtherChangeOfWhatAMapConsistsOfIsDataLoss) {
  const std::string house = "(SELECT map_key FROM maps WHERE name = 'house')";
  const std::string submap = "(SELECT max(submap_key) FROM submaps WHERE map_key = " + house + ")";
  const std::vector<std::string> changes = {
      "UPDATE maps SET revision = revision + 1 WHERE name = 'house'",
      "UPDATE maps SET num_frames = 77 WHERE name = 'house'",
      "UPDATE map_config SET value = '0.123' WHERE key = 'voxel_size_m'",
      "DELETE FROM label_classes WHERE class_id = 9",
      "UPDATE label_classes SET panoptic = 0",
      "UPDATE submaps SET pose = zeroblob(96)",
      "UPDATE submaps SET pose = x'00'",
      "UPDATE submaps SET sphere = zeroblob(32)",
      "UPDATE submaps SET class_counts = x'01'",
      "UPDATE submaps SET panoptic = 9",
      "UPDATE submaps SET track_id = 12345",
      "UPDATE submaps SET submap_id = submap_id + 50 WHERE submap_id > 1",
      "DELETE FROM submaps WHERE submap_key = " + submap,
      "DELETE FROM tiles WHERE blob_key = (SELECT max(blob_key) FROM tiles WHERE layer = 1)",
      "DELETE FROM tiles WHERE owner_key = -1 AND blob_key = (SELECT max(blob_key) FROM tiles WHERE owner_key = -1)",
      "DELETE FROM tile_blobs WHERE blob_key = (SELECT max(blob_key) FROM tiles WHERE layer = 1)",
      "DELETE FROM tile_blobs WHERE blob_key = (SELECT max(blob_key) FROM tiles WHERE layer = 3)",
      "UPDATE tiles SET x = x + 1000",
      "UPDATE tiles SET z = z + 1000 WHERE layer = 3",
      "UPDATE OR REPLACE tiles SET owner_key = " + submap +
          " WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE layer = 2)",
      "UPDATE tiles SET blob_key = (SELECT min(blob_key) FROM tile_blobs) WHERE owner_key > 0",
      "UPDATE tile_blobs SET blob = x''",
      "UPDATE tile_blobs SET blob = x'' WHERE blob_key IN (SELECT blob_key FROM tiles WHERE layer = 3)",
      "UPDATE submaps SET tiles_sum = tiles_sum + 1",
      "UPDATE maps SET tiles_sum = tiles_sum + 1",
      "UPDATE maps SET num_tiles = num_tiles - 1",
  };
  for (const std::string& change : changes) {
    fs::remove(Path());
    Open();
    CreateSample("house");
    store_ = nullptr;
    Tamper(change);
    Open();
    const Status loaded = store_->LoadMap("house").status();
    EXPECT_EQ(loaded.code(), StatusCode::kDataLoss) << change << ": " << loaded.ToString();
    EXPECT_NE(loaded.message().find("map 'house'"), std::string::npos) << loaded.ToString();
    store_ = nullptr;
  }
}

TEST_F(SqliteStoreTest, AMapWithADamagedRowIsListedAsSuchBesideTheOthers) {
  Open();
  CreateSample("house");
  const auto other = CreateSample("other");
  store_ = nullptr;
  Tamper("UPDATE maps SET num_frames = 77 WHERE name = 'house'");
  Open();
  const auto maps = store_->ListMaps();
  ASSERT_TRUE(maps.ok()) << maps.status().ToString();
  ASSERT_EQ(maps->size(), 2u);
  EXPECT_EQ((*maps)[0].info.name, "house");
  EXPECT_EQ((*maps)[0].damage.code(), StatusCode::kDataLoss);
  EXPECT_TRUE((*maps)[1].damage.ok());
  EXPECT_EQ((*maps)[1].info.revision, other->published()->revision());
  EXPECT_EQ(store_->GetMap("house").status().code(), StatusCode::kDataLoss);
}

/// A map of many pages in the file, nothing in the log.
std::unique_ptr<Map> CreateLarge(MapGenerator& generator, MapStore& store) {
  auto map = std::make_unique<Map>(generator.Info("house"));
  for (int n = 0; n < 40; ++n) generator.AddSubmap(*map, 8);
  EXPECT_TRUE(store.CreateMap(*map->Publish(11)).ok());
  return map;
}

TEST_F(SqliteStoreTest, AFileThatIsTruncatedUnderAnOpenStoreIsATypedError) {
  for (const std::uintmax_t kept : {0, 4096, 30'000}) {
    SCOPED_TRACE("kept " + std::to_string(kept));
    fs::remove(Path());
    Open();
    const auto map = CreateLarge(generator_, *store_);
    Open();
    ASSERT_GT(fs::file_size(Path()), 200'000u);
    ASSERT_TRUE(store_->ListMaps().ok());
    fs::resize_file(Path(), kept);
    const auto before = map->published();
    generator_.AddBlocks(*map->FindMutable(SubmapId(20)), 3);
    for (const Status& status :
         {store_->LoadMap("house").status(), store_->Commit(*before, *map->Publish(20), Durability::kFull),
          store_->LoadMap("house").status()}) {
      EXPECT_TRUE(status.code() == StatusCode::kDataLoss || status.code() == StatusCode::kUnavailable ||
                  status.code() == StatusCode::kNotFound)
          << status.ToString();
      ExpectDiscreet(status, Path());
    }
    store_ = nullptr;
    for (const char* left : {"-wal", "-shm"}) fs::remove(Path() + left);
  }
}

/// A file mapped into memory would end the process here, by SIGBUS.
TEST_F(SqliteStoreTest, AFileThatIsTruncatedInTheMiddleOfAReadIsATypedError) {
  Open();
  CreateLarge(generator_, *store_);
  store_ = nullptr;
  ReaderPool readers(Path(), OpenMode::kReadOnly, 1000);
  auto lease = readers.Borrow();
  ASSERT_TRUE(lease.ok());
  auto blobs = (**lease).Prepare("SELECT blob FROM tile_blobs ORDER BY blob_key", "read the tiles");
  ASSERT_TRUE(*blobs->Step());
  fs::resize_file(Path(), 8192);
  const Status status = blobs->Run();
  EXPECT_EQ(status.code(), StatusCode::kDataLoss) << status.ToString();
}

TEST_F(SqliteStoreTest, FlippedBytesAnywhereInTheFileNeverCrash) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  std::ifstream file(Path(), std::ios::binary);
  const std::string intact((std::istreambuf_iterator<char>(file)), {});
  int num_seen = 0;
  for (std::size_t at = 0; at < intact.size(); at += 997) {
    std::string damaged = intact;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    for (const char* left : {"-wal", "-shm"}) fs::remove(Path() + left);
    WriteFile(damaged);
    Status status = TryOpen(at % 2 == 0);
    if (status.ok()) {
      const auto loaded = store_->LoadMap("house");
      status = loaded.status();
      if (status.ok()) ExpectSameMap(*map->published(), **loaded);  // a byte that holds nothing of the map
    }
    num_seen += !status.ok();
    ExpectDiscreet(status, Path());
    store_ = nullptr;
    ASSERT_FALSE(HasFailure()) << "byte " << at;
  }
  EXPECT_GT(num_seen, 10);
}

}  // namespace
}  // namespace dhpmap
