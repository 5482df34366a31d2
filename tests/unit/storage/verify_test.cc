// SPDX-License-Identifier: BSD-3-Clause
// VerifyMap finds what was changed behind the store's back, and a repair keeps all else.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "storage/paging/shared_voxels.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::SqliteStoreTest;
using FaultKind = MapFault::Kind;

class VerifyTest : public SqliteStoreTest {
 protected:
  VerifyReport Verify(bool repair = false) {
    auto report = store_->VerifyMap("house", repair, {});
    EXPECT_TRUE(report.ok()) << report.status().ToString();
    return report.ok() ? std::move(report).value() : VerifyReport();
  }
  /// A map with clones, from which each case starts.
  void SetUp() override {
    Open();
    map_ = CreateSample("house");
    const auto before = map_->published();
    map_->Clone(SubmapId(2));
    generator_.AddVoxels(map_->mutable_vacated());
    ASSERT_TRUE(store_->Commit(*before, *map_->Publish(20), Durability::kFull).ok());
    generator_.AddBlocks(*map_->FindMutable(SubmapId(3)), 40);  // in each of its tiles
    CommitEdit({.author = "anna"}, {});
    edited_revision_ = map_->info().revision;
    map_->FindMutable(SubmapId(2))->mutable_info().display_name = "a chair";
    CommitEdit({}, {.kind = EditKind::kUndo, .targets = {edited_revision_}});
    map_->FindMutable(SubmapId(2))->mutable_info().display_name = "a table";
    CommitEdit({.author = "ben", .request_id = "abc", .request_fingerprint = 7}, {});
    other_ = CreateSample("other");
    store_ = nullptr;
    fs::copy_file(Path(), Path() + ".intact");
    Open();
  }
  void CommitEdit(EditSource source, EditSummary summary) {
    const auto before = map_->published();
    const auto after = map_->Publish(30);
    const EditRecord record{
        .entry = {after->revision(), 30, std::move(source), std::move(summary)}, .answer = "done", .before = before};
    ASSERT_TRUE(store_->CommitEdit(*before, *after, record).ok());
  }
  std::vector<LoggedEdit> Edits() {
    auto edits = store_->ListEdits("house", {});
    EXPECT_TRUE(edits.ok()) << edits.status().ToString();
    return edits.ok() ? std::move(edits).value() : std::vector<LoggedEdit>();
  }
  void Damage(const std::string& sql) {
    store_ = nullptr;
    fs::copy_file(Path() + ".intact", Path(), fs::copy_options::overwrite_existing);
    Tamper(sql);
    Open();
  }

  static constexpr std::size_t kNumEdits = 3;
  std::unique_ptr<Map> map_, other_;
  std::int64_t edited_revision_ = 0;  ///< of the edit that is undone afterwards
};

TEST_F(VerifyTest, AnIntactMapHasNoFaultsAndIsCounted) {
  const VerifyReport report = Verify();
  EXPECT_EQ(report.num_faults, 0) << report.faults[0].place << " " << report.faults[0].what;
  EXPECT_EQ(report.revision, map_->published()->revision());
  EXPECT_EQ(report.num_submaps, static_cast<std::int64_t>(map_->submaps().size()));
  std::int64_t num_blocks = 0;
  for (const auto& submap : map_->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      num_blocks += (entry.tsdf != nullptr) + (entry.labels != nullptr) + (entry.gone != nullptr);
    }
  }
  EXPECT_EQ(report.num_blocks, num_blocks);
  EXPECT_EQ(report.blob_bytes, store_->GetMap("house")->blob_bytes);
  EXPECT_EQ(store_->VerifyMap("none", false, {}).status().code(), StatusCode::kNotFound);
  EXPECT_FALSE(Verify(true).is_repaired) << "there is nothing to repair";
  ExpectStored(*map_->published());
}

struct Case {
  const char* damage;
  FaultKind kind;
  const char* place;  ///< begins so
};

