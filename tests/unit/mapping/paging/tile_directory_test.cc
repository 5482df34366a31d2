// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/tile_directory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <vector>

#include "mapping/base/status_error.h"
#include "mapping/changes/state_marks.h"
#include "mapping/paging/tile_evictor.h"
#include "mapping/paging/tile_page.h"
#include "tests/support/diff_snapshots.h"

namespace dhpmap {
namespace {

constexpr int kNumMade = 100;
constexpr std::uint64_t kMadeCells = 0b101;

/// Blocks whose distances say where they are.
class MadeBlocks final : public TileSource {
 public:
  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override {
    std::vector<BlockEntry> blocks;
    for (const int cell : {0, 2}) {
      auto tsdf = std::shared_ptr<TsdfBlock>(new TsdfBlock());
      tsdf->distance_m[0] = static_cast<float>(tile.index.x);
      tsdf->weight[0] = 1;
      BlockEntry& block = blocks.emplace_back();
      block.index = BlockIn(tile.index, cell);
      block.tsdf = std::move(tsdf);
    }
    return blocks;
  }
};

/// A row of tiles along x, each with a block at the first and the third cell.
class MadeDirectory final : public TileDirectory {
 public:
  Result<std::vector<Tile>> ReadAll() override {
    ++num_all;
    if (!failure.ok()) return failure;
    std::vector<Tile> tiles;
    tiles.reserve(kNumMade);
    for (int x = 0; x < kNumMade; ++x) tiles.push_back({{x, 0, 0}, Make({x, 0, 0})});
    return tiles;
  }
  Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex index) override {
    ++num_one;
    if (!failure.ok()) return failure;
    const bool is_there = index.x >= 0 && index.x < kNumMade && index.y == 0 && index.z == 0;
    return is_there ? Make(index) : nullptr;
  }

  [[nodiscard]] bool HasFew() const override { return has_few; }

  int num_all = 0, num_one = 0;
  bool has_few = false;
  Status failure;

 private:
  std::shared_ptr<const BlockTile> Make(TileIndex index) {
    const TileOnDisk there{.index = index, .cells = {kMadeCells, 0, 0}, .keys = {index.x + 1, 0, 0}, .store = 1};
    return std::make_shared<const BlockTile>(std::make_shared<const TilePage>(there, blocks_));
  }
  const std::shared_ptr<MadeBlocks> blocks_ = std::make_shared<MadeBlocks>();
};

class UnreadTilesTest : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kLoaded = 0, kWriter = 7;

  [[nodiscard]] BlockTable Table() const { return BlockTable(unread_); }
  [[nodiscard]] std::shared_ptr<Submap> Loaded(std::uint32_t id) const {
    SubmapInfo info;
    info.id = SubmapId(id);
    info.voxel_size_m = 0.1;
    return std::make_shared<Submap>(info, kLoaded, unread_);
  }
  static MapSnapshot StateOf(std::vector<std::shared_ptr<const Submap>> submaps) {
    return {MapInfo(), std::move(submaps), nullptr, {}};
  }

  const std::shared_ptr<MadeDirectory> directory_ = std::make_shared<MadeDirectory>();
  const std::shared_ptr<const UnreadTiles> unread_ = std::make_shared<const UnreadTiles>(directory_);
};

TEST_F(UnreadTilesTest, AFewBlocksAreFoundWithoutTheRest) {
  const BlockTable table = Table();
  EXPECT_FALSE(table.empty());
  for (int n = 0; n < 10; ++n) {
    const BlockEntry* block = table.Find(BlockIn({3, 0, 0}, 2));
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->tsdf->distance_m[0], 3);
    EXPECT_EQ(table.Find(BlockIn({3, 0, 0}, 1)), nullptr) << "a tile that is there, a block that is not";
    EXPECT_EQ(table.Find(BlockIn({3, 1, 0}, 0)), nullptr);
  }
  EXPECT_EQ(directory_->num_one, 2) << "once each, those that are not there, too";
  EXPECT_EQ(directory_->num_all, 0);
  EXPECT_TRUE(table.tiles_if_read().empty());
}

