// SPDX-License-Identifier: BSD-3-Clause
// What a store makes of rows that were changed behind its back.
#include <string>
#include <vector>

#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::ExpectDiscreet;

class DamagedRowsTest : public AnyStoreTest {
 protected:
  static std::string KeyOf(const std::string& map) { return "(SELECT map_key FROM maps WHERE name = '" + map + "')"; }
  [[nodiscard]] std::string Owner() const { return kept_.IsPostgres() ? "owner_id" : "owner_key"; }
  /// Conditions on rows of table tiles: those of a submap, of any submap, and the map's own ones.
  [[nodiscard]] std::string IsOfSubmap(const std::string& map, int id) const {
    const std::string of_map = "map_key = " + KeyOf(map);
    if (kept_.IsPostgres()) return of_map + " AND owner_id = " + std::to_string(id);
    return "owner_key = (SELECT submap_key FROM submaps WHERE " + of_map + " AND submap_id = " + std::to_string(id) +
           ")";
  }
  [[nodiscard]] std::string IsOfAnySubmap(const std::string& map) const {
    const std::string of_map = "map_key = " + KeyOf(map);
    return kept_.IsPostgres() ? of_map + " AND owner_id >= 0"
                              : "owner_key IN (SELECT submap_key FROM submaps WHERE " + of_map + ")";
  }
  [[nodiscard]] std::string IsOfMapItself(const std::string& map) const {
    return kept_.IsPostgres() ? "map_key = " + KeyOf(map) + " AND owner_id = -1" : "owner_key = -" + KeyOf(map);
  }
  /// Another byte in place of number `at` of blobs; `where` selects keys.
  void Flip(int at, const std::string& where) {
    Tamper("UPDATE tile_blobs SET blob = CAST(substr(blob, 1, " + std::to_string(at) + ") || x'5A' || substr(blob, " +
           std::to_string(at + 2) + ") AS " + (kept_.IsPostgres() ? "bytea" : "BLOB") + ") WHERE blob_key " + where);
  }
  static std::string Zeros(int num_bytes) { return "x'" + std::string(2 * num_bytes, '0') + "'"; }
};
DHPMAP_ON_STORES_THAT_KEEP(DamagedRowsTest);

TEST_P(DamagedRowsTest, AFlippedByteInABlobNamesTheTileAndLeavesOtherMapsAlone) {
  const auto other = CreateSample("other");
  CreateSample("house");
  store_ = nullptr;
  const std::string of_house = kept_.IsPostgres() ? " AND map_key = " + KeyOf("house") : "";
  Flip(40, "= (SELECT min(blob_key) FROM tiles WHERE layer = 2 AND " + IsOfSubmap("house", 2) + ")" + of_house);
  Open();
  const Status loaded = store_->LoadMap("house").status();
  EXPECT_EQ(loaded.code(), StatusCode::kDataLoss);
  for (const char* part : {"map 'house'", "submap 2", "label tile ("}) {
    EXPECT_NE(loaded.message().find(part), std::string::npos) << loaded.ToString();
  }
  ExpectDiscreet(loaded, kept_.Path());
  ExpectStored(*other->published());
  EXPECT_EQ(store_->ListMaps()->size(), 2u);
  EXPECT_TRUE(store_->DeleteMap("house").ok());
}

TEST_P(DamagedRowsTest, AFlippedByteInATileNamesTheLayerAndATileOfALaterVersionIsNoDamage) {
  for (const char* name : {"house", "other", "third"}) CreateSample(name);
  store_ = nullptr;
  const std::string of_house = kept_.IsPostgres() ? " AND map_key = " + KeyOf("house") : "";
  Flip(9, "IN (SELECT blob_key FROM tiles WHERE " + IsOfMapItself("house") + ")" + of_house);
  Tamper("UPDATE tiles SET layer = 9 WHERE " + IsOfMapItself("other"));
  Tamper("UPDATE tiles SET layer = 9 WHERE layer = 4 AND " + IsOfAnySubmap("third"));
  Open();
  const Status loaded = store_->LoadMap("house").status();
  EXPECT_EQ(loaded.code(), StatusCode::kDataLoss) << loaded.ToString();
  for (const char* part : {"map 'house'", "free-space tile ("}) {
    EXPECT_NE(loaded.message().find(part), std::string::npos) << loaded.ToString();
  }
  ExpectDiscreet(loaded, kept_.Path());
  EXPECT_EQ(loaded.reason(), Reason("DAMAGED_MAP"));
  for (const char* name : {"other", "third"}) {
    const Status later = store_->LoadMap(name).status();
    EXPECT_EQ(later.code(), StatusCode::kFailedPrecondition) << later.ToString();
    EXPECT_NE(later.message().find("layer 9 tile ("), std::string::npos) << later.ToString();
    EXPECT_EQ(later.reason(), Reason("NEWER_LAYER"));
  }
}

