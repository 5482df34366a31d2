// SPDX-License-Identifier: BSD-3-Clause
// What a later version will do: new columns, config keys and schema steps, over rows that this version wrote.
#include <algorithm>
#include <map>

#include "storage/rows/change_rows.h"
#include "storage/rows/class_rows.h"
#include "storage/rows/config_rows.h"
#include "storage/rows/edit_rows.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/object_rows.h"
#include "storage/rows/seen_rows.h"
#include "storage/rows/session_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/schema/migrate.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::OpenMode;
using sqlite::Statement;
using testing::SqliteStoreTest;

/// The released steps and some that are yet to come.
std::vector<SchemaStep> WithSteps(std::initializer_list<SchemaStep> more) {
  std::vector<SchemaStep> steps(ReleasedSteps().begin(), ReleasedSteps().end());
  steps.insert(steps.end(), more);
  return steps;
}

class LaterVersionTest : public SqliteStoreTest {
 protected:
  Database Direct() { return std::move(Database::Open(Path(), OpenMode::kReadWrite, 1000)).value(); }
  /// As a version writes it that has this key, too.
  void AddConfigKey(const std::string& map, const std::string& key, const std::string& value);
};

// A later column.

struct HeavyRow : SubmapRow {
  double mass_kg = 0;
  std::string owner;
};

const Table<HeavyRow>& HeavySubmaps() {
  static const Table<HeavyRow> table("submaps", [] {
    const int next = Submaps().version() + 1;
    auto columns = SubmapColumns<HeavyRow>();
    columns.push_back(MakeColumn<HeavyRow>("mass_kg", Written::kAlways, next, DHPMAP_MEMBER(mass_kg)));
    columns.push_back(MakeColumn<HeavyRow>("owner", Written::kAlways, next, DHPMAP_MEMBER(owner)));
    return columns;
  }());
  return table;
}

constexpr SchemaStep kAddMass{.sql =
                                  "ALTER TABLE submaps ADD COLUMN mass_kg REAL NOT NULL DEFAULT 2.5; "
                                  "ALTER TABLE submaps ADD COLUMN owner TEXT NOT NULL DEFAULT 'nobody';"};

HeavyRow ReadHeavy(Database& database, int submap_id) {
  auto select = database.Prepare(HeavySubmaps().Select("WHERE submap_id = ?"), "look");
  EXPECT_TRUE(*select->Bind(submap_id).Step());
  HeavyRow row;
  EXPECT_TRUE(HeavySubmaps().Read(*select, row));
  return row;
}

TEST_F(LaterVersionTest, RowsWithoutItsColumnsLoadWithTheirDefaultsAndAreStillChecked) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  Database database = Direct();
  ASSERT_TRUE(MigrateSchema(database, WithSteps({kAddMass})).ok());

  HeavyRow row = ReadHeavy(database, 2);
  EXPECT_EQ(row.mass_kg, 2.5);
  EXPECT_EQ(row.owner, "nobody");
  EXPECT_EQ(row.seal.version, Submaps().version());
  testing::ExpectSameInfo(map->Find(SubmapId(2))->info(), row.info);
  EXPECT_TRUE(HeavySubmaps().IsIntact(row, row.seal));
  row.info.track_id += 1;
  EXPECT_FALSE(HeavySubmaps().IsIntact(row, row.seal));
}

