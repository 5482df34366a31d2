// SPDX-License-Identifier: BSD-3-Clause
// What the SQLite store makes of files that were changed behind its back.
#include "storage/connection.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::OpenMode;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::MapGenerator;
using testing::SqliteStoreTest;

/// A map of many pages in the file, nothing in the log.
std::unique_ptr<Map> CreateLarge(MapGenerator& generator, MapStore& store) {
  auto map = std::make_unique<Map>(generator.Info("house"));
  for (int n = 0; n < 40; ++n) generator.AddSubmap(*map, 8);
  EXPECT_TRUE(store.CreateMap(*map->Publish(11)).ok());
  return map;
}

TEST_F(SqliteStoreTest, AFileThatIsTruncatedUnderAnOpenStoreIsATypedError) {
  for (const std::uintmax_t kept : {0, 4096, 30'000}) {
    SCOPED_TRACE("kept " + std::to_string(kept));
    fs::remove(Path());
    Open();
    const auto map = CreateLarge(generator_, *store_);
    Open();
    ASSERT_GT(fs::file_size(Path()), 200'000u);
    ASSERT_TRUE(store_->ListMaps().ok());
    fs::resize_file(Path(), kept);
    const auto before = map->published();
    generator_.AddBlocks(*map->FindMutable(SubmapId(20)), 3);
    for (const Status& status :
         {store_->LoadMap("house").status(), store_->Commit(*before, *map->Publish(20), Durability::kFull),
          store_->LoadMap("house").status()}) {
      EXPECT_TRUE(status.code() == StatusCode::kDataLoss || status.code() == StatusCode::kUnavailable ||
                  status.code() == StatusCode::kNotFound)
          << status.ToString();
      ExpectDiscreet(status, Path());
    }
    store_ = nullptr;
    for (const char* left : {"-wal", "-shm"}) fs::remove(Path() + left);
  }
}

/// A file mapped into memory would end the process here, by SIGBUS.
TEST_F(SqliteStoreTest, AFileThatIsTruncatedInTheMiddleOfAReadIsATypedError) {
  Open();
  CreateLarge(generator_, *store_);
  store_ = nullptr;
  ReaderPool readers(Path(), OpenMode::kReadOnly, 1000);
  auto lease = readers.Borrow();
  ASSERT_TRUE(lease.ok());
  auto blobs = (**lease).Prepare("SELECT blob FROM tile_blobs ORDER BY blob_key", "read the tiles");
  ASSERT_TRUE(*blobs->Step());
  fs::resize_file(Path(), 8192);
  const Status status = blobs->Run();
  EXPECT_EQ(status.code(), StatusCode::kDataLoss) << status.ToString();
}

TEST_F(SqliteStoreTest, FlippedBytesAnywhereInTheFileNeverCrash) {
  Open();
  const auto map = CreateSample("house");
  store_ = nullptr;
  std::ifstream file(Path(), std::ios::binary);
  const std::string intact((std::istreambuf_iterator<char>(file)), {});
  int num_seen = 0;
  for (std::size_t at = 0; at < intact.size(); at += 997) {
    std::string damaged = intact;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    for (const char* left : {"-wal", "-shm"}) fs::remove(Path() + left);
    WriteFile(damaged);
    Status status = TryOpen(at % 2 == 0);
    if (status.ok()) {
      const auto loaded = store_->LoadMap("house");
      status = loaded.status();
      if (status.ok()) ExpectSameMap(*map->published(), **loaded);  // a byte that holds nothing of the map
    }
    num_seen += !status.ok();
    ExpectDiscreet(status, Path());
    store_ = nullptr;
    ASSERT_FALSE(HasFailure()) << "byte " << at;
  }
  EXPECT_GT(num_seen, 10);
}

}  // namespace
}  // namespace dhpmap
