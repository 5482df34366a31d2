// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/tile_page.h"

#include <gtest/gtest.h>

#include <atomic>
#include <iterator>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/base/status_error.h"
#include "mapping/changes/state_marks.h"
#include "mapping/map/map.h"
#include "mapping/paging/tile_evictor.h"
#include "tests/support/diff_snapshots.h"

namespace dhpmap {
namespace {

constexpr TileIndex kTile{-1, 0, 2};
constexpr std::uint64_t kCells = 0b1011;  // of the TSDF; the first of them has labels, too

/// Has the blocks of each tile at kCells, told apart by their first distances, and fails when it is told to.
class MadeTiles final : public TileSource {
 public:
  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override {
    ++num_reads;
    if (!failure.ok()) return failure;
    std::vector<BlockEntry> blocks;
    for (int cell = 0; cell < kTileBlocks; ++cell) {
      if ((kCells >> cell & 1u) == 0) continue;
      BlockEntry& block = blocks.emplace_back();
      block.index = BlockIn(tile.index, cell);
      const auto tsdf = std::shared_ptr<TsdfBlock>(new TsdfBlock());
      tsdf->distance_m[0] = static_cast<float>(cell);
      tsdf->weight[0] = 1;
      block.tsdf = tsdf;
      if (cell != 0) continue;
      const auto labels = std::shared_ptr<LabelBlock>(new LabelBlock());
      for (int c = 0; c < num_classes; ++c) labels->AddObservation(5, ClassId(static_cast<std::uint16_t>(4 + c)));
      block.labels = labels;
    }
    return blocks;
  }

  Status failure;
  int num_classes = 1;  ///< that are seen
  std::atomic<int> num_reads = 0;
};

class TilePages : public ::testing::Test {
 protected:
  std::shared_ptr<const BlockTile> Tile(TileIndex index = kTile, std::uint64_t tsdf_cells = kCells) {
    const TileOnDisk on_disk{.index = index, .cells = {tsdf_cells, 1, 0}, .keys = {7, 8, 0}, .store = 1};
    return std::make_shared<const BlockTile>(std::make_shared<const TilePage>(on_disk, source_));
  }
  /// With one thing of two such tiles.
  Map MapOfTiles() {
    Map map{MapInfo{.name = "m"}};
    map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
    Submap& thing = *map.FindMutable(SubmapId(1));
    thing.PutTile(kTile, Tile());
    thing.PutTile({5, 5, 5}, Tile({5, 5, 5}));
    thing.UpdateBoundingSphere();
    map.Publish(1);
    return map;
  }