TEST_F(LaterVersionTest, ItsOwnRowsCoverItsColumns) {
  Open();
  CreateSample("house");
  store_ = nullptr;
  Database database = Direct();
  ASSERT_TRUE(MigrateSchema(database, WithSteps({kAddMass})).ok());
  HeavyRow row = ReadHeavy(database, 2);
  const std::int64_t key = row.key;
  row.mass_kg = 31;
  row.owner = "Ada";
  row.seal = HeavySubmaps().SealOf(row);
  auto upsert = database.Prepare(HeavySubmaps().Upsert(), "write");
  ASSERT_TRUE(upsert.ok()) << upsert.status().ToString();
  HeavySubmaps().BindAll(row, *upsert);
  ASSERT_TRUE(upsert->Run().ok());

  row = ReadHeavy(database, 2);
  EXPECT_EQ(row.key, key);
  EXPECT_EQ(row.mass_kg, 31);
  EXPECT_EQ(row.owner, "Ada");
  EXPECT_EQ(row.seal.version, Submaps().version() + 1);
  EXPECT_TRUE(HeavySubmaps().IsIntact(row, row.seal));
  for (const char* change : {"mass_kg = 30", "owner = 'Bob'", "track_id = track_id + 1", "checksum_version = 1"}) {
    ASSERT_TRUE(database.Execute("SAVEPOINT s; UPDATE submaps SET " + std::string(change), "tamper").ok());
    row = ReadHeavy(database, 2);
    EXPECT_FALSE(HeavySubmaps().IsIntact(row, row.seal)) << change;
    ASSERT_TRUE(database.Execute("ROLLBACK TO s", "undo").ok());
  }
}

TEST_F(LaterVersionTest, ItsDatabaseIsRefusedByThisOne) {
  Open();
  CreateSample("house");
  store_ = nullptr;
  {
    Database database = Direct();
    ASSERT_TRUE(MigrateSchema(database, WithSteps({kAddMass})).ok());
    EXPECT_EQ(InspectSchema(database, WithSteps({kAddMass})).value(), SchemaState::kCurrent);
  }
  for (const bool read_only : {false, true}) {
    const Status opened = TryOpen(read_only);
    EXPECT_EQ(opened.code(), StatusCode::kFailedPrecondition);
    EXPECT_EQ(opened.reason(), Reason("NEWER_SCHEMA"));
  }
}

TEST_F(LaterVersionTest, ARowOfAnUnknownChecksumVersionIsDamaged) {
  for (const char* table : {"maps", "submaps"}) {
    for (const char* version : {"99", "0", "-1"}) {
      std::filesystem::remove(Path());
      Open();
      CreateSample("house");
      store_ = nullptr;
      Tamper(std::string("UPDATE ") + table + " SET checksum_version = " + version);
      Open();
      EXPECT_EQ(store_->LoadMap("house").status().code(), StatusCode::kDataLoss) << table << " " << version;
      store_ = nullptr;
    }
  }
}

// A later config key.

/// Leaves the map's config with `rows`, sealed as a version would that has these keys.
void WriteConfigAs(Database& database, const std::string& name, const std::vector<ConfigRow>& rows) {
  MapRow row = ReadMapHead(database, name).value();
  auto clear = database.Prepare("DELETE FROM map_config WHERE map_key = ?", "write");
  ASSERT_TRUE(clear->Bind(row.key).Run().ok());
  auto insert = database.Prepare(ConfigTable().Insert(), "write");
  for (const ConfigRow& entry : rows) {
    ConfigTable().BindAll(entry, *insert);
    ASSERT_TRUE(insert->Run().ok());
  }
  row.config_checksum = ConfigChecksum(rows);
  row.seal.checksum = Maps().Checksum(row, row.seal.version);
  auto update = database.Prepare(Maps().Update("WHERE map_key = ?"), "write");
  Maps().BindChanges(row, *update);
  ASSERT_TRUE(update->Bind(row.key).Run().ok());
}

void LaterVersionTest::AddConfigKey(const std::string& map, const std::string& key, const std::string& value) {
  Database database = Direct();
  const std::int64_t map_key = ReadMapHead(database, map)->key;
  std::vector<ConfigRow> rows = ReadConfigRows(database, map_key).value();
  rows.push_back({map_key, key, value});
  std::sort(rows.begin(), rows.end(), [](const ConfigRow& a, const ConfigRow& b) { return a.key < b.key; });
  WriteConfigAs(database, map, rows);
}

