// SPDX-License-Identifier: BSD-3-Clause
// Open maps whose voxels are read on demand, within a memory budget.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/memory_count.h"
#include "mapping/base/status_error.h"
#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "server/app/maps/map_registry.h"
#include "server/app/maps/map_stats.h"
#include "server/app/queries/mesh_export.h"
#include "server/app/queries/voxel_walk.h"
#include "storage/sqlite_store.h"
#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"
#include "tests/unit/server/app/edited_room.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

/// A registry on a database in its own folder; it can be opened again.
class PageBudgetTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Open(0);
    ASSERT_TRUE(registry_->Create(RoomInfo("room")).ok());
    Integrate(0, 4);
  }
  void TearDown() override { Close(); }

  [[nodiscard]] OpenMapOptions Options(std::int64_t page_bytes) const {
    return {.mapping = {.num_threads = 2, .refinement_timing = RefinementTiming::kReproducible},
            .pages = {.budget_bytes = page_bytes, .spill = page_bytes > 0 ? spill_ : nullptr}};
  }
  /// 0: maps are read as a whole.
  void Open(std::int64_t page_bytes) {
    Close();
    store_ = OpenSqliteStore((folder_.path() / "maps.db").string(), {.pages_tiles = page_bytes > 0}).value();
    registry_ = MapRegistry::Open(*store_, Options(page_bytes)).value();
  }
  void Close() {
    if (registry_ != nullptr) {
      EXPECT_TRUE(registry_->Shutdown().ok());
    }
    registry_ = nullptr;
    store_ = nullptr;
  }
  /// Returns once all frames are visible and stored.
  void Integrate(int begin, int end) {
    const auto session = registry_->GetOpen("room").value();
    for (int i = begin; i < end; ++i) {
      const auto outcome = Wait<FrameOutcome>([&](auto done) { session->Integrate(FrameOf(i), done); });
      EXPECT_TRUE(outcome.report.ok()) << outcome.report.status().ToString();
    }
    EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  }
  std::shared_ptr<const MapView> View() { return registry_->ViewOf("room").value(); }
  /// A copy that is completely in memory.
  std::shared_ptr<const MapSnapshot> Whole() {
    auto snapshot = View()->shared_snapshot();
    for (const auto& submap : snapshot->submaps()) ReadAllOf(*submap);
    return snapshot;
  }
  static void ReadAllOf(const Submap& submap) {
    for (const BlockEntry& entry : submap.blocks().entries()) ASSERT_NE(entry.tsdf, nullptr);
  }
  /// Damages the file while it is closed.
  void DamageBlobsOfLabels() const {
    std::fstream file(folder_.path() / "maps.db", std::ios::in | std::ios::out | std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const std::string labels("\x22\x01\x00\x28\xB5\x2F\xFD", 7);  // of a tile, as a frame of zstd
    std::size_t found = bytes.find(labels);
    ASSERT_NE(found, std::string::npos);
    for (; found != std::string::npos; found = bytes.find(labels, found + 1)) {
      file.seekp(static_cast<std::streamoff>(found + 8));
      file.put(static_cast<char>(bytes[found + 8] ^ 0x20));
    }
  }
  /// Why some of what a state has on the disk cannot be read, whatever of it is in memory; or OK.
  static Status ReadAnew(const MapSnapshot& state) {
    try {
      for (const auto& submap : state.submaps()) {
        for (const TileEntry& tile : submap->blocks().tiles()) {
          if (tile.tile->loader() != nullptr) (void)tile.tile->loader()->Evicted()->blocks();
        }
      }
      return Status::Ok();
    } catch (const StatusError& error) {
      return error.status();
    }
  }
  static std::int64_t ResidentBytes() { return CountPages().resident_bytes; }

  testing::TempDir folder_;
  std::shared_ptr<TileSpill> spill_;  ///< of the registry that is opened next, if it has a budget
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<MapRegistry> registry_;
};

