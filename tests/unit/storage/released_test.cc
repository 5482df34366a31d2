// SPDX-License-Identifier: BSD-3-Clause
// Databases of every released schema, opened by this version: nothing that was ever stored is lost.
#include <fstream>
#include <map>
#include <sstream>

#include "mapping/paging/tile_page.h"
#include "storage/rows/config_rows.h"
#include "storage/schema/bundle_blocks.h"
#include "storage/schema/migrate.h"
#include "storage/tiles/object_layers.h"
#include "tests/support/places.h"
#include "tests/unit/storage/map_digests.h"
#include "tests/unit/storage/map_text.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::SqliteStoreTest;
using testing::TextOf;

fs::path ReleasedFolder() { return testing::SourceDir() / "tests/unit/storage/released"; }
fs::path Released(std::int64_t schema) { return ReleasedFolder() / ("schema-" + std::to_string(schema) + ".sqlite"); }

/// What is known of one map.
struct Expected {
  std::string digests;      ///< map_digests.h, of its text and its config's
  std::string config_text;  ///< as stored
  MapConfig config;         ///< the stored keys in place of the defaults
};

/// By map, what digests.txt says of the database of this schema.
std::map<std::string, Expected> ReadExpected(std::int64_t schema) {
  constexpr std::size_t kDigest = 32 + 2;  // and blanks
  std::map<std::string, Expected> maps;
  Expected* map = nullptr;
  bool is_of_schema = false;
  std::ifstream file(ReleasedFolder() / "digests.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("schema ")) is_of_schema = line == "schema " + std::to_string(schema);
    if (!is_of_schema || line.size() < kDigest) continue;
    const std::string said = line.substr(kDigest);
    if (said.starts_with("map '")) map = &maps[said.substr(5, said.find('\'', 5) - 5)];
    if (map == nullptr) return {};
    map->digests += line + "\n";
  }
  return maps;
}

/// Of a database that may be of any schema.
std::vector<ConfigRow> StoredConfig(const std::string& path, const std::string& map) {
  auto database = sqlite::Database::Open(path, sqlite::OpenMode::kReadOnly, 1000);
  if (!database.ok()) return {};
  const auto key = database->QueryInt("SELECT map_key FROM maps WHERE name = '" + map + "'", "look");
  if (!key.ok()) return {};
  auto rows = ReadConfigRows(*database, *key);
  return rows.ok() ? std::move(rows).value() : std::vector<ConfigRow>();
}

/// Judged by their digests; told by the first section that differs. All that the map holds goes to a file.
void ExpectDigests(const std::string& expected, const std::string& text, const std::string& file_name) {
  const std::string actual = testing::DigestsOf(text);
  if (actual == expected) return;
  const fs::path file = fs::path(::testing::TempDir()) / file_name;
  std::ofstream(file) << text;
  std::istringstream expected_lines(expected), actual_lines(actual);
  std::string a, b;
  while (std::getline(expected_lines, a)) {
    if (!std::getline(actual_lines, b)) b = "(nothing)";
    if (a != b) break;
  }
  if (a == b) a = "(nothing)", std::getline(actual_lines, b);
  FAIL() << "expected " << a << "\nfound    " << b << "\nAll that was found is in " << file
         << "; released/README.md says how to get what was expected.";
}

class ReleasedDatabaseTest : public SqliteStoreTest, public ::testing::WithParamInterface<std::int64_t> {
 protected:
  void SetUp() override {
    fs::copy_file(Released(GetParam()), Path());
    fs::permissions(Path(), fs::perms::owner_write, fs::perm_options::add);
    expected_ = ReadExpected(GetParam());
    ASSERT_FALSE(expected_.empty());
    for (auto& [name, expected] : expected_) {
      const std::vector<ConfigRow> config = StoredConfig(Path(), name);
      expected.config_text = TextOf(config);
      for (const ConfigRow& row : config) {
        const RetiredField* const retired = FindRetiredField(row.key);
        if (retired != nullptr && retired->is_left_out && row.value != retired->default_text) {
          expected.config.left_out.push_back(row.key + " = " + row.value);
          continue;
        }
        ASSERT_TRUE(SetField(expected.config, row.key, row.value).ok()) << row.key;
      }
    }
  }