TEST_F(LaterVersionTest, AKeyThatTheWritingVersionDidNotKnowHasItsDefault) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  {
    Database database = Direct();
    std::vector<ConfigRow> rows = ReadConfigRows(database, ReadMapHead(database, "house")->key).value();
    std::erase_if(rows, [](const ConfigRow& row) { return row.key.starts_with("tracking."); });
    WriteConfigAs(database, "house", rows);
  }
  MapConfig expected = map->info().config;
  expected.tracking = TrackingConfig();
  Open();
  auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  EXPECT_EQ(ConfigToText((*loaded)->info().config), ConfigToText(expected));

  // It stays so when the map is written on.
  Map next(*loaded);
  next.mutable_info().num_frames += 1;
  ASSERT_TRUE(store_->Commit(**loaded, *next.Publish(20), Durability::kNormal).ok());
  ExpectStored(*next.published());
  EXPECT_EQ(ConfigToText((*store_->LoadMap("house"))->info().config), ConfigToText(expected));
}

TEST_F(LaterVersionTest, AKeyOfItsOwnIsNamedByThisOneAndLeavesOtherMapsAlone) {
  Open();
  CreateSample("house");
  const auto other = CreateSample("other");
  store_ = nullptr;
  AddConfigKey("house", "warp.factor", "9");
  Open();
  const Status loaded = store_->LoadMap("house").status();
  EXPECT_EQ(loaded.code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(loaded.reason(), Reason("NEWER_CONFIG"));
  EXPECT_NE(loaded.message().find("warp.factor"), std::string::npos) << loaded.ToString();
  EXPECT_EQ((*store_->ListMaps())[0].damage.reason(), Reason("NEWER_CONFIG"));
  ExpectStored(*other->published());
}

// Keys of older versions.

TEST_F(LaterVersionTest, ARetiredKeyIsReadAtItsDefaultAndTheMapGoesOn) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  AddConfigKey("house", "tracking.weigh_scores", "false");
  Open();
  auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  Map next(*loaded);
  next.mutable_info().num_frames += 1;
  ASSERT_TRUE(store_->Commit(**loaded, *next.Publish(20), Durability::kNormal).ok());
  Open();
  ExpectStored(*next.published());
}

TEST_F(LaterVersionTest, AMapThatWasCarvedGoesOnWithoutCarvingAndSaysSo) {
  Open();
  CreateSample("house");
  store_ = nullptr;
  AddConfigKey("house", "integration.carving", "true");
  Open();
  auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  const std::vector<std::string> left_out = {"integration.carving = true"};
  EXPECT_EQ((*loaded)->info().config.left_out, left_out);
  EXPECT_EQ((*store_->ListMaps())[0].info.config.left_out, left_out);
  Map next(*loaded);
  next.mutable_info().num_frames += 1;
  ASSERT_TRUE(store_->Commit(**loaded, *next.Publish(20), Durability::kNormal).ok());
  Open();
  ExpectStored(*next.published());
}

TEST_F(LaterVersionTest, AMapWithARetiredSettingIsRefusedWithWhatToDoAndIsLeftAsItIs) {
  Open();
  CreateSample("house");
  const auto other = CreateSample("other");
  store_ = nullptr;
  AddConfigKey("house", "tracking.weigh_scores", "true");
  Open();
  const Status loaded = store_->LoadMap("house").status();
  EXPECT_EQ(loaded.code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(loaded.reason(), Reason("RETIRED_CONFIG"));
  EXPECT_NE(loaded.message().find("tracking.weigh_scores = true"), std::string::npos) << loaded.ToString();
  EXPECT_NE(loaded.message().find("map its frames again"), std::string::npos) << loaded.ToString();
  EXPECT_EQ((*store_->ListMaps())[0].damage.reason(), Reason("RETIRED_CONFIG"));
  ExpectStored(*other->published());
  store_ = nullptr;
  Database database = Direct();
  const std::vector<ConfigRow> rows = ReadConfigRows(database, ReadMapHead(database, "house")->key).value();
  EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const ConfigRow& row) {
    return row.key == "tracking.weigh_scores" && row.value == "true";
  }));
}