const std::vector<Case>& Cases() {
  static const std::vector<Case> cases = {
      {"UPDATE tile_blobs SET blob = CAST(substr(blob, 1, 30) || x'5A' || substr(blob, 32) AS BLOB) WHERE blob_key = "
       "(SELECT min(blob_key) FROM tiles WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key "
       "= "
       "1 AND submap_id = 3))",
       FaultKind::kBlob, "submap 3: tsdf tile ("},
      {"DELETE FROM tile_blobs WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE layer = 2 AND owner_key = "
       "(SELECT "
       "submap_key FROM submaps WHERE map_key = 1 AND submap_id = 1))",
       FaultKind::kBlob, "submap 1: label tile ("},
      {"UPDATE tile_blobs SET blob = x'00' WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE owner_key = -1)",
       FaultKind::kBlob, "free-space tile ("},
      {"UPDATE submaps SET track_id = track_id + 1 WHERE map_key = 1 AND submap_id = 3", FaultKind::kRow, "submap 3"},
      {"DELETE FROM submaps WHERE map_key = 1 AND submap_id = 3", FaultKind::kCount, "map"},
      {"DELETE FROM tiles WHERE layer = 4 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND "
       "submap_id = 1)",
       FaultKind::kCount, "submap 1"},
      {"UPDATE tiles SET cells = -1 WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 "
       "AND submap_id = 1)",
       FaultKind::kCount, "submap 1: tsdf tile ("},
      {"UPDATE tiles SET extent = extent - (1 << 7) WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps "
       "WHERE map_key = 1 "
       "AND submap_id = 1)",
       FaultKind::kCount, "submap 1: tsdf tile ("},
      {"DELETE FROM tiles WHERE owner_key = -1 AND layer = 5", FaultKind::kCount, "map"},
      {"UPDATE submap_boxes SET max_x_m = min_x_m WHERE submap_key = (SELECT submap_key FROM submaps WHERE map_key = 1 "
       "AND submap_id = 1)",
       FaultKind::kBounds, "submap 1"},
      {"INSERT INTO tile_blobs (num_blocks, blob) VALUES (1, x'00')", FaultKind::kReference, "database"},
      {"DELETE FROM shared_blobs", FaultKind::kReference, "database"},
      {"UPDATE tile_blobs SET num_blocks = num_blocks + 1 WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE "
       "layer = "
       "1)",
       FaultKind::kCount, "submap "},
      {"DELETE FROM submap_boxes WHERE submap_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND submap_id = "
       "1)",
       FaultKind::kBounds, "submap 1"},
      {"INSERT INTO submap_boxes VALUES (999, 0, 1, 0, 1, 0, 1, 1)", FaultKind::kReference, "database"},
      {"UPDATE shared_blobs SET num_more = num_more + 1", FaultKind::kReference, "database"},
      {"INSERT INTO tiles SELECT 999, x, y, z, layer, blob_key, cells, extent FROM tiles WHERE owner_key = -1",
       FaultKind::kReference, "database"},
      {"INSERT INTO map_config VALUES (77, 'voxel_size_m', '1')", FaultKind::kReference, "database"},
      {"DELETE FROM edits WHERE request_id = 'abc'", FaultKind::kReference, "database"},
      {"UPDATE edits SET author = 'eve' WHERE author = 'ben'", FaultKind::kRow, "edit "},
      {"UPDATE edits SET answer = x'00' WHERE request_id = 'abc'", FaultKind::kRow, "edit "},
      {"UPDATE edit_histories SET num_bytes = num_bytes + 1", FaultKind::kRow, "what undoes edit "},
      {"UPDATE edit_histories SET tiles_sum = 5", FaultKind::kRow, "what undoes edit "},
      {"DELETE FROM edit_tiles WHERE layer = 1", FaultKind::kCount, "what undoes edit "},
      {"UPDATE edit_tiles SET submap_id = 9 WHERE layer = 1", FaultKind::kReference, "edit "},
      {"INSERT INTO edit_tiles SELECT 999, submap_id, x, y, z, layer, before_key, after_key FROM edit_tiles",
       FaultKind::kReference, "database"},
      {"DELETE FROM tile_blobs WHERE blob_key = (SELECT max(before_key) FROM edit_tiles WHERE before_key NOT IN "
       "(SELECT blob_key FROM tiles))",
       FaultKind::kBlob, "edit "},
      {"UPDATE tile_blobs SET blob = x'00' WHERE blob_key = (SELECT max(before_key) FROM edit_tiles WHERE before_key "
       "NOT IN (SELECT blob_key FROM tiles))",
       FaultKind::kBlob, "edit "},
      {"DELETE FROM edit_targets", FaultKind::kReference, "edit "},
      {"INSERT INTO edit_targets VALUES (1, 999, 1000, 1)", FaultKind::kReference, "edit 1000"},
      {"UPDATE edit_totals SET num_edits = num_edits + 1", FaultKind::kCount, "edits"},
      {"UPDATE edit_totals SET history_bytes = 0", FaultKind::kCount, "edits"},
      {"DELETE FROM edit_totals", FaultKind::kCount, "edits"},
      {"UPDATE changes SET time_ns = time_ns + 1 WHERE map_key = 1", FaultKind::kRow, "change of revision "},
      {"UPDATE changes SET blob = x'00' WHERE map_key = 1", FaultKind::kRow, "change of revision "},
      {"DELETE FROM changes WHERE change_key = (SELECT max(change_key) FROM changes WHERE map_key = 1)",
       FaultKind::kCount, "changes"},
      {"DELETE FROM changes WHERE change_key = (SELECT max(change_key) - 1 FROM changes WHERE map_key = 1)",
       FaultKind::kCount, "changes"},
      {"UPDATE change_logs SET num_bytes = 1 WHERE map_key = 1", FaultKind::kRow, "changes"},
  };
  return cases;
}