TEST_F(PageBudgetTest, PagesReadByQueriesAreEvictedOnceUnusedAndOverBudget) {
  const std::int64_t before = ResidentBytes();
  Open(1);
  auto held = View();
  EXPECT_EQ(ResidentBytes(), before) << "to open it reads nothing";
  for (const auto& submap : held->snapshot().submaps()) ReadAllOf(*submap);
  const std::int64_t of_all = ResidentBytes() - before;
  EXPECT_GT(of_all, 0);
  EXPECT_TRUE(testing::Eventually([&] { return View() != held; })) << "the next who ask get a state without them";
  EXPECT_EQ(View()->snapshot().revision(), held->snapshot().revision());
  EXPECT_GE(ResidentBytes() - before, of_all) << "of who holds the state";
  held = nullptr;
  EXPECT_TRUE(testing::Eventually([&] { return ResidentBytes() == before; }));
}

TEST_F(PageBudgetTest, ReadersOfAnotherMapDoNotEvictRecentStates) {
  Open(1);
  ASSERT_TRUE(registry_->Create(RoomInfo("other")).ok());
  const auto other = registry_->GetOpen("other").value();
  const auto flush = [&other] { return Wait<Status>([&](auto done) { other->Flush(done); }); };
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(Wait<FrameOutcome>([&](auto done) { other->Integrate(FrameOf(i), done); }).report.ok());
    ASSERT_TRUE(flush().ok());
  }
  const std::size_t num_kept = other->history()->size();
  ASSERT_GT(num_kept, 1u);
  EXPECT_FALSE(other->history()->HoldBlocks(false));
  const auto held = registry_->GetOpen("room").value()->View();
  for (const auto& submap : held->snapshot().submaps()) ReadAllOf(*submap);
  EXPECT_GT(ResidentBytes(), 1);
  other->KeepPagesInBounds();
  ASSERT_TRUE(flush().ok());  // after that
  EXPECT_EQ(other->history()->size(), num_kept);
  SnapshotHistory of_room(2, std::make_shared<ByteBudget>(1));
  of_room.Keep(held->shared_snapshot());
  EXPECT_TRUE(of_room.HoldBlocks(false));
}

// Also what a commit under way holds meanwhile, which is one of the kept states at its end.
TEST_F(PageBudgetTest, PagesReadByFramesAreEvictedOncePublishedAndStored) {
  const std::int64_t before = ResidentBytes();
  Close();
  store_ = OpenSqliteStore((folder_.path() / "maps.db").string(), {.pages_tiles = true}).value();
  OpenMapOptions options = Options(1);
  options.publish.frames = options.commit.frames = 1000;
  options.publish.delay_s = options.commit.delay_s = 1000;
  {
    OpenMap session(store_->LoadMap("room").value(), *store_, options);
    for (int i = 4; i < 7; ++i) {
      ASSERT_TRUE(Wait<FrameOutcome>([&](auto done) { session.Integrate(FrameOf(i), done); }).report.ok());
    }
    EXPECT_GT(ResidentBytes(), before) << "nothing of it can go yet";
    ASSERT_TRUE(Wait<Status>([&](auto done) { session.Flush(done); }).ok());
    EXPECT_TRUE(testing::Eventually([&] { return ResidentBytes() == before; }));
  }
  store_ = nullptr;
}

TEST_F(PageBudgetTest, AMapWithAPinnedStateStaysOpenAndReadable) {
  Open(1 << 30);
  auto held = View();
  const auto close = [this] { registry_->CloseIdleMaps(MapRegistry::Clock::now() + std::chrono::hours(1)); };
  close();
  EXPECT_EQ(registry_->OpenMaps().size(), 1u);
  Integrate(4, 12);
  close();
  EXPECT_EQ(registry_->OpenMaps().size(), 1u) << "an earlier one, too";
  Integrate(12, 20);
  for (const auto& submap : held->snapshot().submaps()) ReadAllOf(*submap);
  held = nullptr;
  EXPECT_TRUE(testing::Eventually([&] {
    close();
    return registry_->OpenMaps().empty();
  }));
}

TEST_F(PageBudgetTest, ADamagedOpenMapIsClosedAndRepaired) {
  Open(1 << 30);
  {
    const auto whole = View();
    const auto report = registry_->Verify("room", true, {});
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->num_faults, 0);
    EXPECT_EQ(registry_->OpenMaps().size(), 1u) << "there is nothing to be repaired";
  }
  Close();
  DamageBlobsOfLabels();
  Open(1 << 30);
  const auto read_all = [this] {
    const auto view = View();
    for (const auto& submap : view->snapshot().submaps()) ReadAllOf(*submap);
  };
  EXPECT_THROW(read_all(), StatusError);
  {
    const auto in_use = registry_->GetOpen("room").value();
    EXPECT_FALSE(registry_->Verify("room", true, {}).value().is_repaired);
    EXPECT_EQ(registry_->OpenMaps().size(), 1u);
  }
  const auto repaired = registry_->Verify("room", true, {});
  ASSERT_TRUE(repaired.ok()) << repaired.status().ToString();
  EXPECT_TRUE(repaired->is_repaired);
  EXPECT_TRUE(registry_->OpenMaps().empty());
  EXPECT_NO_THROW(read_all());
}

