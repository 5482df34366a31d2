// SPDX-License-Identifier: BSD-3-Clause
// FORMAT.md against the code: a reader in another language, written from that page alone, finds the same voxels.
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "tests/support/places.h"
#include "tests/unit/storage/map_text.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::SqliteStoreTest;

constexpr char kPython[] = "/usr/bin/python3";
constexpr int kNoZstd = 77;

class FormatTest : public SqliteStoreTest {
 protected:
  void SetUp() override { ASSERT_TRUE(fs::exists(kPython)) << "deploy/setup.sh installs it"; }

  /// What the reader says of a map.
  std::string ReadByFormat(const std::string& name, int& exit_code) {
    const std::string reader = (testing::SourceDir() / "tests/unit/storage/read_format.py").string();
    const std::string command = std::string(kPython) + " '" + reader + "' '" + Path() + "' " + name + " 2>&1";
    std::string text;
    std::FILE* const pipe = popen(command.c_str(), "r");
    std::array<char, 4096> part;
    for (std::size_t size; (size = std::fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), size);
    const int state = pclose(pipe);
    exit_code = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
    return text;
  }

  /// The same of a map in memory: the lines of map_text.h that speak of blocks.
  static std::string Expected(const MapSnapshot& map) {
    std::istringstream lines(testing::TextOf(map));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("submap ")) text += line.substr(0, line.find(' ', 7)) + "\n";
      for (const char* start : {"  block ", "    tsdf ", "    labels ", "    gone "}) {
        if (line.starts_with(start)) text += line + "\n";
      }
    }
    return text + "free " + std::to_string(map.free_space()->NumFreeVoxels()) + " vacated " +
           std::to_string(map.vacated()->NumFreeVoxels()) + "\n";
  }

  void ExpectReadable(const std::string& name) {
    SCOPED_TRACE(name);
    const auto loaded = store_->LoadMap(name);
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    int exit_code = 0;
    const std::string text = ReadByFormat(name, exit_code);
    if (exit_code == kNoZstd) GTEST_SKIP() << text;
    ASSERT_EQ(exit_code, 0) << text;
    EXPECT_EQ(text, Expected(**loaded));
  }
};

TEST_F(FormatTest, AReaderWrittenFromThePageFindsTheSameVoxels) {
  Open();
  const auto map = CreateSample("house");
  TsdfBlock& far = map->FindMutable(SubmapId(1))->MutableTsdf({40, -1, 3});
  far.weight[9] = 1;
  far.distance_m[9] = 50;  // kept exactly
  const auto before = map->published();
  generator_.Change(*map);
  generator_.AddVoxels(map->mutable_vacated());
  map->Clone(SubmapId(2));
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(20), Durability::kNormal).ok());
  ExpectReadable("house");
}

TEST_F(FormatTest, ItReadsWhatWasBroughtUpToDateToo) {
  fs::copy_file(testing::SourceDir() / "tests/unit/storage/released/schema-6.sqlite", Path());
  fs::permissions(Path(), fs::perms::owner_write, fs::perm_options::add);
  Open();
  ExpectReadable("grotto");
}

TEST_F(FormatTest, ItFindsInRowsWhichBlocksTheirBlobsHold) {
  const std::string unknown = "SELECT count(*) FROM tiles WHERE owner_key > 0 AND cells = 0";
  fs::copy_file(testing::SourceDir() / "tests/unit/storage/released/schema-6.sqlite", Path());
  fs::permissions(Path(), fs::perms::owner_write, fs::perm_options::add);
  Open();
  EXPECT_GT(Query(unknown), 0) << "of rows of before";
  pages_tiles_ = true;
  Open();
  ExpectReadable("grotto");  // which loads it
  EXPECT_GT(Query(unknown), 0) << "of a map that nobody has loaded";
  ExpectReadable("cairn");
  EXPECT_EQ(Query(unknown), 0);
  EXPECT_EQ(Query("SELECT count(*) FROM tiles WHERE owner_key < 0 AND cells <> 0"), 0) << "of layers of maps";
  ExpectReadable("grotto");
  CreateSample("house");
  EXPECT_EQ(Query(unknown), 0) << "of rows that are new";
  EXPECT_EQ(Query("SELECT count(*) FROM tiles WHERE owner_key > 0 AND layer = 1 AND extent = 0"), 0);
  ExpectReadable("house");
}

TEST_F(FormatTest, ItSeesDamage) {
  Open();
  CreateSample("house");
  for (const char* damage :
       {"UPDATE tiles SET blob_key = blob_key + 1 WHERE layer = 1", "UPDATE maps SET tiles_sum = tiles_sum + 1",
        "UPDATE tiles SET cells = cells + 1 WHERE layer = 1", "UPDATE tiles SET cells = 1 WHERE layer = 3",
        "UPDATE tiles SET extent = extent - (1 << 7) WHERE layer = 1", "UPDATE tiles SET extent = 1 WHERE layer = 3",
        "UPDATE tile_blobs SET blob = CAST(substr(blob, 1, 30) || x'5A' || substr(blob, 32) AS BLOB)"}) {
    const std::string intact = Path() + ".intact";
    store_ = nullptr;
    if (!fs::exists(intact)) fs::copy_file(Path(), intact);
    fs::copy_file(intact, Path(), fs::copy_options::overwrite_existing);
    Tamper(damage);
    int exit_code = 0;
    const std::string text = ReadByFormat("house", exit_code);
    if (exit_code == kNoZstd) GTEST_SKIP() << text;
    EXPECT_EQ(exit_code, 1) << damage << ": " << text;
  }
}

}  // namespace
}  // namespace dhpmap
