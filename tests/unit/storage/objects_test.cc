// SPDX-License-Identifier: BSD-3-Clause
// What became of merged submaps, and what is known of pairs, is stored with the frames or edits that it comes from.
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::StoreKind;

class StoredObjectsTest : public AnyStoreTest {
 protected:
  /// Commits the map with `change` made, and nothing else but a frame more.
  template <typename Change>
  void Commit(Map& map, Change&& change) {
    const auto before = map.published();
    map.mutable_info().num_frames += 1;
    change(map.mutable_info());
    const Status committed = store_->Commit(*before, *map.Publish(30), Durability::kNormal);
    ASSERT_TRUE(committed.ok()) << committed.ToString();
  }
};

/// By SQL of SQLite's own.
class StoredObjectsTestInAFile : public StoredObjectsTest {};

TEST_P(StoredObjectsTest, ComeBackAfterARestartWithEveryChainResolved) {
  Open();
  const auto map = CreateSample("house");
  Commit(*map, [](MapInfo& info) { info.merged.Add(SubmapId(60), SubmapId(50)); });
  Commit(*map, [](MapInfo& info) { info.merged.Add(SubmapId(50), SubmapId(2)); });
  Commit(*map, [](MapInfo& info) { info.pairs.SetVerdict(SubmapId(1), SubmapId(3), PairVerdict::kMustBeOne); });
  Open();
  ExpectStored(*map->published());
  const auto stored = store_->GetMap("house");
  EXPECT_EQ(stored->info.merged.Into(SubmapId(60)), SubmapId(2));
  EXPECT_EQ(stored->info.merged.Into(SubmapId(50)), SubmapId(2));
  EXPECT_EQ(stored->info.pairs.Of(SubmapId(3), SubmapId(1)).verdict, PairVerdict::kMustBeOne);
}

TEST_P(StoredObjectsTestInAFile, OnlyPairsThatChangedAreWritten) {
  Open();
  const auto map = CreateSample("house");
  Tamper(
      "CREATE TABLE written (what TEXT);"
      "CREATE TRIGGER a AFTER INSERT ON object_pairs BEGIN INSERT INTO written VALUES ('new'); END;"
      "CREATE TRIGGER b AFTER UPDATE ON object_pairs BEGIN INSERT INTO written VALUES ('changed'); END;"
      "CREATE TRIGGER c AFTER DELETE ON object_pairs BEGIN INSERT INTO written VALUES ('gone'); END;"
      "CREATE TRIGGER d AFTER INSERT ON merged_ids BEGIN INSERT INTO written VALUES ('merged'); END;");
  Commit(*map, [](MapInfo& info) { info.pairs.AddEvidence(SubmapId(1), SubmapId(2), 1, -120, 120); });
  EXPECT_EQ(Query("SELECT count(*) FROM written WHERE what = 'changed'"), 1);
  Commit(*map, [](MapInfo& info) { info.pairs.AddEvidence(SubmapId(8), SubmapId(9), 1, -120, 120); });
  EXPECT_EQ(Query("SELECT count(*) FROM written WHERE what = 'new'"), 1);
  Commit(*map, [](MapInfo& info) { info.pairs.Remove(SubmapId(8)); });
  EXPECT_EQ(Query("SELECT count(*) FROM written WHERE what = 'gone'"), 1);
  EXPECT_EQ(Query("SELECT count(*) FROM written"), 3);
  ExpectStored(*map->published());
}

TEST_P(StoredObjectsTest, AnyChangeBehindOurBackIsDamage) {
  for (const char* change :
       {"UPDATE merged_ids SET into_id = into_id + 1", "DELETE FROM merged_ids WHERE merged_id = 77",
        "INSERT INTO merged_ids SELECT map_key, 5, 1 FROM maps", "UPDATE object_pairs SET evidence = evidence + 1",
        "UPDATE object_pairs SET verdict = 1", "UPDATE object_pairs SET second_id = second_id + 10",
        "DELETE FROM object_pairs", "INSERT INTO object_pairs SELECT map_key, 7, 8, 2, 0 FROM maps",
        "UPDATE maps SET merged_checksum = 0", "UPDATE maps SET pairs_checksum = 0",
        "UPDATE maps SET checksum_version = 4"}) {
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

DHPMAP_ON_STORES_THAT_KEEP(StoredObjectsTest);
INSTANTIATE_TEST_SUITE_P(Stores, StoredObjectsTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