TEST_F(PageBudgetTest, StatisticsCountMemoryAndLoadNothing) {
  const std::int64_t before = ResidentBytes();
  const MapStats whole = ComputeStats(View()->snapshot(), true);
  EXPECT_EQ(whole.num_tsdf_blocks_in_memory, whole.num_tsdf_blocks);
  EXPECT_GE(whole.label_plane_bytes_in_memory, 2 * kBlockVoxels * whole.num_label_blocks);
  EXPECT_LE(whole.label_plane_bytes_in_memory, 8 * kBlockVoxels * whole.num_label_blocks);
  Open(1 << 30);
  const MapStats paged = ComputeStats(View()->snapshot(), true);
  EXPECT_EQ(paged.num_tsdf_blocks, whole.num_tsdf_blocks);
  EXPECT_EQ(paged.num_label_blocks, whole.num_label_blocks);
  EXPECT_EQ(paged.num_observed_voxels, whole.num_observed_voxels);
  EXPECT_EQ(paged.num_tsdf_blocks_in_memory, 0);
  ThreadPool pool(3);
  const Spread on_threads = [&pool](std::size_t count, const auto& body) { pool.ParallelFor(count, body); };
  EXPECT_EQ(ComputeStats(View()->snapshot(), true, on_threads).num_observed_voxels, whole.num_observed_voxels);
  EXPECT_EQ(paged.label_plane_bytes_in_memory, 0);
  const auto tsdf_bytes = whole.num_tsdf_blocks * static_cast<std::int64_t>(sizeof(TsdfBlock));
  EXPECT_LT(paged.memory_bytes, whole.memory_bytes - tsdf_bytes / 2);
  EXPECT_EQ(ResidentBytes(), before);
}

/// The centres and distances of all voxels of all submaps, then the map's mesh as a file.
std::string WalkAndMesh(const std::shared_ptr<const MapSnapshot>& state, const Spread& spread) {
  std::string bytes;
  for (const auto& submap : state->submaps()) {
    auto walk = VoxelWalk::Begin(state, submap->id(), 0, spread).value();
    while (!walk.is_done()) {
      for (const ObservedVoxel& voxel : walk.NextBlock()) {
        bytes.append(reinterpret_cast<const char*>(voxel.centre_m.data()), sizeof(voxel.centre_m));
        bytes.append(reinterpret_cast<const char*>(&voxel.distance_m), sizeof(voxel.distance_m));
      }
    }
  }
  MeshFile file = ExportMesh(state, {}, {}, spread).value();
  for (std::string piece; file.Next(piece);) bytes += piece;
  return bytes;
}

TEST_F(PageBudgetTest, VoxelsAndMeshesReadAheadEqualThoseInMemory) {
  Open(0);
  const std::string whole = WalkAndMesh(View()->shared_snapshot(), InPlace);
  ThreadPool pool(3);
  std::size_t most_at_once = 0;
  const Spread on_threads = [&](std::size_t count, const auto& body) {
    most_at_once = std::max(most_at_once, count);
    pool.ParallelFor(count, body);
  };
  Open(1 << 30);
  const PageCounts before = CountPages();
  EXPECT_TRUE(WalkAndMesh(View()->shared_snapshot(), on_threads) == whole);
  EXPECT_GT(most_at_once, 1u);
  EXPECT_GT(CountPages().num_reads, before.num_reads);
}

TEST_F(PageBudgetTest, AFailedReadAheadIsReportedToItsCaller) {
  Close();
  DamageBlobsOfLabels();
  Open(1 << 30);
  ThreadPool pool(3);
  const Spread on_threads = [&pool](std::size_t count, const auto& body) { pool.ParallelFor(count, body); };
  const auto code_of = [](const auto& work) {
    try {
      work();
      return StatusCode::kOk;
    } catch (const StatusError& error) {
      return error.status().code();
    }
  };
  const auto state = View()->shared_snapshot();
  EXPECT_EQ(code_of([&] { (void)ExportMesh(state, {}, {}, on_threads); }), StatusCode::kDataLoss);
  EXPECT_EQ(code_of([&] { (void)ComputeStats(*state, true, on_threads); }), StatusCode::kDataLoss);
  EXPECT_EQ(code_of([&] { (void)WalkAndMesh(state, on_threads); }), StatusCode::kDataLoss);
}