TEST_F(UnreadTilesTest, WhoAsksForMoreReadsAllOnceAndWhatWasFoundStays) {
  const BlockTable table = Table();
  const BlockEntry* first = table.Find(BlockIn({0, 0, 0}, 0));
  for (int x = 0; x < kNumMade; ++x) ASSERT_NE(table.Find(BlockIn({x, 0, 0}, 0)), nullptr);
  EXPECT_EQ(directory_->num_all, 1);
  EXPECT_LT(directory_->num_one, kNumMade);
  EXPECT_EQ(table.Find(BlockIn({0, 0, 0}, 0)), first);
  EXPECT_EQ(table.size(), 2u * kNumMade);
  EXPECT_EQ(table.tiles_if_read().size(), static_cast<std::size_t>(kNumMade));
  EXPECT_EQ(table.FindTile({99, 0, 0})->tile->cells(), kMadeCells);
  EXPECT_EQ(directory_->num_all, 1);
}

TEST_F(UnreadTilesTest, WhoAsksForTheSameAgainAndAgainReadsAll) {
  const BlockTable table = Table();
  for (int n = 0; n < 100'000; ++n) ASSERT_NE(table.Find(BlockIn({5, 0, 0}, 0)), nullptr);
  EXPECT_EQ(directory_->num_all, 1) << "lookups then wait for nobody";
}

TEST_F(UnreadTilesTest, WhereThereAreFewAllAreReadAtOnce) {
  directory_->has_few = true;
  const BlockTable table = Table();
  ASSERT_NE(table.Find(BlockIn({5, 0, 0}, 0)), nullptr);
  EXPECT_EQ(directory_->num_all, 1);
  EXPECT_EQ(directory_->num_one, 0);
}

TEST_F(UnreadTilesTest, AnErrorIsToldAndTriedAgain) {
  const BlockTable table = Table();
  directory_->failure = Unavailable("the disk is away");
  EXPECT_THROW((void)table.Find(BlockIn({0, 0, 0}, 0)), StatusError);
  EXPECT_THROW((void)table.tiles(), StatusError);
  EXPECT_THROW((void)table.size(), StatusError);
  BlockTable written = table;
  EXPECT_THROW(written.FindOrInsert(BlockIn({0, 0, 0}, 1), kWriter), StatusError);
  directory_->failure = Status::Ok();
  EXPECT_EQ(table.size(), 2u * kNumMade);
  EXPECT_EQ(written.size(), 2u * kNumMade);
}

TEST_F(UnreadTilesTest, WhoWritesReadsAllFirstAndOthersKeepWhatTheyHave) {
  const BlockTable table = Table();
  BlockTable written = table;
  written.FindOrInsert(BlockIn({0, 0, 0}, 1), kWriter);
  EXPECT_EQ(written.unread(), nullptr);
  EXPECT_NE(unread_->IfRead(), nullptr) << "before a store may change what is there";
  EXPECT_EQ(written.size(), 2u * kNumMade + 1);
  EXPECT_EQ(table.size(), 2u * kNumMade);
  EXPECT_TRUE(written.Erase(BlockIn({1, 0, 0}, 0), kWriter));
  EXPECT_NE(table.Find(BlockIn({1, 0, 0}, 0)), nullptr);
  EXPECT_EQ(written.FindTile({50, 0, 0})->tile, table.FindTile({50, 0, 0})->tile) << "shared";
  EXPECT_EQ(directory_->num_all, 1);
}

TEST_F(UnreadTilesTest, BlocksThatWereFoundByThemselvesAreLetGoOf) {
  const TileEvictor evictor(EvictionRule{.even_used = true});
  const BlockTable table = Table();
  BlockTable same = table;
  EXPECT_FALSE(same.Replace(evictor)) << "nothing is in memory";
  EXPECT_EQ(directory_->num_all, 0);
  ASSERT_NE(table.Find(BlockIn({3, 0, 0}, 0)), nullptr);
  EXPECT_TRUE(unread_->HoldsBlocks());
  directory_->failure = Unavailable("the disk is away");
  EXPECT_FALSE(same.Replace(evictor)) << "what cannot be read lets nobody down";
  directory_->failure = Status::Ok();
  EXPECT_TRUE(same.Replace(evictor));
  EXPECT_FALSE(same.FindTile({3, 0, 0})->tile->IsRead());
  EXPECT_EQ(same.FindTile({3, 0, 0})->tile->part_id(), table.FindTile({3, 0, 0})->tile->part_id());
  EXPECT_EQ(same.size(), table.size());
}

TEST_F(UnreadTilesTest, ManyWhoAskAtOnceReadOnce) {
  const BlockTable table = Table();
  std::vector<std::thread> readers;
  std::vector<const BlockEntry*> found(8);
  for (std::size_t n = 0; n < found.size(); ++n) {
    readers.emplace_back([&table, &found, n] {
      for (int x = 0; x < kNumMade; ++x) found[n] = table.Find(BlockIn({x, 0, 0}, 2));
    });
  }
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(directory_->num_all, 1);
  for (const BlockEntry* entry : found) EXPECT_EQ(entry, found[0]);
}

TEST_F(UnreadTilesTest, MarksOfTilesThatNobodyHasAskedForTellWhatWasWrittenSince) {
  const auto loaded = Loaded(1);
  const StateMarks marks(StateOf({loaded}));
  EXPECT_EQ(directory_->num_all, 0) << "to mark them reads nothing";
  auto moved = std::make_shared<Submap>(*loaded);
  moved->mutable_info().display_name = "moved";
  EXPECT_EQ(DiffTiles(marks, StateOf({moved})).size(), 1u) << "its row";
  EXPECT_TRUE(DiffTiles(marks, StateOf({moved}))[0].tiles.empty());
  EXPECT_EQ(directory_->num_all, 0);

  auto written = std::make_shared<Submap>(*loaded);
  written->set_generation(kWriter);
  written->MutableTsdf(BlockIn({7, 0, 0}, 2)).weight[0] = 5;
  written->EraseBlock(BlockIn({8, 0, 0}, 0));
  const MapSnapshot after = StateOf({written});
  const auto changes = DiffTiles(marks, after);
  ASSERT_EQ(changes.size(), 1u);
  ASSERT_EQ(changes[0].tiles.size(), 2u);
  for (const TileChange& tile : changes[0].tiles) {
    EXPECT_TRUE(tile.index.x == 7 || tile.index.x == 8);
    EXPECT_TRUE(tile.is_written[0]);
    EXPECT_EQ(tile.num_before[0], 2);
    EXPECT_EQ(tile.num_after[0], tile.index.x == 7 ? 2 : 1);
  }
  EXPECT_EQ(DiffSnapshots(marks, after)[0].written_tsdf.size(), 1u);
  EXPECT_EQ(directory_->num_all, 1);
}

TEST_F(UnreadTilesTest, ACopyOfTilesThatNobodyHasAskedForIsKnownAsOne) {
  const auto loaded = Loaded(1);
  const StateMarks marks(StateOf({loaded}));
  auto copy = std::make_shared<Submap>(*loaded);
  copy->mutable_info().id = SubmapId(2);
  copy->ShareBlocks();
  const MapSnapshot after = StateOf({loaded, copy});
  auto changes = DiffTiles(marks, after);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].copy_of, SubmapId(1));
  EXPECT_TRUE(changes[0].tiles.empty());
  EXPECT_EQ(directory_->num_all, 0);

  copy->set_generation(kWriter);
  copy->MutableTsdf(BlockIn({7, 0, 0}, 2)).weight[0] = 5;
  const MapSnapshot written = StateOf({loaded, copy});
  changes = DiffTiles(marks, written);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].copy_of, SubmapId(1));
  EXPECT_EQ(changes[0].tiles.size(), 1u);
}

