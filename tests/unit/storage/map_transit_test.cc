// SPDX-License-Identifier: BSD-3-Clause
// Maps move as files between stores of every kind, and what an import leaves unfinished goes.
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "storage/postgres/pool.h"
#include "storage/postgres/transit/incoming_map.h"
#include "storage/postgres/transit/removal.h"
#include "tests/support/cut_connection.h"
#include "tests/support/eventually.h"
#include "tests/support/places.h"
#include "tests/unit/storage/any_store_fixture.h"
#include "tests/unit/storage/map_transfer.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::AnyStoreTest;
using testing::CutConnection;
using testing::ExpectSameMap;
using testing::Export;
using testing::Import;
using testing::KeptStore;
using testing::PostgresCluster;
using testing::StoreKind;

/// With clones, free and vacated space, what is locked and what is kept clear, and an edit in its log.
class TransitTest : public AnyStoreTest {
 protected:
  void SetUp() override {
    AnyStoreTest::SetUp();
    if (IsSkipped()) return;
    house_ = CreateSample("house");
    auto before = house_->published();
    house_->Clone(SubmapId(2));
    generator_.AddVoxels(house_->mutable_vacated());
    house_->FindMutable(SubmapId(2))->mutable_info().is_locked = true;
    ASSERT_TRUE(house_->mutable_info().kept_clear.Add({"door", BoundingSphere{{1.0 / 3, -2, 1}, 0.75}}).ok());
    ASSERT_TRUE(store_->Commit(*before, *house_->Publish(20), Durability::kFull).ok());
    before = house_->published();
    generator_.AddBlocks(*house_->FindMutable(SubmapId(1)), 3);
    const auto after = house_->Publish(21);
    const EditRecord edit{.entry = {after->revision(), 21, {}, {}}, .answer = "", .before = before};
    ASSERT_TRUE(store_->CommitEdit(*before, *after, edit).ok());
    street_ = CreateSample("street");
  }
  /// The house, but for its name and history.
  void ExpectHouse(MapStore& store, const std::string& name) {
    const auto loaded = store.LoadMap(name);
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    MapInfo info = house_->published()->info();
    EXPECT_NE((*loaded)->info().history_id, info.history_id);
    info.name = name;
    info.history_id = (*loaded)->info().history_id;
    ExpectSameMap(MapSnapshot(info, house_->published()->submaps(), house_->published()->free_space(),
                              VacatedSpace{house_->published()->vacated()}),
                  **loaded);
    EXPECT_EQ(store.ListEdits(name, {})->size(), 0u) << "they are of the other history";
    const auto report = store.VerifyMap(name, false, {});
    ASSERT_TRUE(report.ok()) << report.status().ToString();
    EXPECT_EQ(report->num_faults, 0) << report->faults[0].place << " " << report->faults[0].what;
  }
  std::int64_t NumTransitFiles() {
    std::int64_t num = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kept_.Folder())) {
      num += entry.path().filename().string().starts_with("map-");
    }
    return num;
  }

  std::unique_ptr<Map> house_, street_;
};

TEST_P(TransitTest, AMapGoesToAStoreOfEveryKindAndBack) {
  const std::string bytes = Export(*store_, "house");
  for (const StoreKind kind : testing::StoresThatKeep()) {
    KeptStore place(kind);
    if (!place.IsThere()) continue;
    std::unique_ptr<MapStore> other;
    place.Open(other);
    ASSERT_EQ(Import(*other, bytes).value(), "house");
    ExpectHouse(*other, "house");
    place.Open(other);
    ExpectHouse(*other, "house");
    EXPECT_EQ(other->ListChanges("house", 0, 1'000'000).status().reason(), Reason("COMPACTED"));
    const std::string back = "back-" + std::to_string(static_cast<int>(kind));
    ASSERT_EQ(Import(*store_, Export(*other, "house"), back).value(), back);
    ExpectHouse(*store_, back);
  }
  ExpectStored(*house_->published());
  EXPECT_EQ(NumTransitFiles(), 0) << "nothing is left lying about";
}

TEST_P(TransitTest, AnImportedMapIsMappedOnAndDeletedAsAnyOther) {
  ASSERT_TRUE(Import(*store_, Export(*store_, "house"), "copy").ok());
  auto loaded = store_->LoadMap("copy");
  ASSERT_TRUE(loaded.ok());
  Map map(*loaded);
  for (int n = 0; n < 4; ++n) {
    const auto before = n == 0 ? *loaded : map.published();
    generator_.Change(map);
    map.Clone(SubmapId(1));
    const Status done = store_->Commit(*before, *map.Publish(40 + n), Durability::kNormal);
    ASSERT_TRUE(done.ok()) << done.ToString();
    ExpectStored(*map.published());
  }
  ASSERT_TRUE(store_->DeleteMap("copy").ok());
  ExpectStored(*house_->published());
}

