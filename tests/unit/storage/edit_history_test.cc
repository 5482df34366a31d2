// SPDX-License-Identifier: BSD-3-Clause
// What it takes to undo edits: what it says of itself while all kinds of edits are made, and what each costs.
#include "storage/history/edit_history.h"

#include <string>
#include <utility>

#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::StoreKind;

class EditHistoryTest : public AnyStoreTest {
 protected:
  /// Publishes what was done to the map, and stores it as an edit.
  void Commit(Map& map) {
    const auto before = map.published();
    const auto after = map.Publish(30);
    const EditRecord record{.entry = {after->revision(), 30, {}, {}}, .answer = "", .before = before};
    const Status done = store_->CommitEdit(*before, *after, record);
    ASSERT_TRUE(done.ok()) << done.ToString();
  }
  /// A map with an object of so many tiles of one block.
  std::unique_ptr<Map> CreateWide(int num_tiles) {
    auto map = std::make_unique<Map>(generator_.Info("wide"));
    Submap& submap = generator_.AddSubmap(*map, 0);
    for (int n = 0; n < num_tiles; ++n) submap.MutableTsdf({4 * n, 0, 0}).weight[0] = 1;
    submap.UpdateBoundingSphere();
    EXPECT_TRUE(store_->CreateMap(*map->Publish(1)).ok());
    return map;
  }
};

/// By SQL of SQLite's own.
class EditHistoryTestInAFile : public EditHistoryTest {};

TEST_P(EditHistoryTest, IsWholeAndSaysItsSizeWhateverAnEditDid) {
  Open();
  const auto map = CreateSample("house");
  for (int n = 0; n < 30; ++n) {
    SCOPED_TRACE("edit " + std::to_string(n));
    generator_.Change(*map);
    if (n % 7 == 3) {  // a copy that is written to at once
      Submap* copy = map->Clone(map->submaps().back()->id());
      generator_.AddBlocks(*map->FindMutable(copy->id()), 2);
    }
    Commit(*map);
    const auto report = store_->VerifyMap("house", false, {});
    ASSERT_TRUE(report.ok());
    ASSERT_EQ(report->num_faults, 0) << report->faults[0].place << " " << report->faults[0].what;
    ASSERT_TRUE(store_->LoadEdit("house", map->info().revision).ok());
  }
  EXPECT_EQ(Query("SELECT count(*) FROM edit_histories"), 30);
  EXPECT_EQ(
      Query("SELECT count(*) FROM edit_histories h WHERE num_bytes <> length(h.blob) + (SELECT coalesce(sum(64 + "
            "coalesce(length(b.blob), 0) + coalesce(length(a.blob), 0)), 0) FROM edit_tiles t LEFT JOIN tile_blobs b "
            "ON b.blob_key = before_key LEFT JOIN tile_blobs a ON a.blob_key = after_key WHERE t.edit_key = "
            "h.edit_key)"),
      0);
  EXPECT_GT(Query("SELECT count(*) FROM edit_tiles WHERE submap_id = -1"), 0) << "some of the map's own";
  ExpectStored(*map->published());
}

TEST_P(EditHistoryTestInAFile, ACloneAndAMoveTakeRowsAndNoBlobs) {
  constexpr int kTiles = 300;
  Open();
  const auto map = CreateWide(kTiles);
  const std::int64_t num_blobs = Query("SELECT count(*) FROM tile_blobs");
  map->Clone(SubmapId(1));
  Commit(*map);
  map->FindMutable(SubmapId(1))->mutable_info().T_map_submap = generator_.Pose();
  Commit(*map);
  EXPECT_EQ(Query("SELECT count(*) FROM tile_blobs"), num_blobs);
  EXPECT_EQ(Query("SELECT count(*) FROM tiles"), 2 * kTiles);
  EXPECT_EQ(Query("SELECT count(*) FROM edit_tiles"), kTiles) << "of the clone: a move changes no tile";
  EXPECT_EQ(Query("SELECT min(num_more) FROM shared_blobs"), 2) << "the copy, and what undoes it";
  EXPECT_EQ(Query("SELECT max(num_more) FROM shared_blobs"), 2);
}

TEST_P(EditHistoryTest, AnEditDeletesFewTilesOfOthersAndALaterOneTheRest) {
  constexpr std::int64_t kTiles = 100;
  constexpr int kClones = 8;
  Open();
  const auto map = CreateWide(kTiles);
  for (int n = 0; n < kClones; ++n) {
    map->Clone(SubmapId(1));
    Commit(*map);
  }
  ASSERT_EQ(Query("SELECT count(*) FROM edit_tiles"), kClones * kTiles);
  Open({.edits = {.max_histories = 1}});
  std::int64_t num_tiles = kClones * kTiles;
  for (int n = 0; n < kClones && num_tiles > 0; ++n) {
    map->FindMutable(SubmapId(1))->mutable_info().display_name = "name " + std::to_string(n);
    Commit(*map);
    const std::int64_t num_left = Query("SELECT count(*) FROM edit_tiles");
    EXPECT_LE(num_tiles - num_left, kMostTilesTrimmed);
    EXPECT_GE(num_tiles - num_left, kTiles) << "it gets on";
    num_tiles = num_left;
  }
  EXPECT_EQ(num_tiles, 0);
  EXPECT_EQ(Query("SELECT count(*) FROM edit_histories"), 1);
  EXPECT_EQ(store_->VerifyMap("wide", false, {})->num_faults, 0);
}

TEST_P(EditHistoryTest, OneThatIsLargeGoesAllTheSame) {
  Open();
  constexpr int kTiles = 2 * static_cast<int>(kMostTilesTrimmed);
  const auto map = CreateWide(kTiles);
  map->Clone(SubmapId(1));
  Commit(*map);
  Open({.edits = {.max_histories = 1}});
  map->FindMutable(SubmapId(1))->mutable_info().display_name = "another";
  Commit(*map);
  EXPECT_EQ(Query("SELECT count(*) FROM edit_tiles"), 0);
}

DHPMAP_ON_STORES_THAT_KEEP(EditHistoryTest);
INSTANTIATE_TEST_SUITE_P(Stores, EditHistoryTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