TEST_F(UnreadTilesTest, MarksOutliveTheTilesAndHoldNoneOfThem) {
  auto directory = std::make_shared<MadeDirectory>();
  auto unread = std::make_shared<const UnreadTiles>(directory);
  auto submap = std::make_shared<Submap>(SubmapInfo(), kLoaded, unread);
  const StateMarks marks(StateOf({submap}));
  std::weak_ptr<const BlockTile> tile = submap->blocks().FindTile({3, 0, 0})->tile;
  const std::uint64_t name = tile.lock()->part_id();
  unread = nullptr;
  submap = nullptr;
  EXPECT_TRUE(tile.expired());
  const SubmapMarks* of_submap = marks.Find(SubmapId());
  ASSERT_NE(of_submap, nullptr);
  EXPECT_EQ(of_submap->tiles().size(), static_cast<std::size_t>(kNumMade));
  EXPECT_EQ(of_submap->FindTile({3, 0, 0})->tile(), name);
  EXPECT_EQ(directory->num_all, 1) << "the names are those of the tiles that there were";
}

TEST_F(UnreadTilesTest, MarksThatCannotBeReadAreOfNothing) {
  const StateMarks marks(StateOf({Loaded(1)}));
  directory_->failure = DataLoss("the disk is broken");
  EXPECT_TRUE(marks.Find(SubmapId(1))->tiles().empty()) << "nobody's commit fails for it";
}

}  // namespace
}  // namespace dhpmap
