// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/map_owners_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/scenes.h"

namespace dhpmap::auth {
namespace {

class MapOwnersTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<MapOwnersFile> Open() const {
    auto owners = MapOwnersFile::Open(path);
    EXPECT_TRUE(owners.ok()) << owners.status().ToString();
    return *std::move(owners);
  }
  testing::TempDir folder;
  const std::string path = (folder.path() / "maps.db.owners").string();
};

TEST_F(MapOwnersTest, SurviveARestart) {
  EXPECT_TRUE(Open()->Add(7, "anna").ok());
  EXPECT_TRUE(Open()->Add(UINT64_MAX, "b\"ert").ok());
  const auto owners = Open();
  EXPECT_EQ(*owners->OwnerOf(7), "anna");
  EXPECT_EQ(*owners->OwnerOf(UINT64_MAX), "b\"ert");
  EXPECT_EQ(*owners->OwnerOf(8), std::nullopt);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST_F(MapOwnersTest, ATruncatedOrForeignLineSpoilsNoOther) {
  EXPECT_TRUE(Open()->Add(7, "anna").ok());
  std::ofstream(path, std::ios::app)
      << "\n[1]\n{\"map\": 5}\n{\"map\":\"x\",\"principal\":\"a\"}\n{\"map\":\"9\",\"pri";
  EXPECT_TRUE(Open()->Add(8, "bert").ok());
  const auto owners = Open();
  EXPECT_EQ(owners->size(), 2u);
  EXPECT_EQ(*owners->OwnerOf(7), "anna");
  EXPECT_EQ(*owners->OwnerOf(8), "bert");
}

TEST_F(MapOwnersTest, ForgetDeletedMaps) {
  const auto owners = Open();
  for (std::uint64_t id = 1; id <= 100; ++id) EXPECT_TRUE(owners->Add(id, "anna").ok());
  const auto before = std::filesystem::file_size(path);
  EXPECT_TRUE(owners->Keep({5, 6, 1000}).ok());
  EXPECT_EQ(owners->size(), 2u);
  EXPECT_LT(std::filesystem::file_size(path), before / 10);
  EXPECT_TRUE(owners->Add(101, "anna").ok());
  EXPECT_EQ(Open()->size(), 3u);
}

TEST_F(MapOwnersTest, ReportAFailedWrite) {
  const auto full = MapOwnersFile::Open("/dev/full");
  ASSERT_TRUE(full.ok()) << full.status().ToString();
  EXPECT_EQ((*full)->Add(7, "anna").reason(), Reason("NOT_STORED"));
  EXPECT_EQ(*(*full)->OwnerOf(7), "anna") << "and it counts";
  std::filesystem::create_symlink(folder.path() / "elsewhere", path);
  EXPECT_EQ(MapOwnersFile::Open(path).status().reason(), Reason("BAD_KEY_FILE"));
  const auto kept_nowhere = MapOwnersFile::Open("");
  ASSERT_TRUE(kept_nowhere.ok());
  EXPECT_TRUE((*kept_nowhere)->Add(7, "anna").ok());
}

}  // namespace
}  // namespace dhpmap::auth