  void ExpectAllOfIt() {
    const auto stored = store_->ListMaps();
    ASSERT_TRUE(stored.ok()) << stored.status().ToString();
    EXPECT_EQ(stored->size(), expected_.size());
    for (const auto& [name, expected] : expected_) {
      SCOPED_TRACE("map " + name);
      const auto map = store_->LoadMap(name);
      ASSERT_TRUE(map.ok()) << map.status().ToString();
      const std::string file = "schema-" + std::to_string(GetParam()) + "-" + name + ".txt";
      ExpectDigests(expected.digests, TextOf(**map) + expected.config_text, file);
      EXPECT_EQ(ConfigToText((*map)->info().config), ConfigToText(expected.config));
      EXPECT_EQ((*map)->info().config.left_out, expected.config.left_out);
      if (GetParam() < 4) {
        EXPECT_EQ((*map)->free_space()->NumFreeVoxels(), num_free_) << "none was stored before schema 4";
      } else {
        EXPECT_GT((*map)->free_space()->NumFreeVoxels(), num_free_);
      }
      for (const auto& submap : (*map)->submaps()) {
        if (GetParam() >= 5) continue;
        EXPECT_EQ(CountBlocks(*submap).num_gone_blocks, 0) << "none was stored before schema 5";
      }
    }
  }

  std::map<std::string, Expected> expected_;
  std::int64_t num_free_ = 0;  ///< voxels of each map
};

TEST_P(ReleasedDatabaseTest, IsPagedOnceItWasReadForThat) {
  pages_tiles_ = true;
  Open();
  ExpectAllOfIt();
  EXPECT_EQ(Query("SELECT count(*) FROM tiles WHERE owner_key > 0 AND cells = 0"), 0);
  Open();
  const std::uint64_t before = CountPages().num_reads;
  std::vector<std::shared_ptr<const MapSnapshot>> maps;
  for (const auto& [name, expected] : expected_) maps.push_back(store_->LoadMap(name).value());
  EXPECT_EQ(CountPages().num_reads, before) << "nothing is decoded to open it";
  ExpectAllOfIt();
  EXPECT_GT(CountPages().num_reads, before);
}

TEST_P(ReleasedDatabaseTest, HoldsWhatWasWrittenAndTakesMore) {
  EXPECT_EQ(Query("PRAGMA user_version"), GetParam());
  Open();
  ExpectAllOfIt();
  Open(true);  // brought up to date: a reader takes it now
  ExpectAllOfIt();

  Open();
  for (auto& [name, expected] : expected_) {
    const auto before = store_->LoadMap(name);
    ASSERT_TRUE(before.ok());
    Map map(*before);
    map.mutable_info().num_frames += 1;
    map.Clone(SubmapId(1));
    FreeBlocks seen;
    seen.full = 1;
    map.mutable_free_space().Add({0, 0, 0}, seen, 7);
    ASSERT_TRUE(store_->Commit(**before, *map.Publish(77), Durability::kFull).ok());
    expected.digests = testing::DigestsOf(TextOf(*map.published()) + expected.config_text);
  }
  num_free_ = kBlockVoxels;
  Open();
  ExpectAllOfIt();
}

TEST_P(ReleasedDatabaseTest, TellsItsLastChangeAndWhatUndoesItsEdits) {
  Open();
  int num_edits = 0;
  for (const auto& [name, expected] : expected_) {
    const auto map = store_->GetMap(name);
    ASSERT_TRUE(map.ok());
    const auto changes = store_->ListChanges(name, map->info.revision - 1, 1'000'000);
    EXPECT_EQ(changes.ok(), GetParam() >= 7) << changes.status().ToString();
    const auto edits = store_->ListEdits(name, {});
    ASSERT_TRUE(edits.ok()) << edits.status().ToString();
    for (const LoggedEdit& edit : *edits) {
      if (edit.entry.summary.kind != EditKind::kEdit) continue;
      const auto delta = store_->LoadEdit(name, edit.entry.revision);
      EXPECT_TRUE(delta.ok()) << name << " " << edit.entry.revision << ": " << delta.status().ToString();
      ++num_edits;
    }
  }
  EXPECT_EQ(num_edits > 0, GetParam() >= 8);
}

/// Of days when a block was a row: bringing one up to date takes work in parts.
class BlockDatabaseTest : public ReleasedDatabaseTest {};

int num_parts_before_the_kill = 0;

/// The work of step 7 in parts of one tile, until the process is killed.
const SchemaWork kKilledWork = {.is_left = kBundleBlocks.is_left,
                                .do_some = [](sqlite::Database& database, std::int64_t) -> Result<std::int64_t> {
                                  if (num_parts_before_the_kill-- == 0) return Unavailable("killed");
                                  return kBundleBlocks.do_some(database, 1);
                                },
                                .unit = "submaps"};

