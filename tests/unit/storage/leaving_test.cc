// SPDX-License-Identifier: BSD-3-Clause
// What an edit has moved, and what that left: stored after the edit, and lost by nobody who comes between.
#include <memory>
#include <string>
#include <utility>

#include "storage/rows/map_rows.h"
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::ExpectSameMap;
using testing::ExpectSameVoxels;
using testing::StoreKind;

constexpr char kLeaving[] = "SELECT leaving_submap_id FROM maps";
constexpr char kVacatedTiles[] = "SELECT count(*) FROM tiles WHERE layer = 5";
/// Histories that say of their size what is not so.
constexpr char kWrongSizes[] =
    "SELECT count(*) FROM edit_histories h WHERE num_bytes <> length(h.blob) + (SELECT coalesce(sum(64 + "
    "coalesce(length(b.blob), 0) + coalesce(length(a.blob), 0)), 0) FROM edit_tiles t LEFT JOIN tile_blobs b ON "
    "b.blob_key "
    "= before_key LEFT JOIN tile_blobs a ON a.blob_key = after_key WHERE t.edit_key = h.edit_key)";

class LeavingTest : public AnyStoreTest {
 protected:
  /// A map with two slabs of three tiles each, seen from above, where nobody has moved anything yet.
  void Create() {
    map_ = std::make_unique<Map>(generator_.Info("house"));
    for (int n = 0; n < 2; ++n) {
      Submap& slab = map_->Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.05, .truncation_m = 0.2});
      for (int i = 0; i < 12; ++i) {
        TsdfBlock& block = slab.MutableTsdf({i, n, 0});
        for (int v = 0; v < kBlockVoxels; ++v) {
          block.distance_m[v] = static_cast<float>(0.05 * (VoxelIn({}, v).z - 4));
          block.weight[v] = VoxelIn({}, v).z >= 2 ? 1 : 0;
        }
      }
      slab.UpdateBoundingSphere();
    }
    generator_.AddVoxels(map_->mutable_free_space());
    ASSERT_TRUE(store_->CreateMap(*map_->Publish(1)).ok());
  }
  /// As a session moves an object.
  std::shared_ptr<const MapSnapshot> Move(SubmapId id) {
    Submap& submap = *map_->FindMutable(id);
    submap.mutable_info().T_map_submap.translation().x() += 3;
    submap.mutable_info().is_placed = true;
    map_->NoteLeaving(id);
    return map_->Publish(2);
  }
  /// As an edit of the state that the marks, and `before`, are of.
  Status CommitEdit(const StateMarks& marks, const std::shared_ptr<const MapSnapshot>& before,
                    const std::shared_ptr<const MapSnapshot>& after) {
    return store_->CommitEdit(marks, *after,
                              {.entry = {after->revision(), 30, {}, {}}, .answer = "", .before = before});
  }
  std::shared_ptr<const MapSnapshot> MoveAndStore(SubmapId id) {
    const auto before = map_->published();
    auto after = Move(id);
    const Status done = CommitEdit(*before, before, after);
    EXPECT_TRUE(done.ok()) << done.ToString();
    return after;
  }
  static StateMarks Lacking(const MapSnapshot& state) { return {state, nullptr, true}; }
  void ExpectAllIsWritten(const MapSnapshot& state) {
    EXPECT_EQ(Query(kLeaving), -1);
    EXPECT_GT(Query(kVacatedTiles), 0);
    ExpectStored(state);
    EXPECT_EQ(Query(kWrongSizes), 0);
    EXPECT_EQ(Query("SELECT history_bytes FROM edit_totals"), Query("SELECT sum(num_bytes) FROM edit_histories"));
    const auto report = store_->VerifyMap("house", false, {});
    ASSERT_TRUE(report.ok()) << report.status().ToString();
    EXPECT_EQ(report->num_faults, 0) << report->faults[0].place << " " << report->faults[0].what;
  }
  /// What undoes the move takes back all that it has left.
  void ExpectKeptFor(std::int64_t revision, const FreeSpace& left) {
    const auto edit = store_->LoadEdit("house", revision);
    ASSERT_TRUE(edit.ok()) << edit.status().ToString();
    FreeSpace after;
    for (const VacatedDelta& tile : edit->vacated) {
      EXPECT_EQ(tile.before, nullptr);
      after.Put(tile.index, tile.after);
    }
    ExpectSameVoxels(left, after);
  }

  std::unique_ptr<Map> map_;
};