TEST_F(VerifyTest, EachFaultIsToldWithItsPlaceAndARepairKeepsTheRest) {
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.damage);
    Damage(c.damage);
    const VerifyReport found = Verify();
    ASSERT_GT(found.num_faults, 0);
    EXPECT_TRUE(
        std::any_of(found.faults.begin(), found.faults.end(),
                    [&c](const MapFault& fault) { return fault.kind == c.kind && fault.place.starts_with(c.place); }))
        << found.faults[0].place << ": " << found.faults[0].what;
    EXPECT_FALSE(found.is_repaired);
    ExpectStored(*other_->published());

    const VerifyReport repaired = Verify(true);
    EXPECT_TRUE(repaired.is_repaired);
    EXPECT_EQ(repaired.num_faults, found.num_faults);
    EXPECT_EQ(Verify().num_faults, 0);
    const auto loaded = store_->LoadMap("house");
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    EXPECT_EQ((*loaded)->revision(), map_->published()->revision() + 1);
    EXPECT_EQ((*loaded)->revision(), repaired.revision);
    // No commit made it so: who follows the map lists it again.
    const auto changes = store_->ListChanges("house", map_->published()->revision(), 1 << 20);
    EXPECT_EQ(changes.status().reason().name(), "COMPACTED");
    // Submap 2 and its clone are in none of the cases that lose anything.
    for (const SubmapId id : {SubmapId(2), map_->submaps().back()->id()}) {
      const Submap* kept = (*loaded)->Find(id);
      ASSERT_NE(kept, nullptr);
      EXPECT_EQ(kept->blocks().size(), map_->Find(id)->blocks().size());
    }
    ExpectStored(*other_->published());

    // It can be written on, and loses nothing by that.
    Map next(*loaded);
    next.mutable_info().num_frames += 1;
    next.Clone(SubmapId(2));
    ASSERT_TRUE(store_->Commit(**loaded, *next.Publish(50), Durability::kNormal).ok());
    ExpectStored(*next.published());
    EXPECT_EQ(Verify().num_faults, 0);
  }
}

TEST_F(VerifyTest, AnEditThatCannotBeReadGoesAndTheOthersStay) {
  Damage("UPDATE edits SET author = 'eve' WHERE author = 'ben'");
  EXPECT_EQ(store_->ListEdits("house", {}).status().reason(), Reason("DAMAGED_EDITS"));
  EXPECT_TRUE(Verify(true).is_repaired);
  EXPECT_EQ(Edits().size(), kNumEdits - 1);
  EXPECT_FALSE(store_->FindAnswer("house", "abc")->has_value());
  EXPECT_TRUE(store_->LoadEdit("house", edited_revision_).ok()) << "the state is what it was";
  for (const LoggedEdit& edit : Edits()) {
    EXPECT_EQ(edit.is_undone, edit.entry.revision == edited_revision_);
  }
}