TEST_P(BlockDatabaseTest, BringingItUpToDateGoesOnWhereItWasKilled) {
  const std::string given = Path() + ".given";
  fs::copy_file(Path(), given);
  for (const int num_parts : {0, 1, 5, 20}) {
    SCOPED_TRACE("after " + std::to_string(num_parts) + " parts");
    fs::copy_file(given, Path(), fs::copy_options::overwrite_existing);
    std::vector<SchemaStep> steps(ReleasedSteps().begin(), ReleasedSteps().begin() + 7);
    steps.back().work = &kKilledWork;
    num_parts_before_the_kill = num_parts;
    {
      auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadWrite, 1000);
      ASSERT_TRUE(database.ok());
      EXPECT_EQ(MigrateSchema(*database, steps).code(), StatusCode::kUnavailable);
      EXPECT_EQ(InspectSchema(*database).value(), SchemaState::kOlder);
    }
    EXPECT_EQ(Query("PRAGMA user_version"), 7) << "no older version may write to it meanwhile";
    EXPECT_EQ(Query("SELECT count(*) FROM tiles"), num_parts);
    EXPECT_EQ(TryOpen(true).reason(), Reason("OLDER_SCHEMA"));
    Open();
    ExpectAllOfIt();
    store_ = nullptr;
    EXPECT_EQ(Query("SELECT count(*) FROM sqlite_schema WHERE name LIKE '%_blocks' OR name = 'map_tiles'"), 0);
  }
}

int NumLeft(const std::string& message) { return std::stoi(message.substr(message.find(": ") + 2)); }

TEST_P(BlockDatabaseTest, TellsHowFarBringingItUpToDateHasCome) {
  num_parts_before_the_kill = -1;  // never
  std::vector<SchemaStep> steps(ReleasedSteps().begin(), ReleasedSteps().begin() + 7);
  steps.back().work = &kKilledWork;
  std::vector<std::string> messages;
  auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadWrite, 1000);
  ASSERT_TRUE(MigrateSchema(*database, steps, [&](const std::string& message) { messages.push_back(message); }).ok());
  ASSERT_GT(messages.size(), 3u);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_TRUE(messages[i].starts_with("bringing the database up to date: ")) << messages[i];
    EXPECT_LE(NumLeft(messages[i]), NumLeft(messages[i == 0 ? 0 : i - 1]));
  }
}

TEST_P(ReleasedDatabaseTest, DamageInItIsStillSeen) {
  Open();
  store_ = nullptr;
  for (const char* change :
       {"UPDATE maps SET num_frames = num_frames + 1", "UPDATE submaps SET activity = 1 - activity",
        "UPDATE map_config SET value = '0.5' WHERE key = 'voxel_size_m'",
        "DELETE FROM map_config WHERE key = 'truncation_m'", "UPDATE label_classes SET size = 1 - (size > 0)",
        "UPDATE maps SET checksum_version = checksum_version + 1", "UPDATE submaps SET checksum_version = 9",
        "INSERT INTO feed_sessions SELECT map_key, 'robot', 5, 6 FROM maps", "UPDATE maps SET sessions_checksum = 1",
        "UPDATE maps SET num_tiles = num_tiles + 1", "UPDATE maps SET tiles_sum = tiles_sum + 1",
        "DELETE FROM tiles WHERE layer = 1", "DELETE FROM tile_blobs",
        "INSERT INTO merged_ids SELECT map_key, 5, 1 FROM maps",
        "INSERT INTO object_pairs SELECT map_key, 1, 2, 1, 0 FROM maps", "UPDATE maps SET pairs_checksum = 1"}) {
    const std::string intact = Path() + ".intact";
    if (!fs::exists(intact)) fs::copy_file(Path(), intact);
    fs::copy_file(intact, Path(), fs::copy_options::overwrite_existing);
    Tamper(change);
    Open();
    for (const auto& [name, expected] : expected_) {
      EXPECT_EQ(store_->LoadMap(name).status().code(), StatusCode::kDataLoss) << change << ", map " << name;
    }
    store_ = nullptr;
  }
}

/// One of each schema before the present one, and of the present one once it is there.
std::vector<std::int64_t> ReleasedSchemas() {
  std::vector<std::int64_t> schemas;
  for (std::int64_t schema = 1; schema <= SchemaVersion(); ++schema) {
    if (schema < SchemaVersion() || fs::exists(Released(schema))) schemas.push_back(schema);
  }
  return schemas;
}

std::string NameOfSchema(const ::testing::TestParamInfo<std::int64_t>& schema) {
  return "Schema" + std::to_string(schema.param);
}

INSTANTIATE_TEST_SUITE_P(Schemas, ReleasedDatabaseTest, ::testing::ValuesIn(ReleasedSchemas()), NameOfSchema);
INSTANTIATE_TEST_SUITE_P(Schemas, BlockDatabaseTest, ::testing::Range<std::int64_t>(1, 7), NameOfSchema);

}  // namespace
}  // namespace dhpmap
