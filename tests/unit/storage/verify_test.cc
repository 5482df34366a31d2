// SPDX-License-Identifier: BSD-3-Clause
// VerifyMap finds what was changed behind the store's back, and a repair keeps all else.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::SqliteStoreTest;
using Kind = MapFault::Kind;

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
    other_ = CreateSample("other");
    store_ = nullptr;
    fs::copy_file(Path(), Path() + ".intact");
    Open();
  }
  void Damage(const std::string& sql) {
    store_ = nullptr;
    fs::copy_file(Path() + ".intact", Path(), fs::copy_options::overwrite_existing);
    Tamper(sql);
    Open();
  }

  std::unique_ptr<Map> map_, other_;
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
  Kind kind;
  const char* place;  ///< begins so
};

const std::vector<Case>& Cases() {
  static const std::vector<Case> cases = {
      {"UPDATE tile_blobs SET blob = CAST(substr(blob, 1, 30) || x'5A' || substr(blob, 32) AS BLOB) WHERE blob_key = "
       "(SELECT min(blob_key) FROM tiles WHERE layer = 1 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key "
       "= "
       "1 AND submap_id = 3))",
       Kind::kBlob, "submap 3: tsdf tile ("},
      {"DELETE FROM tile_blobs WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE layer = 2 AND owner_key = "
       "(SELECT "
       "submap_key FROM submaps WHERE map_key = 1 AND submap_id = 1))",
       Kind::kBlob, "submap 1: label tile ("},
      {"UPDATE tile_blobs SET blob = x'00' WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE owner_key = -1)",
       Kind::kBlob, "free-space tile ("},
      {"UPDATE submaps SET track_id = track_id + 1 WHERE map_key = 1 AND submap_id = 3", Kind::kRow, "submap 3"},
      {"DELETE FROM submaps WHERE map_key = 1 AND submap_id = 3", Kind::kCount, "map"},
      {"DELETE FROM tiles WHERE layer = 4 AND owner_key = (SELECT submap_key FROM submaps WHERE map_key = 1 AND "
       "submap_id = 1)",
       Kind::kCount, "submap 1"},
      {"DELETE FROM tiles WHERE owner_key = -1 AND layer = 5", Kind::kCount, "map"},
      {"UPDATE submap_boxes SET max_x_m = min_x_m WHERE submap_key = (SELECT submap_key FROM submaps WHERE map_key = 1 "
       "AND submap_id = 1)",
       Kind::kBounds, "submap 1"},
      {"INSERT INTO tile_blobs (num_blocks, blob) VALUES (1, x'00')", Kind::kReference, "database"},
      {"DELETE FROM shared_blobs", Kind::kReference, "database"},
      {"UPDATE tile_blobs SET num_blocks = num_blocks + 1 WHERE blob_key = (SELECT min(blob_key) FROM tiles WHERE "
       "layer = "
       "1)",
       Kind::kCount, "submap "},
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

TEST_F(VerifyTest, AMapWhoseOwnRowIsDamagedIsToldAndNotTouched) {
  Damage("UPDATE maps SET num_frames = 77 WHERE name = 'house'");
  const VerifyReport found = Verify();
  ASSERT_EQ(found.num_faults, 1);
  EXPECT_EQ(found.faults[0].kind, Kind::kRow);
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
  EXPECT_EQ(store_->VerifyMap("settled", false, {})->num_shared_voxels, 20);
}

}  // namespace
}  // namespace dhpmap
