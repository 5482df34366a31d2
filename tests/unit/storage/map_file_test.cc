// SPDX-License-Identifier: BSD-3-Clause
// One map goes out of a store as a file and into another.
#include "storage/files/map_file.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>

#include "storage/schema/migrate.h"
#include "tests/support/eventually.h"
#include "tests/support/places.h"
#include "tests/unit/storage/disk_fault.h"
#include "tests/unit/storage/map_transfer.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::DiskFault;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::Export;
using testing::Import;
using testing::SqliteStoreTest;

/// The start of a statement to which `n (i)` has the numbers from 1 on.
std::string Counted(int count) {
  return "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < " + std::to_string(count) + ") ";
}

class MapFileTest : public SqliteStoreTest {
 protected:
  /// A map with clones, free and vacated space, a numbering that is reserved, what is locked and what is kept clear,
  /// beside another one.
  void SetUp() override {
    Open();
    house_ = CreateSample("house");
    const auto before = house_->published();
    house_->Clone(SubmapId(2));
    generator_.AddVoxels(house_->mutable_vacated());
    house_->FindMutable(SubmapId(2))->mutable_info().is_locked = true;
    ASSERT_TRUE(house_->mutable_info().kept_clear.Add({"door", BoundingSphere{{1.0 / 3, -2, 1}, 0.75}}).ok());
    ASSERT_TRUE(store_->Commit(*before, *house_->Publish(20), Durability::kFull).ok());
    street_ = CreateSample("street");
    bytes_ = Export(*store_, "house");
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
    const auto report = store.VerifyMap(name, false, {});
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->num_faults, 0) << report->faults[0].place << " " << report->faults[0].what;
  }
  /// What the exported file holds after `sql` was run on it.
  std::string Changed(const std::string& sql) {
    const std::string path = (folder_.path() / "changed.db").string();
    std::ofstream(path, std::ios::binary) << bytes_;
    return Changed(sql, path);
  }
  /// Likewise, of the file at `path`, which goes.
  static std::string Changed(const std::string& sql, const std::string& path) {
    {
      auto database = sqlite::Database::Open(path, sqlite::OpenMode::kReadWrite, 1000);
      EXPECT_TRUE(database.ok() && database->Execute(sql, "change").ok()) << sql;
    }
    std::string bytes(fs::file_size(path), '\0');
    std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    fs::remove(path);
    return bytes;
  }
  int NumFiles() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator{}));
  }

  std::unique_ptr<Map> house_, street_;
  std::string bytes_;
};

TEST_F(MapFileTest, AMapComesBackAsItWasUnderAnyNameAndWithANewHistory) {
  const int num_files = NumFiles();
  EXPECT_EQ(Import(*store_, bytes_, "copy").value(), "copy");
  ExpectHouse(*store_, "copy");
  ExpectStored(*house_->published());
  ExpectStored(*street_->published());

  const std::string path = (folder_.path() / "other.db").string();
  {
    auto other = OpenSqliteStore(path);
    ASSERT_TRUE(other.ok());
    EXPECT_EQ(Import(**other, bytes_).value(), "house");
    ExpectHouse(**other, "house");
    EXPECT_EQ((*other)->ListMaps()->size(), 1u);
  }
  auto reopened = OpenSqliteStore(path);
  ASSERT_TRUE(reopened.ok());
  ExpectHouse(**reopened, "house");
  reopened->reset();
  for (const char* suffix : {"", "-wal", "-shm", "-lock"}) fs::remove(path + suffix);
  EXPECT_EQ(NumFiles(), num_files) << "nothing is left lying about";
}

TEST_F(MapFileTest, AnImportedMapGoesOnAsAnyOther) {
  ASSERT_TRUE(Import(*store_, bytes_, "copy").ok());
  const auto loaded = store_->LoadMap("copy");
  ASSERT_TRUE(loaded.ok());
  Map map(*loaded);
  generator_.Change(map);
  map.Clone(SubmapId(1));
  ASSERT_TRUE(store_->Commit(**loaded, *map.Publish(40), Durability::kNormal).ok());
  ExpectStored(*map.published());
  ASSERT_TRUE(store_->DeleteMap("copy").ok());
  ExpectStored(*house_->published());
  EXPECT_EQ(store_->VerifyMap("house", false, {})->num_faults, 0);
}