/// By SQL of SQLite's own.
class LeavingTestInAFile : public LeavingTest {};
class LeavingTestPaged : public LeavingTest {};

TEST_P(LeavingTest, AMoveIsStoredWithoutWhatItLeftAndTheNextCommitWritesThat) {
  Open();
  Create();
  const std::int64_t num_blobs = Query("SELECT count(*) FROM tile_blobs");
  const auto moved = MoveAndStore(SubmapId(1));
  EXPECT_EQ(Query(kLeaving), 1);
  EXPECT_EQ(Query("SELECT count(*) FROM tile_blobs"), num_blobs);
  EXPECT_TRUE(moved->noted_vacated()->empty());
  EXPECT_GT(moved->vacated()->NumFreeVoxels(), 0);
  ExpectStored(*moved);  // whoever loads it works it out
  ASSERT_TRUE(store_->Commit(Lacking(*moved), *moved, Durability::kNormal).ok());
  ExpectAllIsWritten(*moved);
  ExpectKeptFor(moved->revision(), *moved->vacated());
  ASSERT_TRUE(store_->Commit(*moved, *moved, Durability::kNormal).ok()) << "once more";
  ExpectAllIsWritten(*moved);
}

TEST_P(LeavingTestInAFile, WhatSeveralObjectsOfOneEditLeaveInTheSameTilesIsWrittenAndUndone) {
  Open();
  Create();
  const auto before = map_->published();
  for (const std::uint32_t id : {1u, 2u}) {
    Submap& submap = *map_->FindMutable(SubmapId(id));
    submap.mutable_info().T_map_submap.translation().x() += 3;
    submap.mutable_info().is_placed = true;
    map_->NoteLeaving(SubmapId(id));
  }
  const auto moved = map_->Publish(2);
  EXPECT_EQ(moved->leaving(), SubmapId(2));
  EXPECT_FALSE(moved->noted_vacated()->empty()) << "what the first has left is known";
  ASSERT_TRUE(CommitEdit(*before, before, moved).ok());
  const Status done = store_->Commit(Lacking(*moved), *moved, Durability::kNormal);
  ASSERT_TRUE(done.ok()) << done.ToString();
  ExpectAllIsWritten(*moved);
  ExpectKeptFor(moved->revision(), *moved->vacated());
  EXPECT_EQ(Query("SELECT count(*) FROM shared_blobs WHERE num_more <> (SELECT count(*) FROM blob_references r WHERE "
                  "r.blob_key = shared_blobs.blob_key) - 1"),
            0);
  EXPECT_EQ(Query("SELECT count(*) FROM dead_blobs WHERE blob_key IN (SELECT blob_key FROM blob_references)"), 0);
  map_->FindMutable(SubmapId(1))->mutable_info().display_name = "another";
  const auto renamed = map_->Publish(3);
  EXPECT_TRUE(CommitEdit(*moved, moved, renamed).ok());
}

TEST_P(LeavingTest, ACommitOfALaterStateWritesItToo) {
  Open();
  Create();
  const auto moved = MoveAndStore(SubmapId(1));
  map_->mutable_info().num_frames += 1;
  FreeBlocks seen;
  seen.full = ~std::uint64_t{0};
  for (int x = -2; x < 6; ++x) map_->mutable_free_space().Add({x, 0, 0}, seen, 7);
  const auto later = map_->Publish(3);
  EXPECT_GT(later->vacated()->NumFreeVoxels(), 0) << "what was seen later does not count";
  ASSERT_TRUE(store_->Commit(Lacking(*moved), *later, Durability::kNormal).ok());
  ExpectAllIsWritten(*later);
  ExpectKeptFor(moved->revision(), *moved->vacated());
}