TEST_F(LaterVersionTest, AKeyThatCameInUnsealedIsDamage) {
  Open();
  CreateSample("house");
  store_ = nullptr;
  Tamper("INSERT INTO map_config SELECT map_key, 'warp.factor', '9' FROM maps");
  Open();
  EXPECT_EQ(store_->LoadMap("house").status().code(), StatusCode::kDataLoss);
}

// Later schema steps.

Status CountSubmaps(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t count, database.QueryInt("SELECT count(*) FROM submaps", "count"));
  return database.Execute("INSERT INTO counted VALUES (" + std::to_string(count) + ")", "write the count");
}
bool power_is_on = true;
Status FailWithoutPower(Database& database) {
  DHPMAP_RETURN_IF_ERROR(database.Execute("DELETE FROM submaps", "half of a step"));
  if (!power_is_on) return Unavailable("no power");
  return database.Execute("INSERT INTO counted VALUES (-1)", "the other half");
}

TEST_F(LaterVersionTest, AStepMayRunCodeAndAFailureInTheNextOneResumesThere) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  const auto steps = WithSteps(
      {{.sql = "CREATE TABLE counted (n INTEGER NOT NULL) STRICT", .run = CountSubmaps}, {.run = FailWithoutPower}});
  const auto num_submaps = static_cast<std::int64_t>(map->submaps().size());
  Database database = Direct();
  power_is_on = false;
  EXPECT_EQ(MigrateSchema(database, steps).code(), StatusCode::kUnavailable);
  EXPECT_EQ(Query("PRAGMA user_version"), SchemaVersion() + 1) << "the step before stays done";
  EXPECT_EQ(Query("SELECT n FROM counted"), num_submaps);
  EXPECT_EQ(Query("SELECT count(*) FROM submaps"), num_submaps) << "of the failed one nothing";
  EXPECT_EQ(InspectSchema(database, steps).value(), SchemaState::kOlder);

  power_is_on = true;
  ASSERT_TRUE(MigrateSchema(database, steps).ok());
  EXPECT_EQ(Query("PRAGMA user_version"), SchemaVersion() + 2);
  EXPECT_EQ(Query("SELECT count(*) FROM counted"), 2) << "no step is done twice";
  EXPECT_EQ(Query("SELECT count(*) FROM submaps"), 0);
  EXPECT_EQ(InspectSchema(database, steps).value(), SchemaState::kCurrent);
}

// The lists and the schema.

template <typename Row>
void ExpectListsAllColumnsOf(Database& database, const Table<Row>& table) {
  auto columns = database.Prepare("SELECT name, type FROM pragma_table_info(?)", "look");
  ASSERT_TRUE(columns.ok());
  std::map<std::string, std::string> of_schema, of_list;
  columns->Bind(table.table());
  while (*columns->Step()) of_schema[columns->Text(0)] = columns->Text(1);
  for (const ColumnName& column : table.columns()) of_list[column.name] = SqlTypeName(column.type);
  EXPECT_EQ(of_list, of_schema) << table.table();
}

TEST_F(LaterVersionTest, EveryColumnOfATableIsInItsListWithItsType) {
  Open();
  Database database = Direct();
  ExpectListsAllColumnsOf(database, Maps());
  ExpectListsAllColumnsOf(database, ConfigTable());
  ExpectListsAllColumnsOf(database, Classes());
  ExpectListsAllColumnsOf(database, Sessions());
  ExpectListsAllColumnsOf(database, MergedTable());
  ExpectListsAllColumnsOf(database, PairTable());
  ExpectListsAllColumnsOf(database, Submaps());
  ExpectListsAllColumnsOf(database, Changes());
  ExpectListsAllColumnsOf(database, ChangeLogs());
  ExpectListsAllColumnsOf(database, Edits());
  ExpectListsAllColumnsOf(database, EditHistories());
  ExpectListsAllColumnsOf(database, SeenTable());
}

}  // namespace
}  // namespace dhpmap