TEST_F(VerifyTest, AnEditWhoseTilesAreLostStaysInTheLogAndCannotBeUndone) {
  Damage(
      "DELETE FROM tile_blobs WHERE blob_key = (SELECT max(before_key) FROM edit_tiles WHERE before_key NOT IN (SELECT "
      "blob_key FROM tiles))");
  EXPECT_TRUE(Verify(true).is_repaired);
  EXPECT_EQ(Edits().size(), kNumEdits);
  EXPECT_EQ(store_->LoadEdit("house", edited_revision_).status().reason(), Reason("UNDO_NOT_KEPT"));
  EXPECT_TRUE(store_->LoadEdit("house", map_->info().revision).ok()) << "it has no such tile";
}

TEST_F(VerifyTest, WhereTheStateIsAnotherNothingIsUndoneButRepeatedRequestsFindTheirAnswers) {
  Damage("DELETE FROM tiles WHERE owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND submap_id = 1)");
  EXPECT_TRUE(Verify(true).is_repaired);
  EXPECT_EQ(Edits().size(), kNumEdits);
  EXPECT_EQ(store_->LoadEdit("house", map_->info().revision).status().reason(), Reason("UNDO_NOT_KEPT"));
  const auto answer = store_->FindAnswer("house", "abc");
  ASSERT_TRUE(answer.ok() && answer->has_value());
  EXPECT_EQ((*answer)->answer, "done");
}

TEST_F(VerifyTest, WhatWasUndoneSaysSoAgainOnceRepaired) {
  Damage("DELETE FROM edit_targets");
  for (const LoggedEdit& edit : Edits()) EXPECT_FALSE(edit.is_undone);
  EXPECT_TRUE(Verify(true).is_repaired);
  int num_undone = 0;
  for (const LoggedEdit& edit : Edits()) {
    num_undone += edit.is_undone;
    EXPECT_EQ(edit.is_undone, edit.entry.revision == edited_revision_);
  }
  EXPECT_EQ(num_undone, 1);
}

TEST_F(VerifyTest, WhatALostMapLeftIsToldAndGoes) {
  Damage("DELETE FROM maps WHERE name = 'other'");
  const VerifyReport found = Verify();
  ASSERT_GT(found.num_faults, 0);
  for (const MapFault& fault : found.faults) {
    EXPECT_EQ(fault.kind, FaultKind::kReference) << fault.what;
    EXPECT_EQ(fault.place, "database");
  }
  EXPECT_TRUE(Verify(true).is_repaired);
  EXPECT_EQ(Verify().num_faults, 0);
  EXPECT_EQ(Query("SELECT count(*) FROM submaps WHERE map_key <> 1"), 0);
  const auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  EXPECT_EQ((*loaded)->submaps().size(), map_->submaps().size());
}

TEST_F(VerifyTest, EachBlobThatBelongsToNothingIsNamed) {
  Damage("INSERT INTO tile_blobs (blob_key, num_blocks, blob) VALUES (700001, 1, x'00'), (700002, 1, x'00')");
  const VerifyReport found = Verify();
  ASSERT_EQ(found.num_faults, 2);
  EXPECT_EQ(found.faults[0].what, "blob 700001 belongs to nothing");
  EXPECT_EQ(found.faults[1].what, "blob 700002 belongs to nothing");
}