TEST_P(LeavingTest, WhoOpensTheStoreBetweenTheTwoGoesOn) {
  Create();
  const auto moved = MoveAndStore(SubmapId(2));
  Open();
  const auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  EXPECT_EQ((*loaded)->leaving(), SubmapId(2));
  ExpectSameMap(*moved, **loaded);
  map_ = std::make_unique<Map>(*loaded);
  map_->FindMutable(SubmapId(1))->mutable_info().display_name = "another";
  const auto later = map_->Publish(3);
  ASSERT_TRUE(store_->Commit(Lacking(**loaded), *later, Durability::kNormal).ok());
  ExpectAllIsWritten(*later);
  ExpectKeptFor(moved->revision(), *moved->vacated());
}

TEST_P(LeavingTest, AnEditComesOnlyAfterWhatTheOneBeforeHasLeft) {
  Open();
  Create();
  const auto first = MoveAndStore(SubmapId(1));
  const auto second = Move(SubmapId(2));
  EXPECT_EQ(CommitEdit(Lacking(*first), first, second).reason(), Reason("STALE_STATE"));
  ASSERT_TRUE(store_->Commit(Lacking(*first), *first, Durability::kNormal).ok());
  const Status done = CommitEdit(*first, first, second);
  ASSERT_TRUE(done.ok()) << done.ToString();
  EXPECT_EQ(Query(kLeaving), 2);
  ExpectStored(*second);
  ASSERT_TRUE(store_->Commit(Lacking(*second), *second, Durability::kNormal).ok());
  ExpectAllIsWritten(*second);
  ExpectKeptFor(first->revision(), *first->vacated());
}

TEST_P(LeavingTestInAFile, ANumberThatIsNoSubmapsMeansNothingAndKeepsNoEditOff) {
  Open();
  Create();
  const auto before = map_->published();
  store_ = nullptr;
  {
    auto database = sqlite::Database::Open(kept_.Path(), sqlite::OpenMode::kReadWrite, 1000);
    ASSERT_TRUE(database.ok());
    const auto head = ReadMapHead(*database, "house");
    ASSERT_TRUE(head.ok());
    ASSERT_TRUE(UpdateMap(*database, *head, before->info(), *before, {head->tiles, SubmapId(77)}).ok());
  }
  Open();
  ASSERT_EQ(Query(kLeaving), 77);
  const auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  EXPECT_FALSE((*loaded)->leaving());
  EXPECT_FALSE(Lacking(**loaded).lacks_left());
  map_ = std::make_unique<Map>(*loaded);
  const auto moved = Move(SubmapId(1));
  const Status done = CommitEdit(Lacking(**loaded), *loaded, moved);
  ASSERT_TRUE(done.ok()) << done.ToString();
  EXPECT_EQ(Query(kLeaving), 1);
}

TEST_P(LeavingTest, ARepairThatDropsTheObjectForgetsItsNumber) {
  Open();
  Create();
  MoveAndStore(SubmapId(1));
  Tamper("UPDATE submaps SET checksum = checksum + 1 WHERE submap_id = 1");
  const auto report = store_->VerifyMap("house", true, {});
  ASSERT_TRUE(report.ok()) << report.status().ToString();
  EXPECT_TRUE(report->is_repaired);
  EXPECT_EQ(Query("SELECT count(*) FROM submaps WHERE submap_id = 1"), 0);
  EXPECT_EQ(Query(kLeaving), -1);
}