TEST_P(TransitTest, AStateIsAlwaysTheSameFile) {
  const std::string bytes = Export(*store_, "house");
  const auto before = street_->published();
  street_->Clone(SubmapId(1));
  ASSERT_TRUE(store_->Commit(*before, *street_->Publish(30), Durability::kNormal).ok());
  EXPECT_TRUE(Export(*store_, "house") == bytes);
  EXPECT_FALSE(Export(*store_, "street") == bytes);
}

TEST_P(TransitTest, MissingTakenAndUnwantedMapsAreRefused) {
  const std::string bytes = Export(*store_, "house");
  EXPECT_EQ(store_->ExportMap("none", {}).status().code(), StatusCode::kNotFound);
  EXPECT_EQ(Import(*store_, bytes).status().code(), StatusCode::kAlreadyExists);
  EXPECT_EQ(Import(*store_, bytes, "a/b").status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(Import(*store_, "a picture of a house").status().reason(), Reason("BAD_MAP"));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(store_->ExportMap("house", stop.get_token()).status().code(), StatusCode::kCancelled);
  ExpectStored(*house_->published());
  EXPECT_EQ(NumTransitFiles(), 0);
}

TEST_P(TransitTest, ADamagedRowOfTheMapIsNotExported) {
  Tamper("UPDATE maps SET num_frames = 77 WHERE name = 'house'");
  Open();
  EXPECT_EQ(store_->ExportMap("house", {}).status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(NumTransitFiles(), 0);
}

TEST_P(TransitTest, AMapOfManyStepsComesInWhole) {
  const auto before = house_->published();
  generator_.AddBlocks(*house_->FindMutable(SubmapId(1)), 500);
  generator_.AddBlocks(*house_->FindMutable(SubmapId(2)), 500);
  house_->Clone(SubmapId(1));
  ASSERT_TRUE(store_->Commit(*before, *house_->Publish(30), Durability::kNormal).ok());
  const std::string bytes = Export(*store_, "house");
  ASSERT_GT(bytes.size(), 3u << 19) << "of a MB at most";
  ASSERT_TRUE(Import(*store_, bytes, "copy").ok());
  ExpectHouse(*store_, "copy");
}

DHPMAP_ON_STORES_THAT_KEEP(TransitTest);

/// What is PostgreSQL's own.
class PostgresTransit : public TransitTest {
 protected:
  std::int64_t NumRowsUnderNoName() {
    return Query(
        "SELECT (SELECT count(*) FROM tile_blobs WHERE map_key NOT IN (SELECT map_key FROM maps)) + (SELECT count(*) "
        "FROM "
        "tiles WHERE map_key NOT IN (SELECT map_key FROM maps)) + (SELECT count(*) FROM submaps WHERE map_key NOT IN "
        "(SELECT map_key FROM maps)) + (SELECT count(*) FROM incoming_maps) + (SELECT count(*) FROM removed_maps)");
  }
  Result<std::unique_ptr<MapImport>> Brought(MapStore& store) {
    DHPMAP_ASSIGN_OR_RETURN(auto import, store.ImportMap());
    DHPMAP_RETURN_IF_ERROR(import->Write(Export(*store_, "house")));
    DHPMAP_RETURN_IF_ERROR(import->LookThrough({}).status());
    DHPMAP_RETURN_IF_ERROR(import->Bring({}));
    return import;
  }
  void ExpectToComeIn(MapStore& old, const std::string& old_name, const std::string& name) {
    const auto imported = Import(*store_, Export(old, old_name), name);
    ASSERT_TRUE(imported.ok()) << imported.status().ToString();
    const auto expected = old.LoadMap(old_name);
    const auto loaded = store_->LoadMap(name);
    ASSERT_TRUE(expected.ok() && loaded.ok()) << loaded.status().ToString();
    MapInfo info = (*expected)->info();
    info.name = name;
    info.history_id = (*loaded)->info().history_id;
    const MapSnapshot same(info, (*expected)->submaps(), (*expected)->free_space(),
                           VacatedSpace{(*expected)->vacated()});
    ExpectSameMap(same, **loaded);

    // Commits go by what rows say of their blobs: older versions said less.
    Map map(*loaded);
    for (const auto& submap : (*loaded)->submaps()) generator_.AddBlocks(*map.FindMutable(submap->id()), 2);
    ASSERT_TRUE(store_->Commit(**loaded, *map.Publish(50), Durability::kNormal).ok());
    const auto report = store_->VerifyMap(name, false, {});
    ASSERT_TRUE(report.ok()) << report.status().ToString();
    EXPECT_EQ(report->num_faults, 0) << report->faults[0].place << " " << report->faults[0].what;
  }
};

TEST_P(PostgresTransit, WhatAnImportHasBroughtStaysWhileOthersAreSwept) {
  auto import = Brought(*store_);
  ASSERT_TRUE(import.ok()) << import.status().ToString();
  EXPECT_EQ(store_->GetMap("copy").status().code(), StatusCode::kNotFound);
  const std::int64_t num_brought = NumRowsUnderNoName();
  EXPECT_GT(num_brought, 10);
  ASSERT_TRUE(store_->DeleteMap("street").ok());
  std::unique_ptr<MapStore> second;
  kept_.Open(second);  // another process begins: it sweeps, too
  EXPECT_TRUE(testing::Eventually([&] { return NumRowsUnderNoName() == num_brought; }));
  ASSERT_TRUE((*import)->Add("copy").ok());
  import->reset();
  EXPECT_TRUE(testing::Eventually([&] { return NumRowsUnderNoName() == 0; }));
  ExpectHouse(*store_, "copy");
}

TEST_P(PostgresTransit, AnImportThatIsGivenUpIsSwept) {
  auto import = Brought(*store_);
  ASSERT_TRUE(import.ok()) << import.status().ToString();
  EXPECT_GT(NumRowsUnderNoName(), 10);
  import->reset();
  EXPECT_TRUE(testing::Eventually([&] { return NumRowsUnderNoName() == 0; }));
  ExpectStored(*house_->published());
}

TEST_P(PostgresTransit, AnImportWhoseProcessEndsIsSweptByTheNextAndAddsNothing) {
  auto import = Brought(*store_);
  ASSERT_TRUE(import.ok()) << import.status().ToString();
  PostgresCluster::Get()->CutConnections();  // as its end does, and as a network does
  std::unique_ptr<MapStore> second;
  kept_.Open(second);
  EXPECT_TRUE(testing::Eventually([&] { return NumRowsUnderNoName() == 0; }));
  EXPECT_EQ((*import)->Add("copy").code(), StatusCode::kUnavailable);
  EXPECT_EQ(second->GetMap("copy").status().code(), StatusCode::kNotFound);
}

TEST_P(PostgresTransit, AnImportWhoseAnswerWasLostIsFoundToBeThere) {
  CutConnection between(PostgresCluster::Get()->Folder());
  auto opened = OpenPostgresStore(between.Url(), {.schema = kept_.schema(), .transit_folder = kept_.Folder()});
  ASSERT_TRUE(opened.ok()) << opened.status().ToString();
  auto import = Brought(**opened);
  ASSERT_TRUE(import.ok()) << import.status().ToString();
  between.LoseNextCommitsAnswer();
  const Status added = (*import)->Add("copy");
  EXPECT_TRUE(added.ok()) << added.ToString();
  EXPECT_EQ(between.num_lost(), 1) << "no answer was lost: this shows nothing";
  import->reset();
  EXPECT_TRUE(testing::Eventually([&] { return NumRowsUnderNoName() == 0; }));
  ExpectHouse(*store_, "copy");
}

TEST_P(PostgresTransit, AFileOfAnyReleasedVersionComesInAndIsMappedOn) {
  for (std::int64_t schema = 1;; ++schema) {
    const fs::path released =
        testing::SourceDir() / ("tests/unit/storage/released/schema-" + std::to_string(schema) + ".sqlite");
    if (!fs::exists(released)) break;
    SCOPED_TRACE(schema);
    const std::string path = kept_.Folder() + "/old-" + std::to_string(schema) + ".db";
    fs::copy_file(released, path);
    fs::permissions(path, fs::perms::owner_write, fs::perm_options::add);
    auto old = OpenSqliteStore(path);
    ASSERT_TRUE(old.ok()) << old.status().ToString();
    const auto maps = (*old)->ListMaps();
    ASSERT_TRUE(maps.ok());
    for (const StoredMap& map : *maps) ExpectToComeIn(**old, map.info.name, map.info.name + std::to_string(schema));
  }
}

INSTANTIATE_TEST_SUITE_P(Stores, PostgresTransit, ::testing::Values(StoreKind::kPostgres), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