  const std::shared_ptr<MadeTiles> source_ = std::make_shared<MadeTiles>();
};

TEST_F(TilePages, AreReadOnceForAllWhoAskAndNotForWhatIsKnown) {
  const auto tile = Tile();
  EXPECT_EQ(tile->size(), 3u);
  EXPECT_FALSE(tile->empty());
  EXPECT_EQ(tile->cells(), kCells);
  EXPECT_EQ(tile->CellsWith(BlockLayer::kTsdf), kCells);
  EXPECT_EQ(tile->CellsWith(BlockLayer::kLabels), 1u);
  EXPECT_EQ(tile->CellsWith(BlockLayer::kGone), 0u);
  EXPECT_EQ(tile->Find(2), nullptr);
  EXPECT_FALSE(tile->IsRead());
  const std::size_t bytes = tile->MemoryBytes();
  EXPECT_EQ(source_->num_reads, 0);

  std::vector<const BlockEntry*> found(4);
  std::vector<std::thread> readers;
  readers.reserve(std::size(found));
  for (auto& entry : found) readers.emplace_back([&tile, &entry] { entry = tile->Find(3); });
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(source_->num_reads, 1);
  for (const BlockEntry* entry : found) EXPECT_EQ(entry, found[0]);
  EXPECT_EQ(found[0]->index, BlockIn(kTile, 3));
  EXPECT_EQ(found[0]->tsdf->distance_m[0], 3);
  EXPECT_EQ(tile->entries().size(), 3u);
  EXPECT_TRUE(tile->IsRead());
  EXPECT_GT(tile->MemoryBytes(), bytes + 3 * sizeof(TsdfBlock));
}

TEST_F(TilePages, ThatCannotBeReadFailForWhoAsksAndAreTriedAgain) {
  const auto tile = Tile();
  source_->failure = Unavailable("the disk is away");
  for (int n = 0; n < 2; ++n) {
    try {
      (void)tile->entries();
      FAIL() << "nothing can be read";
    } catch (const StatusError& error) {
      EXPECT_EQ(error.status().code(), StatusCode::kUnavailable);
    }
  }
  source_->failure = Status::Ok();
  EXPECT_EQ(tile->entries().size(), 3u);
}

TEST_F(TilePages, ThatHaveOtherBlocksThanWereToldAreDamaged) {
  const auto tile = Tile(kTile, 0b1101);
  try {
    (void)tile->Find(2);
    FAIL() << "there is no such block";
  } catch (const StatusError& error) {
    EXPECT_EQ(error.status().code(), StatusCode::kDataLoss);
  }
}

TEST_F(TilePages, ACopyToWriteToHasTheBlocksInMemoryAndIsAnotherTile) {
  const auto tile = Tile();
  BlockTile copy(*tile);
  EXPECT_EQ(copy.loader(), nullptr);
  EXPECT_NE(copy.part_id(), tile->part_id());
  EXPECT_EQ(copy.stored(BlockLayer::kTsdf).In(1), 0);
  ASSERT_EQ(copy.size(), 3u);
  for (int cell : {0, 1, 3}) EXPECT_EQ(copy.Find(cell)->tsdf, tile->Find(cell)->tsdf);
  copy.Erase(1);
  EXPECT_EQ(copy.size(), 2u);
  EXPECT_EQ(tile->size(), 3u);
}

TEST_F(TilePages, PartsKeepTheirNamesWhenTheyAreReadAgain) {
  Map map = MapOfTiles();
  const auto state = map.published();
  const StateMarks marks(*state);
  EXPECT_EQ(source_->num_reads, 0);
  std::size_t num_blocks = 0;
  for (int round = 0; round < 3; ++round) {
    for (const BlockEntry& entry : map.Find(SubmapId(1))->blocks().entries()) {
      EXPECT_TRUE(marks.Has(SubmapId(1), entry));
      ++num_blocks;
    }
    map.EvictPages(true);
  }
  EXPECT_EQ(num_blocks, 18u);
  EXPECT_EQ(source_->num_reads, 6);
  EXPECT_EQ(map.info().revision, state->revision());
  EXPECT_TRUE(DiffTiles(marks, *map.published()).empty());
  EXPECT_TRUE(DiffSnapshots(marks, *map.published()).empty());

  map.FindMutable(SubmapId(1))->MutableTsdf(BlockIn(kTile, 1)).weight[1] = 1;
  map.EvictPages(true);
  const auto changes = DiffSnapshots(marks, *map.Publish(2));
  ASSERT_EQ(changes.size(), 1u);
  ASSERT_EQ(changes[0].written_tsdf.size(), 1u) << "the others of the tile are what they were";
  EXPECT_EQ(changes[0].written_tsdf[0]->index, BlockIn(kTile, 1));
  EXPECT_TRUE(changes[0].written_labels.empty());
}

TEST_F(TilePages, OfWhichNothingWasLookedThroughAreNotReadToForgetIt) {
  Map map = MapOfTiles();
  map.FindMutable(SubmapId(1))->DropGone();
  EXPECT_EQ(source_->num_reads, 0);
}

TEST_F(TilePages, WhatIsRemovedIsReadFirstForStatesOfBefore) {
  Map map = MapOfTiles();
  const auto state = map.published();
  EXPECT_TRUE(map.Remove(SubmapId(1)));
  source_->failure = DataLoss("is missing");
  std::size_t num_blocks = 0;
  for (const BlockEntry& entry : state->Find(SubmapId(1))->blocks().entries()) num_blocks += entry.tsdf != nullptr;
  EXPECT_EQ(num_blocks, 6u);
}

LabelTotals TotalsOf(const BlockTile& tile) {
  LabelTotals totals;
  tile.AddLabelsTo(totals);
  return totals;
}

TEST_F(TilePages, WhatTheirVoxelsHaveSeenIsCountedOnceThoughTheyGo) {
  const auto has_seen_one = [](const BlockTile& tile) {
    const LabelTotals totals = TotalsOf(tile);
    return totals.own == 1 && totals.instances == 1 && totals.seen == std::vector<std::uint32_t>{4};
  };
  const auto tile = Tile();
  EXPECT_TRUE(has_seen_one(*tile));
  EXPECT_FALSE(tile->IsRead()) << "what was read to count went again";
  EXPECT_EQ(source_->num_reads, 1);
  const auto in_memory = std::make_shared<const BlockTile>(*tile);
  EXPECT_EQ(source_->num_reads, 2) << "to be written to";
  const auto again = tile->LeftTo(tile->loader()->Evicted());
  EXPECT_TRUE(has_seen_one(*again));
  EXPECT_TRUE(has_seen_one(*in_memory));
  const auto left = LeftAt(*in_memory, source_);
  EXPECT_TRUE(has_seen_one(*left));
  EXPECT_FALSE(left->IsRead());
  EXPECT_EQ(source_->num_reads, 2) << "not read to be counted again";
}

TEST_F(TilePages, TilesOnTheDiskKeepNoLongListOfWhatTheirVoxelsHaveSeen) {
  BlockTile tile;
  const auto labels = std::shared_ptr<LabelBlock>(new LabelBlock());
  for (std::uint16_t c = 0; c < 50; ++c) labels->AddObservation(c, ClassId(c));
  tile.FindOrInsert(BlockIn(kTile, 0)).labels = labels;
  EXPECT_EQ(TotalsOf(tile).seen.size(), 50u);
  EXPECT_GT(tile.LabelsBytes(), 50u * 8);
  EXPECT_EQ(LeftAt(tile, source_)->LabelsBytes(), 0u);
  source_->num_classes = 50;
  const auto unread = Tile();
  EXPECT_EQ(TotalsOf(*unread).seen.size(), 50u);
  EXPECT_EQ(unread->LabelsBytes(), 0u);
}

TEST_F(TilePages, WhatTheirLabelsTakeIsKnownWithoutAUseOfThem) {
  const auto tile = Tile();
  EXPECT_EQ(tile->LabelPlaneBytes(), 0u);
  (void)tile->entries();
  EXPECT_TRUE(tile->loader()->WasUsed());
  EXPECT_EQ(tile->LabelPlaneBytes(), LabelBlock().CountedBytes());
  EXPECT_FALSE(tile->loader()->WasUsed());
  EXPECT_EQ(std::make_shared<const BlockTile>(*tile)->LabelPlaneBytes(), LabelBlock().CountedBytes());
}

TEST_F(TilePages, ThatCannotBeReadCanBeRemoved) {
  Map map = MapOfTiles();
  source_->failure = DataLoss("is missing");
  EXPECT_TRUE(map.Remove(SubmapId(1)));
  EXPECT_EQ(map.Find(SubmapId(1)), nullptr);
}

TEST_F(TilePages, NobodysUnpublishedWorkIsLetGo) {
  Map map = MapOfTiles();
  const auto state = map.published();
  map.FindMutable(SubmapId(1))->MutableTsdf(BlockIn({5, 5, 5}, 0)).weight[9] = 2;
  EXPECT_EQ(map.EvictPages(true), state);
  EXPECT_EQ(map.Find(SubmapId(1))->blocks().Find(BlockIn({5, 5, 5}, 0))->tsdf->weight[9], 2);
  map.Publish(2);
  map.EvictPages(true);
  EXPECT_EQ(map.Find(SubmapId(1))->blocks().Find(BlockIn({5, 5, 5}, 0))->tsdf->weight[9], 2);
}

TEST_F(TilePages, WhatIsStoredAnewStaysInMemory) {
  Map map = MapOfTiles();
  const BlockTile& tile = *map.Find(SubmapId(1))->blocks().FindTile(kTile)->tile;
  EXPECT_EQ(tile.stored(BlockLayer::kTsdf).In(1), 7);
  EXPECT_EQ(tile.stored(BlockLayer::kGone).In(1), 0);
  EXPECT_FALSE(tile.CanBeUnread()) << "it is not read";
  (void)tile.entries();
  EXPECT_TRUE(tile.CanBeUnread());
  tile.stored(BlockLayer::kTsdf).Set(1, 9);  // where it was read from there may be nothing any more
  const auto state = map.published();
  EXPECT_EQ(map.EvictPages(true), state);
  EXPECT_TRUE(tile.IsRead());
}

TEST_F(TilePages, AScanKeepsNothingOfWhatItReads) {
  const auto tile = Tile();
  const std::int64_t before = CountPages().resident_bytes;
  {
    const ScannedTile scanned(*tile);
    EXPECT_EQ(scanned.entries().size(), 3u);
    EXPECT_GT(CountPages().resident_bytes, before);
  }
  EXPECT_EQ(CountPages().resident_bytes, before);
  EXPECT_FALSE(tile->IsRead());
  (void)tile->entries();
  source_->failure = DataLoss("is missing");
  EXPECT_EQ(ScannedTile(*tile).entries().data(), tile->entries().data()) << "what is there is not read again";
}

}  // namespace
}  // namespace dhpmap