TEST_F(PageBudgetTest, LookupsInLoadedTilesAreCounted) {
  Open(1 << 30);
  const auto view = View();
  for (const auto& submap : view->snapshot().submaps()) ReadAllOf(*submap);
  const std::uint64_t before = CountPages().num_hits;
  constexpr std::uint64_t kTimes = 1000, kNotTold = 256;
  const TileEntry& tile = view->snapshot().submaps().back()->blocks().tiles().front();
  for (std::uint64_t i = 0; i < kTimes; ++i) (void)tile.tile->entries();
  EXPECT_GE(CountPages().num_hits, before + kTimes - kNotTold);
  EXPECT_LE(CountPages().num_hits, before + kTimes + kNotTold);
}

TEST_F(PageBudgetTest, WrittenTilesAreSpilledAndReadBackUnchanged) {
  Close();
  const std::size_t before = CountOf(MemoryKind::kBlocks).now_bytes();
  spill_ = OpenTileSpill(folder_.path().string()).value();
  Open(1);
  Integrate(4, 8);
  EXPECT_TRUE(testing::Eventually([&] { return CountOf(MemoryKind::kBlocks).now_bytes() == before; }))
      << "stored states of before do not keep it";
  {
    const auto view = View();
    std::size_t num_read = 0;
    for (const auto& submap : view->snapshot().submaps()) {
      for (const TileEntry& entry : submap->blocks().tiles()) num_read += entry.tile->IsRead() ? 1 : 0;
      ReadAllOf(*submap);
    }
    EXPECT_EQ(num_read, 0u);
    EXPECT_GT(CountOf(MemoryKind::kBlocks).now_bytes(), before);
  }
  Integrate(8, 12);  // which writes to what was left
  EXPECT_TRUE(testing::Eventually([&] {
    (void)View();
    return CountOf(MemoryKind::kBlocks).now_bytes() == before;
  }));
}

TEST_F(PageBudgetTest, FramesMakeTheSameMapAsInMemory) {
  const testing::TempDir other;
  Close();
  std::filesystem::copy_file(folder_.path() / "maps.db", other.path() / "maps.db");
  spill_ = OpenTileSpill(folder_.path().string()).value();
  Open(1);
  Integrate(4, 12);
  const auto paged = Whole();

  const auto store = OpenSqliteStore((other.path() / "maps.db").string()).value();
  const auto registry = MapRegistry::Open(*store, Options(0)).value();
  const auto session = registry->GetOpen("room").value();
  for (int i = 4; i < 12; ++i) {
    const auto outcome = Wait<FrameOutcome>([&](auto done) { session->Integrate(FrameOf(i), done); });
    EXPECT_TRUE(outcome.report.ok());
  }
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_TRUE(testing::MapsAreEqual(*session->View()->shared_snapshot(), *paged));
  EXPECT_TRUE(testing::MapsAreEqual(**store->LoadMap("room"), **store_->LoadMap("room"))) << "as they are stored, too";
}

TEST_F(PageBudgetTest, APinnedStateOfAReopenedMapExpiresWhenTheMapChanges) {
  Open(std::int64_t{1} << 30);
  const auto held = View()->shared_snapshot();  // a view would keep the map open
  registry_->CloseIdleMaps(MapRegistry::Clock::now() + std::chrono::hours(1000));
  ASSERT_TRUE(registry_->OpenMaps().empty());
  EXPECT_TRUE(ReadAnew(*held).ok()) << "nothing was changed yet";
  Integrate(4, 12);
  EXPECT_TRUE(testing::Eventually([&] {
    const Status status = ReadAnew(*held);
    EXPECT_NE(status.code(), StatusCode::kDataLoss) << status.ToString();
    return status.code() == StatusCode::kAborted && status.reason() == Reason("SNAPSHOT_EXPIRED");
  })) << "once what nothing needs any more is collected";
  EXPECT_TRUE(ReadAnew(View()->snapshot()).ok());
}