TEST_P(LeavingTest, AFileThatGoesOutBetweenTheTwoHasIt) {
  Open();
  Create();
  const auto moved = MoveAndStore(SubmapId(1));
  auto file = store_->ExportMap("house", {});
  ASSERT_TRUE(file.ok()) << file.status().ToString();
  auto import = store_->ImportMap();
  ASSERT_TRUE(import.ok());
  for (;;) {
    const auto piece = (*file)->Read(1 << 16);
    ASSERT_TRUE(piece.ok());
    if (piece->empty()) break;
    ASSERT_TRUE((*import)->Write(*piece).ok());
  }
  const auto name = (*import)->LookThrough({});
  ASSERT_TRUE(name.ok()) << name.status().ToString();
  ASSERT_TRUE((*import)->Bring({}).ok());
  ASSERT_TRUE((*import)->Add("copy").ok());
  const auto copy = store_->LoadMap("copy");
  ASSERT_TRUE(copy.ok()) << copy.status().ToString();
  EXPECT_EQ((*copy)->leaving(), SubmapId(1));
  ExpectSameVoxels(*moved->vacated(), *(*copy)->vacated());
  Map next(*copy);
  next.mutable_info().num_frames += 1;
  ASSERT_TRUE(store_->Commit(Lacking(**copy), *next.Publish(4), Durability::kNormal).ok());
  EXPECT_EQ(store_->VerifyMap("copy", false, {})->num_faults, 0);
  ExpectSameVoxels(*moved->vacated(), *(*store_->LoadMap("copy"))->vacated());
}

TEST_P(LeavingTest, NothingThatUndoesItNeedBeKept) {
  Open({.edits = {.max_histories = 0}});
  Create();
  const auto moved = MoveAndStore(SubmapId(1));
  ASSERT_TRUE(store_->Commit(Lacking(*moved), *moved, Durability::kNormal).ok());
  EXPECT_EQ(Query("SELECT count(*) FROM edit_tiles"), 0);
  ExpectStored(*moved);
  EXPECT_EQ(store_->VerifyMap("house", false, {})->num_faults, 0);
}

TEST_P(LeavingTest, WhatIsTooLargeWithItIsNotKept) {
  Open({.edits = {.max_history_bytes = 400}});
  Create();
  const auto moved = MoveAndStore(SubmapId(1));
  ASSERT_TRUE(store_->LoadEdit("house", moved->revision()).ok());
  ASSERT_TRUE(store_->Commit(Lacking(*moved), *moved, Durability::kNormal).ok());
  EXPECT_EQ(store_->LoadEdit("house", moved->revision()).status().reason(), Reason("UNDO_NOT_KEPT"));
  EXPECT_EQ(Query("SELECT count(*) FROM edit_tiles"), 0);
  EXPECT_EQ(store_->VerifyMap("house", false, {})->num_faults, 0);
}

TEST_P(LeavingTestPaged, AnObjectThatCannotBeReadLeavesNothingAndTheMapGoesOn) {
  Open();
  Create();
  Open();
  Tamper(
      "DELETE FROM tile_blobs WHERE blob_key IN (SELECT blob_key FROM tiles WHERE layer = 1 AND owner_key = (SELECT "
      "submap_key FROM submaps WHERE submap_id = 1))");
  map_ = std::make_unique<Map>(store_->LoadMap("house").value());
  const auto moved = MoveAndStore(SubmapId(1));
  EXPECT_TRUE(moved->vacated()->empty());
  map_->FindMutable(SubmapId(2))->mutable_info().display_name = "another";
  ASSERT_TRUE(store_->Commit(Lacking(*moved), *map_->Publish(3), Durability::kNormal).ok());
  EXPECT_EQ(Query(kLeaving), -1);
}

INSTANTIATE_TEST_SUITE_P(Stores, LeavingTest,
                         ::testing::Values(StoreKind::kSqlite, StoreKind::kPaged, StoreKind::kPostgres),
                         testing::NameOfKind);
INSTANTIATE_TEST_SUITE_P(Stores, LeavingTestPaged, ::testing::Values(StoreKind::kPaged), testing::NameOfKind);
INSTANTIATE_TEST_SUITE_P(Stores, LeavingTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