TEST_F(VerifyTest, AMapWhoseOwnRowIsDamagedIsToldAndNotTouched) {
  Damage("UPDATE maps SET num_frames = 77 WHERE name = 'house'");
  const VerifyReport found = Verify();
  ASSERT_EQ(found.num_faults, 1);
  EXPECT_EQ(found.faults[0].kind, FaultKind::kRow);
  EXPECT_EQ(found.faults[0].place, "map");
  const std::int64_t num_tiles = Query("SELECT count(*) FROM tiles");
  EXPECT_EQ(store_->VerifyMap("house", true, {}).status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(Query("SELECT count(*) FROM tiles"), num_tiles);
}

TEST_F(VerifyTest, AMapOfALaterVersionIsLeftAlone) {
  Damage("UPDATE tiles SET layer = 9 WHERE layer = 4");
  for (const bool repair : {false, true}) {
    EXPECT_EQ(store_->VerifyMap("house", repair, {}).status().reason(), Reason("NEWER_LAYER"));
  }
}

TEST_F(VerifyTest, FaultsHaveABoundAndTheirNumberHasNone) {
  Map map(generator_.Info("large"));
  Submap& submap = generator_.AddSubmap(map, 0);
  for (int n = 0; n < 1200; ++n) submap.MutableTsdf({4 * n, 0, 0}).weight[0] = 1;
  submap.UpdateBoundingSphere();
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  Tamper("UPDATE tile_blobs SET blob = x'00'");
  const auto report = store_->VerifyMap("large", false, {});
  ASSERT_TRUE(report.ok());
  EXPECT_GE(report->num_faults, 1200);
  EXPECT_EQ(report->faults.size(), VerifyReport::kMaxFaults);
}

TEST_F(VerifyTest, StopsWhenNobodyWaits) {
  Map map(generator_.Info("large"));
  Submap& submap = generator_.AddSubmap(map, 0);
  for (int n = 0; n < 200; ++n) submap.MutableTsdf({4 * n, 0, 0}).weight[0] = 1;
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(store_->VerifyMap("large", false, stop.get_token()).status().code(), StatusCode::kCancelled);
}

TEST_F(VerifyTest, CommitsGoOnMeanwhile) {
  std::atomic<bool> is_over = false;
  std::atomic<int> num_commits = 0;
  std::thread writer([&] {
    while (!is_over) {
      const auto before = other_->published();
      generator_.AddBlocks(*other_->FindMutable(SubmapId(1)), 2);
      EXPECT_TRUE(store_->Commit(*before, *other_->Publish(100 + num_commits), Durability::kNormal).ok());
      ++num_commits;
    }
  });
  for (int n = 0; n < 100 && num_commits < 20; ++n) EXPECT_EQ(Verify().num_faults, 0);
  is_over = true;
  writer.join();
  EXPECT_GT(num_commits, 3);
  ExpectStored(*other_->published());
}

TEST_F(VerifyTest, SettledObjectsThatShareVoxelsAreCounted) {
  Map map(generator_.Info("settled"));
  for (int n = 0; n < 2; ++n) {
    SubmapInfo info;
    info.panoptic = Panoptic::kThing;
    info.voxel_size_m = 0.05;
    info.truncation_m = 0.2;
    info.activity = Activity::kInactive;
    Submap& submap = map.Create(info);
    for (std::size_t v = 0; v < 30; ++v) submap.MutableTsdf({1, 2, 3}).weight[v + 10 * static_cast<std::size_t>(n)] = 1;
    submap.UpdateBoundingSphere();
  }
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  const auto report = store_->VerifyMap("settled", false, {});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->num_faults, 0) << "what is not refined yet is no fault";
  EXPECT_EQ(report->num_shared_voxels, 20);
  ASSERT_EQ(report->shared_places.size(), 1u);
  const SharedPlace& place = report->shared_places[0];
  EXPECT_EQ(place.first, map.submaps()[1]->id()) << "after that of points of no known object";
  EXPECT_EQ(place.second, map.submaps()[2]->id());
  EXPECT_EQ(place.block, (BlockIndex{1, 2, 3}));
  EXPECT_EQ(place.num_voxels, 20);
}

TEST(SharedVoxelsTest, AVoxelOfThreeObjectsCountsTwiceAndEachPairIsTold) {
  SharedVoxels shared;
  for (std::uint32_t id = 1; id <= 3; ++id) {
    BlockTile tile;
    auto block = std::make_shared<TsdfBlock>();
    for (std::size_t v = 0; v < 5; ++v) block->weight[v] = 1;
    tile.FindOrInsert({0, 0, 0}).tsdf = block;
    tile.FindOrInsert({1, 0, 0}).tsdf = std::make_shared<TsdfBlock>();  // nobody has seen any of it
    shared.Add(SubmapId(id), tile);
  }
  EXPECT_EQ(shared.num_shared(), 10);
  ASSERT_EQ(shared.places().size(), 3u);
  EXPECT_EQ(shared.places()[2].first, SubmapId(2));
  EXPECT_EQ(shared.places()[2].second, SubmapId(3));
}

}  // namespace
}  // namespace dhpmap