TEST_F(MapFileTest, WhoFollowsAnImportedMapListsItFirst) {
  ASSERT_TRUE(Import(*store_, bytes_, "copy").ok());
  EXPECT_EQ(store_->ListChanges("copy", 0, 1'000'000).status().reason(), Reason("COMPACTED"));
}

TEST_F(MapFileTest, SharedTilesAreStoredOnceInTheFileAndOnceAfterwards) {
  const std::string sql = "SELECT count(*) FROM tile_blobs";
  const std::int64_t num_before = Query(sql);
  const std::int64_t num_of_house = Query(
      "SELECT count(DISTINCT blob_key) FROM tiles WHERE owner_key IN (SELECT submap_key FROM submaps JOIN maps USING "
      "(map_key) WHERE name = 'house') OR owner_key IN (SELECT -map_key FROM maps WHERE name = 'house')");
  ASSERT_TRUE(Import(*store_, bytes_, "copy").ok());
  EXPECT_EQ(Query(sql) - num_before, num_of_house);
}

TEST_F(MapFileTest, TheFileIsADatabaseThatAServerStartsOn) {
  const std::string path = (folder_.path() / "alone.db").string();
  std::ofstream(path, std::ios::binary) << bytes_;
  auto store = OpenSqliteStore(path);
  ASSERT_TRUE(store.ok()) << store.status().ToString();
  ExpectHouse(**store, "house");
}

TEST_F(MapFileTest, AFileOfAnyReleasedVersionIsBroughtUpToDate) {
  for (std::int64_t schema = 1; schema <= SchemaVersion(); ++schema) {
    SCOPED_TRACE(schema);
    const std::string number = std::to_string(schema);
    const std::string path = (folder_.path() / ("old-" + number)).string();
    const fs::path released = testing::SourceDir() / ("tests/unit/storage/released/schema-" + number + ".sqlite");
    if (schema == SchemaVersion() && !fs::exists(released)) continue;  // comes with the next one
    fs::copy_file(released, path);
    fs::permissions(path, fs::perms::owner_write, fs::perm_options::add);
    const std::string bytes =
        Changed("PRAGMA foreign_keys = ON; DELETE FROM maps WHERE name <> (SELECT min(name) FROM maps)", path);
    const std::string name = "old-" + number;
    const auto imported = Import(*store_, bytes, name);
    ASSERT_TRUE(imported.ok()) << imported.status().ToString();
    EXPECT_EQ(store_->VerifyMap(name, false, {})->num_faults, 0);

    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    const auto reference = OpenSqliteStore(path);
    ASSERT_TRUE(reference.ok()) << reference.status().ToString();
    const auto expected = (*reference)->LoadMap((*reference)->ListMaps()->front().info.name);
    const auto loaded = store_->LoadMap(name);
    ASSERT_TRUE(expected.ok() && loaded.ok());
    MapInfo info = (*expected)->info();
    EXPECT_NE((*loaded)->info().history_id, info.history_id);
    EXPECT_EQ(store_->ListEdits(name, {})->size(), 0u) << "they are of the other history";
    info.name = name;
    info.history_id = (*loaded)->info().history_id;
    ExpectSameMap(
        MapSnapshot(info, (*expected)->submaps(), (*expected)->free_space(), VacatedSpace{(*expected)->vacated()}),
        **loaded);

    // Once more, as this version exports it.
    const std::string again = name + "-again";
    ASSERT_TRUE(Import(*store_, Export(*store_, name), again).ok());
    const auto twice = store_->LoadMap(again);
    ASSERT_TRUE(twice.ok()) << twice.status().ToString();
    EXPECT_NE((*twice)->info().history_id, (*loaded)->info().history_id);
    info.name = again;
    info.history_id = (*twice)->info().history_id;
    ExpectSameMap(
        MapSnapshot(info, (*expected)->submaps(), (*expected)->free_space(), VacatedSpace{(*expected)->vacated()}),
        **twice);
  }
}

TEST_F(MapFileTest, AFileWithADamagedLogOfEditsComesInWhole) {
  // A store of one map is a map file, too; its histories do not come with it.
  const std::string path = (folder_.path() / "alone.db").string();
  {
    auto alone = OpenSqliteStore(path);
    ASSERT_TRUE(alone.ok());
    Map map(generator_.Info("lonely"));
    generator_.AddSubmap(map, 5);
    ASSERT_TRUE((*alone)->CreateMap(*map.Publish(1)).ok());
    const auto before = map.published();
    map.FindMutable(SubmapId(1))->mutable_info().display_name = "a lamp";
    const auto after = map.Publish(2);
    const EditRecord record{.entry = {after->revision(), 2, {}, {}}, .answer = "", .before = before};
    ASSERT_TRUE((*alone)->CommitEdit(*before, *after, record).ok());
  }
  EXPECT_TRUE(Import(*store_, Changed("UPDATE edits SET time_ns = 7; UPDATE changes SET time_ns = 7", path)).ok());
  EXPECT_EQ(store_->VerifyMap("lonely", false, {})->num_faults, 0);
}

