// SPDX-License-Identifier: BSD-3-Clause
// VerifyMap finds what was changed behind the store's back, and a repair keeps all else.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "storage/paging/shared_voxels.h"
#include "tests/unit/storage/any_store_fixture.h"
#include "tests/unit/storage/verify_cases.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::FaultKind;
using testing::StoreKind;

class VerifyTest : public AnyStoreTest {
 protected:
  VerifyReport Verify(bool repair = false) {
    auto report = store_->VerifyMap("house", repair, {});
    EXPECT_TRUE(report.ok()) << report.status().ToString();
    return report.ok() ? std::move(report).value() : VerifyReport();
  }
  void SetUp() override {
    AnyStoreTest::SetUp();
    if (!IsSkipped()) Make();
  }
  /// A map with clones, from which each case starts.
  void Make() {
    generator_ = testing::MapGenerator(9);
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
    BeginAnew();
    Make();
    store_ = nullptr;
    Tamper(sql);
    Open();
  }

  /// `postgres`, or what it is in SQLite.
  static std::string Of(const std::string& postgres, const std::string& sqlite = "") {
    return GetParam() == StoreKind::kPostgres ? testing::WithHouse(postgres) : sqlite;
  }

  static constexpr std::size_t kNumEdits = 3;
  std::unique_ptr<Map> map_, other_;
  std::int64_t edited_revision_ = 0;  ///< of the edit that is undone afterwards
};

/// By SQL of SQLite's own.
class VerifyTestInAFile : public VerifyTest {};

TEST_P(VerifyTest, AnIntactMapHasNoFaultsAndIsCounted) {
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

TEST_P(VerifyTest, EachFaultIsToldWithItsPlaceAndARepairKeepsTheRest) {
  for (const auto& c : testing::VerifyCasesOf(GetParam())) {
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

TEST_P(VerifyTest, AnEditThatCannotBeReadGoesAndTheOthersStay) {
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

TEST_P(VerifyTest, AnEditWhoseTilesAreLostStaysInTheLogAndCannotBeUndone) {
  const std::string lost = "DELETE FROM tile_blobs WHERE blob_key = (SELECT max(before_key) FROM edit_tiles WHERE ";
  Damage(lost + "before_key NOT IN (SELECT blob_key FROM tiles" + Of(" WHERE map_key = HOUSE))") +
         Of(" AND map_key = HOUSE", "))"));
  EXPECT_TRUE(Verify(true).is_repaired);
  EXPECT_EQ(Edits().size(), kNumEdits);
  EXPECT_EQ(store_->LoadEdit("house", edited_revision_).status().reason(), Reason("UNDO_NOT_KEPT"));
  EXPECT_TRUE(store_->LoadEdit("house", map_->info().revision).ok()) << "it has no such tile";
}

TEST_P(VerifyTest, WhereTheStateIsAnotherNothingIsUndoneButRepeatedRequestsFindTheirAnswers) {
  Damage(
      Of("DELETE FROM tiles WHERE owner_id = 1 AND map_key = HOUSE",
         "DELETE FROM tiles WHERE owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND submap_id = 1)"));
  EXPECT_TRUE(Verify(true).is_repaired);
  EXPECT_EQ(Edits().size(), kNumEdits);
  EXPECT_EQ(store_->LoadEdit("house", map_->info().revision).status().reason(), Reason("UNDO_NOT_KEPT"));
  const auto answer = store_->FindAnswer("house", "abc");
  ASSERT_TRUE(answer.ok() && answer->has_value());
  EXPECT_EQ((*answer)->answer, "done");
}

TEST_P(VerifyTest, WhatWasUndoneSaysSoAgainOnceRepaired) {
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

TEST_P(VerifyTestInAFile, WhatALostMapLeftIsToldAndGoes) {
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

TEST_P(VerifyTest, EachBlobThatBelongsToNothingIsNamed) {
  Damage(Of("INSERT INTO tile_blobs VALUES (HOUSE, 700001, 1, x'00'), (HOUSE, 700002, 1, x'00')",
            "INSERT INTO tile_blobs (blob_key, num_blocks, blob) VALUES (700001, 1, x'00'), (700002, 1, x'00')"));
  const VerifyReport found = Verify();
  ASSERT_EQ(found.num_faults, 2);
  EXPECT_EQ(found.faults[0].what, "blob 700001 belongs to nothing");
  EXPECT_EQ(found.faults[1].what, "blob 700002 belongs to nothing");
}

TEST_P(VerifyTest, AMapWhoseOwnRowIsDamagedIsToldAndNotTouched) {
  Damage("UPDATE maps SET num_frames = 77 WHERE name = 'house'");
  const VerifyReport found = Verify();
  ASSERT_EQ(found.num_faults, 1);
  EXPECT_EQ(found.faults[0].kind, FaultKind::kRow);
  EXPECT_EQ(found.faults[0].place, "map");
  const std::int64_t num_tiles = Query("SELECT count(*) FROM tiles");
  EXPECT_EQ(store_->VerifyMap("house", true, {}).status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(Query("SELECT count(*) FROM tiles"), num_tiles);
}

TEST_P(VerifyTest, AMapOfALaterVersionIsLeftAlone) {
  Damage("UPDATE tiles SET layer = 9 WHERE layer = 4");
  for (const bool repair : {false, true}) {
    EXPECT_EQ(store_->VerifyMap("house", repair, {}).status().reason(), Reason("NEWER_LAYER"));
  }
}

TEST_P(VerifyTest, FaultsHaveABoundAndTheirNumberHasNone) {
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

TEST_P(VerifyTest, StopsWhenNobodyWaits) {
  Map map(generator_.Info("large"));
  Submap& submap = generator_.AddSubmap(map, 0);
  for (int n = 0; n < 200; ++n) submap.MutableTsdf({4 * n, 0, 0}).weight[0] = 1;
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(store_->VerifyMap("large", false, stop.get_token()).status().code(), StatusCode::kCancelled);
}

TEST_P(VerifyTest, CommitsGoOnMeanwhile) {
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

TEST_P(VerifyTest, SettledObjectsThatShareVoxelsAreCounted) {
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

DHPMAP_ON_STORES_THAT_KEEP(VerifyTest);
INSTANTIATE_TEST_SUITE_P(Stores, VerifyTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

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