TEST_F(PageBudgetTest, ADamagedTileFailsItsReadersOnly) {
  Close();
  {
    auto opened = OpenSqliteStore((folder_.path() / "maps.db").string(), {.pages_tiles = true});
    ASSERT_TRUE(opened.ok());
    store_ = std::move(opened).value();
  }
  auto snapshot = store_->LoadMap("room").value();
  store_ = nullptr;  // nothing more can be read of it
  const Submap& unread = *snapshot->submaps().back();
  EXPECT_THROW((void)unread.blocks().entries().front(), StatusError);
  const auto memory = MakeMemoryStore();
  OpenMap session(snapshot, *memory, {.mapping = {.num_threads = 1}});
  const auto frame = Wait<FrameOutcome>([&](auto done) { session.Integrate(FrameOf(4), done); });
  EXPECT_EQ(frame.report.status().code(), StatusCode::kUnavailable) << frame.report.status().ToString();
  const auto renamed = Wait<Result<EditOutcome>>([&](auto done) {
    session.Edit(
        [&](Map& map) -> Result<SubmapId> {
          map.FindMutable(unread.id())->DropLabels();
          return unread.id();
        },
        done);
  });
  EXPECT_EQ(renamed.status().code(), StatusCode::kUnavailable) << renamed.status().ToString();
  EXPECT_EQ(session.View()->snapshot().revision(), snapshot->revision()) << "nothing was changed";
}

/// Two rooms with the same frames and edits; one keeps as little as possible in memory.
class PagedRoomTest : public ::testing::Test {
 protected:
  template <typename Step>
  void OnBoth(const std::string& told, const Step& step) {
    SCOPED_TRACE(told);
    const Status of_whole = step(whole_), of_paged = step(paged_);
    EXPECT_EQ(of_whole.ToString(), of_paged.ToString());
    ASSERT_TRUE(testing::MapsAreEqual(*whole_.Now(), *paged_.Now()));
  }
  void Frames(int begin, int end, bool has_crate) {
    for (int i = begin; i < end; ++i) {
      const testing::RoomView view{.place = i * 5 % testing::kNumPlaces, .has_crate = has_crate};
      OnBoth("frame " + std::to_string(i), [&view](EditedRoom& room) { return room.Integrate(view, false); });
    }
  }
  void Finish() {
    OnBoth("finish", [](EditedRoom& room) { return room.Finish(); });
  }
  void Restart() {
    OnBoth("restart", [](EditedRoom& room) {
      Status flushed = room.Flush();
      room.Restart();
      return flushed;
    });
  }
  void Make(const Edit& edit) {
    OnBoth("edit", [&edit](EditedRoom& room) { return room.Make({.edits = {edit}}, "anna").status(); });
  }
  void Undo() {
    OnBoth("undo", [](EditedRoom& room) { return room.Undo({.author = "anna"}).status(); });
  }
  /// One of the existing things.
  [[nodiscard]] SubmapId Thing(std::size_t number) const {
    std::vector<SubmapId> things;
    for (const auto& submap : whole_.Now()->submaps()) {
      if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap->id());
    }
    EXPECT_FALSE(things.empty());
    return things.empty() ? SubmapId(0) : things[number % things.size()];
  }

  using EditedRoom = testing::EditedRoom;
  EditedRoom whole_{EditedRoom::Store::kSqlite}, paged_{EditedRoom::Store::kPaged};
};

TEST_F(PagedRoomTest, IsBitForBitTheOneInMemory) {
  Frames(0, 9, true);
  Finish();
  Restart();
  Frames(9, 14, true);
  SubmapPatch moved;
  moved.T_map_submap = Transform(Eigen::Translation3d(0.1, 0, 0.4));
  Make({.target = Thing(0), .etag = {}, .action = PatchEdit{moved}});
  Make({.target = Thing(1), .etag = {}, .action = CloneEdit{moved}});
  Restart();
  Make({.target = Thing(1), .etag = {}, .action = DeleteEdit{}});
  Frames(14, 18, false);
  Undo();
  Restart();
  Undo();
  Frames(18, 24, false);
  Finish();
  Restart();
  EXPECT_EQ(paged_.store().VerifyMap("room", false, {}).value().num_faults, 0);
}

}  // namespace
}  // namespace dhpmap
