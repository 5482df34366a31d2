// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/backup.h"

#include <atomic>
#include <map>
#include <set>
#include <thread>

#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::SqliteStoreTest;

class BackupTest : public SqliteStoreTest {
 protected:
  std::string CopyPath() const { return (folder_.path() / "copy.db").string(); }

  /// Writes a backup to CopyPath() in pieces.
  void Copy(std::size_t piece_bytes = 10'000) {
    auto backup = store_->Backup({});
    ASSERT_TRUE(backup.ok()) << backup.status().ToString();
    std::ofstream out(CopyPath(), std::ios::binary | std::ios::trunc);
    std::int64_t num_bytes = 0;
    while (true) {
      const auto piece = (*backup)->Read(piece_bytes);
      ASSERT_TRUE(piece.ok());
      if (piece->empty()) break;
      out << *piece;
      num_bytes += static_cast<std::int64_t>(piece->size());
    }
    EXPECT_EQ(num_bytes, (*backup)->size_bytes());
  }
  std::unique_ptr<MapStore> OpenCopy() {
    auto store = OpenSqliteStore(CopyPath(), {});
    EXPECT_TRUE(store.ok()) << store.status().ToString();
    return store.ok() ? std::move(*store) : nullptr;
  }
  static std::shared_ptr<const MapSnapshot> OfHistory(std::uint64_t history_id, const MapSnapshot& snapshot) {
    MapInfo info = snapshot.info();
    info.history_id = history_id;
    return std::make_shared<const MapSnapshot>(std::move(info), snapshot.submaps(), snapshot.free_space(),
                                               VacatedSpace{snapshot.vacated()});
  }
  int NumFiles() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator{}));
  }
};

TEST_F(BackupTest, HoldsEveryMapAsCommitted) {
  Open();
  const auto house = CreateSample("house");
  const auto street = CreateSample("street");
  Copy();
  const auto copy = OpenCopy();
  ASSERT_NE(copy, nullptr);
  for (const Map* map : {house.get(), street.get()}) {
    const auto loaded = copy->LoadMap(map->info().name);
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    ExpectSameMap(*OfHistory((*loaded)->info().history_id, *map->published()), **loaded);
  }
}

TEST_F(BackupTest, IsOneStateWhileCommitsGoOn) {
  Open();
  const auto map = CreateSample("house");
  std::map<std::int64_t, std::shared_ptr<const MapSnapshot>> states{{map->published()->revision(), map->published()}};
  std::atomic<bool> is_done = false;
  std::thread writer([&] {
    for (std::int64_t time_ns = 12; !is_done || states.size() < 5; ++time_ns) {
      const auto before = map->published();
      generator_.Change(*map);
      const auto after = map->Publish(time_ns);
      ASSERT_TRUE(store_->Commit(*before, *after, Durability::kNormal).ok());
      states[after->revision()] = after;
    }
  });
  for (int round = 0; round < 3; ++round) Copy();
  is_done = true;
  writer.join();
  const auto copy = OpenCopy();
  ASSERT_NE(copy, nullptr);
  const auto loaded = copy->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  ASSERT_TRUE(states.contains((*loaded)->revision()));
  ExpectSameMap(*OfHistory((*loaded)->info().history_id, *states.at((*loaded)->revision())), **loaded);
}

TEST_F(BackupTest, GoesOnUnderHistoriesOfItsOwn) {
  Open();
  const auto house = CreateSample("house");
  CreateSample("street");
  Copy();
  const fs::path second = folder_.path() / "second.db";
  fs::copy_file(CopyPath(), second);
  std::set<std::uint64_t> histories{house->info().history_id};
  for (const std::string& path : {CopyPath(), second.string()}) {
    const auto reader = OpenSqliteStore(path, {.read_only = true});
    ASSERT_TRUE(reader.ok()) << reader.status().ToString();
    EXPECT_EQ((*reader)->GetMap("house")->info.history_id, house->info().history_id)
        << "who only reads changes nothing";
    for (const char* name : {"house", "street"}) {
      const auto store = OpenSqliteStore(path, {});
      ASSERT_TRUE(store.ok()) << store.status().ToString();
      const std::uint64_t history_id = (*store)->GetMap(name)->info.history_id;
      EXPECT_TRUE(histories.insert(history_id).second);
    }
    const auto again = OpenSqliteStore(path, {});
    EXPECT_TRUE(histories.contains((*again)->GetMap("house")->info.history_id)) << "drawn once";
  }
  EXPECT_EQ(store_->GetMap("house")->info.history_id, house->info().history_id) << "the original stays";
}

TEST_F(BackupTest, LeavesNothingBehind) {
  Open();
  CreateSample("house");
  const int num_files = NumFiles();
  { const auto backup = store_->Backup({}); }
  EXPECT_EQ(NumFiles(), num_files);
  std::ofstream(Path() + "-backup-7") << "of a process that was killed";
  Open();
  EXPECT_FALSE(fs::exists(Path() + "-backup-7"));
}

TEST_F(BackupTest, ThatNobodyWantsAnyMoreEnds) {
  Open();
  CreateSample("house");
  const int num_files = NumFiles();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(store_->Backup(stop.get_token()).status().code(), StatusCode::kCancelled);
  EXPECT_EQ(NumFiles(), num_files);
}

TEST_F(BackupTest, IsNotWrittenOverAFileOrIntoNoFolder) {
  Open();
  CreateSample("house");
  auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadOnly, 1000);
  ASSERT_TRUE(database.ok());
  std::ofstream(CopyPath()) << "mine";
  const Status exists = WriteBackup(*database, CopyPath(), {});
  EXPECT_EQ(exists.reason(), Reason("BACKUP_EXISTS"));
  ExpectDiscreet(exists, CopyPath());
  EXPECT_EQ(fs::file_size(CopyPath()), 4u);
  EXPECT_EQ(WriteBackup(*database, CopyPath() + "/x/y", {}).reason(), Reason("BAD_BACKUP_PATH"));
}

}  // namespace
}  // namespace dhpmap