TEST_P(DamagedRowsTest, AnyOtherChangeOfWhatAMapConsistsOfIsDataLoss) {
  const std::string newest =
      kept_.IsPostgres() ? "(SELECT max(submap_id) FROM submaps)" : "(SELECT max(submap_key) FROM submaps)";
  const std::string own = kept_.IsPostgres() ? "owner_id = -1" : "owner_key < 0";
  const std::vector<std::string> changes = {
      "UPDATE maps SET revision = revision + 1",
      "UPDATE maps SET num_frames = 77",
      "UPDATE map_config SET value = '0.123' WHERE key = 'voxel_size_m'",
      "DELETE FROM label_classes WHERE class_id = 9",
      "UPDATE label_classes SET panoptic = 0",
      "UPDATE submaps SET pose = " + Zeros(96),
      "UPDATE submaps SET pose = x'00'",
      "UPDATE submaps SET sphere = " + Zeros(32),
      "UPDATE submaps SET class_counts = x'01'",
      "UPDATE submaps SET panoptic = 9",
      "UPDATE submaps SET track_id = 12345",
      "UPDATE submaps SET submap_id = submap_id + 50 WHERE submap_id > 1",
      "DELETE FROM submaps WHERE submap_id = (SELECT max(submap_id) FROM submaps)",
      "DELETE FROM tiles WHERE blob_key = (SELECT max(blob_key) FROM tiles WHERE layer = 1)",
      "DELETE FROM tiles WHERE " + own + " AND blob_key = (SELECT max(blob_key) FROM tiles WHERE " + own + ")",
      "DELETE FROM tile_blobs WHERE blob_key = (SELECT max(blob_key) FROM tiles WHERE layer = 1)",
      "DELETE FROM tile_blobs WHERE blob_key = (SELECT max(blob_key) FROM tiles WHERE layer = 3)",
      "UPDATE tiles SET x = x + 1000",
      "UPDATE tiles SET z = z + 1000 WHERE layer = 3",
      "UPDATE tiles SET " + Owner() + " = " + newest +
          ", x = x + 1000 WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE layer = 2)",
      "UPDATE tiles SET blob_key = (SELECT min(blob_key) FROM tile_blobs) WHERE " + Owner() + " > 0",
      "UPDATE tile_blobs SET blob = x''",
      "UPDATE tile_blobs SET blob = x'' WHERE blob_key IN (SELECT blob_key FROM tiles WHERE layer = 3)",
      "UPDATE submaps SET tiles_sum = tiles_sum + 1",
      "UPDATE maps SET tiles_sum = tiles_sum + 1",
      "UPDATE maps SET num_tiles = num_tiles - 1",
  };
  for (const std::string& change : changes) {
    BeginAnew();
    CreateSample("house");
    store_ = nullptr;
    Tamper(change);
    Open();
    const Status loaded = store_->LoadMap("house").status();
    EXPECT_EQ(loaded.code(), StatusCode::kDataLoss) << change << ": " << loaded.ToString();
    EXPECT_NE(loaded.message().find("map 'house'"), std::string::npos) << loaded.ToString();
  }
}

TEST_P(DamagedRowsTest, AMapWithADamagedRowIsListedAsSuchBesideTheOthers) {
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

class FailedCommitTest : public AnyStoreTest {
 protected:
  /// From now on the database refuses rows of large objects: the last of the many rows of a commit.
  void RefuseLargeObjects() {
    Tamper(kept_.IsPostgres() ? "ALTER TABLE submaps ADD CONSTRAINT stop CHECK (blob_bytes <= 4000) NOT VALID"
                              : "CREATE TRIGGER stop BEFORE UPDATE OF blob_bytes ON submaps WHEN NEW.blob_bytes > 4000 "
                                "BEGIN SELECT RAISE(ABORT, 'no'); END");
  }
  void TakeLargeObjects() {
    Tamper(kept_.IsPostgres() ? "ALTER TABLE submaps DROP CONSTRAINT stop" : "DROP TRIGGER stop");
  }
};
DHPMAP_ON_STORES_THAT_KEEP(FailedCommitTest);

TEST_P(FailedCommitTest, LeavesTheOldStateAndAWorkingStore) {
  const auto map = CreateSample("house");
  const auto before = map->published();
  RefuseLargeObjects();
  generator_.AddBlocks(*map->FindMutable(SubmapId(1)), 10);
  generator_.AddSubmap(*map, 20);
  map->Remove(SubmapId(3));
  const auto after = map->Publish(20);
  EXPECT_FALSE(store_->Commit(*before, *after, Durability::kNormal).ok());
  ExpectStored(*before);
  TakeLargeObjects();
  const Status done = store_->Commit(*before, *after, Durability::kNormal);
  ASSERT_TRUE(done.ok()) << done.ToString();
  ExpectStored(*after);
}

}  // namespace
}  // namespace dhpmap