TEST_F(MapFileTest, WhatIsNotThereOrTakenIsRefused) {
  EXPECT_EQ(store_->ExportMap("none", {}).status().code(), StatusCode::kNotFound);
  EXPECT_EQ(Import(*store_, bytes_).status().code(), StatusCode::kAlreadyExists);
  EXPECT_EQ(Import(*store_, bytes_, "a/b").status().code(), StatusCode::kInvalidArgument);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(store_->ExportMap("house", stop.get_token()).status().code(), StatusCode::kCancelled);
  ExpectStored(*house_->published());
}

TEST_F(MapFileTest, AFileThatIsNoMapIsATypedErrorAndLeavesNothing) {
  const int num_files = NumFiles();
  struct BadFile {
    const char* what;
    std::string bytes;
    Reason reason;  ///< none: one of several
  };
  const BadFile cases[] = {
      {"nothing", "", "BAD_MAP"},
      {"text", "a picture of a house", "BAD_MAP"},
      {"the half", bytes_.substr(0, bytes_.size() / 2), {}},
      {"a part of a page less", bytes_.substr(0, bytes_.size() - 100), {}},
      {"another application", Changed("PRAGMA application_id = 7"), "BAD_MAP"},
      {"a later schema", Changed("PRAGMA user_version = 999"), "NEWER_SCHEMA"},
      {"no map", Changed("PRAGMA foreign_keys = ON; DELETE FROM maps"), "BAD_MAP"},
      {"a table too few", Changed("DROP TABLE lost_revisions"), "BAD_MAP"},
      {"a trigger of its own", Changed("CREATE TRIGGER evil AFTER UPDATE ON maps BEGIN DELETE FROM tiles; END"),
       "BAD_MAP"},
      {"a changed row", Changed("UPDATE submaps SET track_id = track_id + 1 WHERE submap_id = 1"), "DAMAGED_MAP"},
      {"a changed map", Changed("UPDATE maps SET num_frames = 9"), "DAMAGED_MAP"},
      {"a blob too few", Changed("DELETE FROM tile_blobs WHERE blob_key = (SELECT min(blob_key) FROM tile_blobs)"),
       "DAMAGED_MAP"},
      {"a blob cut", Changed("UPDATE tile_blobs SET blob = substr(blob, 1, 20)"), "DAMAGED_MAP"},
      {"a blob of 70 MB",
       Changed("UPDATE tile_blobs SET blob = zeroblob(70000000) WHERE blob_key = "
               "(SELECT min(blob_key) FROM tile_blobs)"),
       "BAD_MAP"},
      {"a tile too few", Changed("DELETE FROM tiles WHERE layer = 1"), "DAMAGED_MAP"},
      {"no submap", Changed("DELETE FROM submaps"), "DAMAGED_MAP"},
      {"a tile whose number is taken for another's", Changed("UPDATE tiles SET x = x + 4294967296"), "BAD_MAP"},
      {"too many sessions",
       Changed(Counted(300) + "INSERT INTO feed_sessions SELECT (SELECT map_key FROM maps), 'run-' || i, i, i FROM n"),
       "BAD_MAP"},
      {"too many regions",
       Changed(Counted(70) + "INSERT INTO kept_clear SELECT (SELECT map_key FROM maps), 'region-' || i, x'00' FROM n"),
       "BAD_MAP"},
      {"too many classes",
       Changed(Counted(66'000) + "INSERT INTO label_classes SELECT (SELECT map_key FROM maps), 9 + i, 'c', 1, 1, 0 "
                                 "FROM n"),
       "BAD_MAP"},
  };
  for (const BadFile& one : cases) {
    SCOPED_TRACE(one.what);
    const auto imported = Import(*store_, one.bytes, "copy");
    ASSERT_FALSE(imported.ok());
    const StatusCode code = imported.status().code();
    EXPECT_TRUE(code == StatusCode::kInvalidArgument || code == StatusCode::kDataLoss ||
                code == StatusCode::kFailedPrecondition)
        << imported.status().ToString();
    if (!one.reason.empty()) {
      EXPECT_EQ(imported.status().reason(), one.reason) << imported.status().ToString();
    }
    ExpectDiscreet(imported.status(), Path());
    EXPECT_EQ(store_->GetMap("copy").status().code(), StatusCode::kNotFound);
    EXPECT_EQ(NumFiles(), num_files);
  }
  ExpectStored(*house_->published());
}

TEST_F(MapFileTest, AMapThatNoServerMakesIsRefusedThoughItsChecksumsHold) {
  MapInfo info = generator_.Info("forged");
  info.config.truncation_m = 1e6;
  Map forged(std::move(info));
  ASSERT_TRUE(store_->CreateMap(*forged.Publish(11)).ok());
  const Status refused = Import(*store_, Export(*store_, "forged"), "copy").status();
  EXPECT_EQ(refused.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(refused.reason(), Reason("BAD_MAP"));
  EXPECT_NE(refused.message().find("config.truncation_m"), std::string::npos) << refused.ToString();
  EXPECT_EQ(store_->GetMap("copy").status().code(), StatusCode::kNotFound);
}

TEST_F(MapFileTest, AnyByteThatIsChangedIsSeenOrDoesNotMatter) {
  int num_refused = 0;
  for (std::size_t at = 30; at < bytes_.size(); at += bytes_.size() / 150) {
    SCOPED_TRACE(at);
    std::string bytes = bytes_;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    const auto imported = Import(*store_, bytes, "copy");
    if (!imported.ok()) {
      ++num_refused;
      EXPECT_EQ(store_->GetMap("copy").status().code(), StatusCode::kNotFound);
      continue;
    }
    ExpectHouse(*store_, "copy");
    ASSERT_TRUE(store_->DeleteMap("copy").ok());
  }
  EXPECT_GT(num_refused, 20);
  ExpectStored(*house_->published());
}

TEST_F(MapFileTest, AFailingDiskIsATypedErrorAndTheStoreGoesOn) {
  const int num_files = NumFiles();
  for (const auto kind : {DiskFault::Kind::kFull, DiskFault::Kind::kBroken, DiskFault::Kind::kNoSync}) {
    int num_failed = 0;
    for (int nth = 1; nth < 5000; nth += 1 + nth / 3) {
      SCOPED_TRACE("fault " + std::to_string(static_cast<int>(kind)) + ", call " + std::to_string(nth));
      bool has_struck = false;
      Status exported, imported;
      {
        const DiskFault fault(kind, nth);
        exported = store_->ExportMap("house", {}).status();
        imported = Import(*store_, bytes_, "copy").status();
        has_struck = fault.has_struck();
      }
      for (const Status& status : {exported, imported}) {
        if (status.ok()) continue;
        ++num_failed;
        EXPECT_TRUE(status.code() == StatusCode::kResourceExhausted || status.code() == StatusCode::kUnavailable)
            << status.ToString();
        ExpectDiscreet(status, Path());
      }
      if (imported.ok()) {
        ExpectHouse(*store_, "copy");
        ASSERT_TRUE(store_->DeleteMap("copy").ok());
      } else {
        EXPECT_EQ(store_->GetMap("copy").status().code(), StatusCode::kNotFound);
      }
      EXPECT_EQ(NumFiles(), num_files);
      ASSERT_FALSE(HasFailure());
      if (!has_struck) break;
    }
    if (kind != DiskFault::Kind::kNoSync) {
      EXPECT_GT(num_failed, 3);
    }
  }
  ExpectStored(*house_->published());
  Open();
  ExpectStored(*house_->published());
}

TEST_F(MapFileTest, AStateIsAlwaysTheSameFile) {
  const auto before = street_->published();
  street_->Clone(SubmapId(1));
  ASSERT_TRUE(store_->Commit(*before, *street_->Publish(30), Durability::kNormal).ok());
  EXPECT_TRUE(Export(*store_, "house") == bytes_);
  EXPECT_FALSE(Export(*store_, "street") == bytes_);
}

TEST_F(MapFileTest, WhatAnImportHasBroughtStaysWhileOthersAreCollected) {
  auto import = store_->ImportMap();
  ASSERT_TRUE(import.ok() && (*import)->Write(bytes_).ok());
  ASSERT_EQ((*import)->LookThrough({}).value(), "house");
  ASSERT_TRUE((*import)->Bring({}).ok());
  EXPECT_EQ(store_->GetMap("copy").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(store_->VerifyMap("house", false, {})->num_faults, 0);

  // Dead blobs before and behind them go.
  const std::int64_t num_brought = Query("SELECT count(*) FROM dead_blobs");
  EXPECT_GT(num_brought, 10);
  ASSERT_TRUE(store_->DeleteMap("street").ok());
  CreateSample("garden");
  ASSERT_TRUE(store_->DeleteMap("garden").ok());
  EXPECT_TRUE(testing::Eventually([&] { return Query("SELECT count(*) FROM dead_blobs") == num_brought; }));
  ASSERT_TRUE((*import)->Add("copy").ok());
  import->reset();
  EXPECT_TRUE(testing::Eventually([&] { return Query("SELECT count(*) FROM dead_blobs") == 0; }));
  ExpectHouse(*store_, "copy");
  Open();
  ExpectHouse(*store_, "copy");
}

TEST_F(MapFileTest, AMapOfManyStepsComesInWhole) {
  const auto before = house_->published();
  generator_.AddBlocks(*house_->FindMutable(SubmapId(1)), 400);
  generator_.AddBlocks(*house_->FindMutable(SubmapId(2)), 400);
  house_->Clone(SubmapId(1));
  ASSERT_TRUE(store_->Commit(*before, *house_->Publish(30), Durability::kNormal).ok());
  const std::string bytes = Export(*store_, "house");
  ASSERT_GT(bytes.size(), 3u << 19) << "of half a MB";
  ASSERT_TRUE(Import(*store_, bytes, "copy").ok());
  ExpectHouse(*store_, "copy");
  ASSERT_TRUE(Import(*store_, bytes, "copy2").ok());
  ExpectHouse(*store_, "copy2");
}

TEST_F(MapFileTest, AnImportThatIsGivenUpOrKilledIsCollected) {
  const std::int64_t num_blobs = Query("SELECT count(*) FROM tile_blobs");
  std::string killed = (folder_.path() / "killed.db").string();
  for (const bool is_killed : {false, true}) {
    auto import = store_->ImportMap();
    ASSERT_TRUE(import.ok() && (*import)->Write(bytes_).ok());
    ASSERT_TRUE((*import)->LookThrough({}).ok() && (*import)->Bring({}).ok());
    EXPECT_GT(Query("SELECT count(*) FROM tile_blobs"), num_blobs);
    if (is_killed) {  // what a process that ends here leaves
      for (const char* suffix : {"", "-wal"}) fs::copy_file(Path() + suffix, killed + suffix);
    }
    import->reset();
    EXPECT_TRUE(testing::Eventually([&] { return Query("SELECT count(*) FROM tile_blobs") == num_blobs; }));
    EXPECT_EQ(Query("SELECT count(*) FROM dead_blobs"), 0);
  }
  auto store = OpenSqliteStore(killed);
  ASSERT_TRUE(store.ok());
  EXPECT_EQ((*store)->ListMaps()->size(), 2u);
  const auto count = [&killed](const std::string& table) {
    auto database = sqlite::Database::Open(killed, sqlite::OpenMode::kReadOnly, 1000);
    return database.ok() ? database->QueryInt("SELECT count(*) FROM " + table, "look").value() : -1;
  };
  EXPECT_TRUE(testing::Eventually([&] { return count("tile_blobs") == num_blobs; }));
  EXPECT_EQ(count("dead_blobs"), 0);
}

TEST_F(MapFileTest, AnExportIsOneStateWhileCommitsGoOn) {
  std::atomic<bool> is_over = false;
  std::thread committer([&] {
    for (int n = 0; !is_over; ++n) {
      const auto before = street_->published();
      generator_.AddBlocks(*street_->FindMutable(SubmapId(1)), 2);
      EXPECT_TRUE(store_->Commit(*before, *street_->Publish(100 + n), Durability::kNormal).ok());
    }
  });
  for (int n = 0; n < 5; ++n) {
    const std::string bytes = Export(*store_, "street");
    const std::string name = "street-" + std::to_string(n);
    EXPECT_TRUE(Import(*store_, bytes, name).ok());
    EXPECT_EQ(store_->VerifyMap(name, false, {})->num_faults, 0);
  }
  is_over = true;
  committer.join();
}

}  // namespace
}  // namespace dhpmap
