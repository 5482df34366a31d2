// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <random>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "server/app/maps/map_import.h"
#include "server/app/maps/map_registry.h"
#include "storage/sqlite_store.h"
#include "tests/support/scenes.h"
#include "tests/unit/mapping/query/stopped_work.h"

// Cancelled work on the file ends soon and leaves nothing behind.

namespace dhpmap {
namespace {

constexpr char kMapName[] = "large";

/// One object of 8,000 blocks that are far apart, each a tile of its own, of noise that does not shrink.
std::shared_ptr<const MapSnapshot> NoisyMap() {
  constexpr int kSide = 80, kTiles = 100;
  MapInfo info;
  info.name = kMapName;
  info.label_set = testing::MakeLabelSet(2, 1);
  Map map(info);
  Submap& thing = map.Create({.panoptic = Panoptic::kThing,
                              .class_id = ClassId(1),
                              .voxel_size_m = info.config.voxel_size_m,
                              .truncation_m = info.config.truncation_m});
  std::mt19937 random(1);
  std::uniform_real_distribution<float> distance_m(-static_cast<float>(info.config.truncation_m),
                                                   static_cast<float>(info.config.truncation_m));
  for (int n = 0; n < kSide * kTiles; ++n) {
    TsdfBlock& block = thing.MutableTsdf({kTileSide * (n % kSide), kTileSide * (n / kSide), 0});
    for (float& d : block.distance_m) d = distance_m(random);
    block.weight.fill(2);
  }
  thing.UpdateBoundingSphere();
  return map.Publish(1);
}

class LargeStoreClock : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    auto store = OpenSqliteStore((folder_->path() / "maps.db").string());
    ASSERT_TRUE(store.ok());
    store_ = std::move(*store);
    ASSERT_TRUE(store_->CreateMap(*NoisyMap()).ok());
    auto registry = MapRegistry::Open(*store_, {.mapping = {.num_threads = 1}});
    ASSERT_TRUE(registry.ok());
    registry_ = std::move(*registry);
  }
  static void TearDownTestSuite() {
    registry_.reset();
    store_.reset();
    folder_.reset();
  }

  void SetUp() override { num_files_ = NumFiles(); }
  void TearDown() override { EXPECT_EQ(NumFiles(), num_files_) << "something is left behind"; }

  static std::ptrdiff_t NumFiles() {
    return std::distance(std::filesystem::directory_iterator(folder_->path()), std::filesystem::directory_iterator());
  }
  /// Whether the work was cancelled; else it succeeded.
  static bool WasLeft(const Status& status) {
    EXPECT_TRUE(status.ok() || status.code() == StatusCode::kCancelled) << status.ToString();
    return !status.ok();
  }

  static inline std::unique_ptr<testing::TempDir> folder_;
  static inline std::unique_ptr<MapStore> store_;
  static inline std::unique_ptr<MapRegistry> registry_;
  std::ptrdiff_t num_files_ = 0;
};

TEST_F(LargeStoreClock, AVerificationEndsSoonAfterACancellation) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    const auto report = registry_->Verify(kMapName, /*repair=*/false, stop);
    if (report.ok()) {
      EXPECT_EQ(report->num_faults, 0);
    }
    return WasLeft(report.status());
  });
}

TEST_F(LargeStoreClock, ABackupEndsSoonAfterACancellation) {
  testing::ExpectEndsSoonAfterAStop(
      [](const std::stop_token& stop) { return WasLeft(registry_->Backup(stop).status()); });
}

/// Else the last part of it would be all of it, and nothing ends that.
TEST_F(LargeStoreClock, ABackupIsWrittenIncrementally) {
  constexpr int kTries = 20;  // the thread that looks may come too late
  const auto is_any_written = [] {
    std::error_code gone;
    for (std::filesystem::directory_iterator it(folder_->path(), gone), end; !gone && it != end; it.increment(gone)) {
      std::error_code unknown;
      const bool is_backup = it->path().filename().string().find("-backup-") != std::string::npos;
      if (is_backup && it->file_size(unknown) > 0 && !unknown) return true;
    }
    return false;
  };
  for (int i = 0; i < kTries; ++i) {
    std::stop_source caller;
    std::jthread hanging_up([&](const std::stop_token& is_over) {
      while (!is_over.stop_requested() && !is_any_written()) std::this_thread::yield();
      caller.request_stop();
    });
    if (WasLeft(registry_->Backup(caller.get_token()).status())) return;
  }
  ADD_FAILURE() << "nothing of it was there before it was done";
}

TEST_F(LargeStoreClock, AnExportEndsSoonAfterACancellation) {
  testing::ExpectEndsSoonAfterAStop(
      [](const std::stop_token& stop) { return WasLeft(registry_->Export(kMapName, stop).status()); });
}

TEST_F(LargeStoreClock, AnImportEndsSoonAfterACancellation) {
  constexpr std::size_t kMore = std::size_t{64} << 20;  // than the file has
  const auto file = registry_->Export(kMapName, {});
  ASSERT_TRUE(file.ok());
  const auto bytes = (*file)->Read(kMore);
  ASSERT_TRUE(bytes.ok());
  ASSERT_EQ(static_cast<std::int64_t>(bytes->size()), (*file)->size_bytes());
  testing::ExpectEndsSoonAfterAStop([&](const std::stop_token& stop) {
    auto incoming = registry_->BeginImport({.name = "copy", .total_bytes = (*file)->size_bytes()});
    EXPECT_TRUE(incoming.ok()) << incoming.status().ToString();
    if (!incoming.ok()) return false;
    EXPECT_TRUE((*incoming)->Write(*bytes).ok());
    return WasLeft((*incoming)->Prepare(stop));
  });
}

}  // namespace
}  // namespace dhpmap
