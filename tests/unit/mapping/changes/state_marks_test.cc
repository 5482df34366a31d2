// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/changes/state_marks.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/support/diff_snapshots.h"

#if defined(DHPMAP_SANITIZED)
// GCC's sanitizers have it, but Debian packs no header that declares it.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();  // NOLINT(bugprone-reserved-identifier)
#endif

namespace dhpmap {
namespace {

constexpr SubmapId kThing{1};

/// `num_blocks` in a row, with all layers.
Map RowOfBlocks(int num_blocks) {
  MapInfo info;
  info.name = "m";
  Map map(std::move(info));
  Submap& submap = map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
  for (int x = 0; x < num_blocks; ++x) {
    submap.MutableTsdf({x, 0, 0}).weight[0] = 1;
    submap.MutableLabels({x, 0, 0}).AddObservation(0, ClassId(1));
  }
  return map;
}

/// Of memory that was asked for and not given back.
std::size_t BytesInUse() {
#if defined(DHPMAP_SANITIZED)
  return __sanitizer_get_current_allocated_bytes();
#else
  return mallinfo2().uordblks;
#endif
}

bool Has(const StateMarks& marks, const Map& map, int x) {
  return marks.Has(kThing, *map.Find(kThing)->blocks().Find({x, 0, 0}));
}

TEST(StateMarks, TellWhichBlocksWereWrittenSince) {
  Map map = RowOfBlocks(5);
  const StateMarks marks(*map.Publish(0));
  for (int x = 0; x < 5; ++x) EXPECT_TRUE(Has(marks, map, x));
  map.FindMutable(kThing)->MutableTsdf({1, 0, 0});
  map.FindMutable(kThing)->MutableLabels({2, 0, 0});
  map.FindMutable(kThing)->MutableGone({3, 0, 0});
  map.FindMutable(kThing)->MutableTsdf({9, 0, 0});
  EXPECT_TRUE(Has(marks, map, 0));
  EXPECT_FALSE(Has(marks, map, 1));
  EXPECT_FALSE(Has(marks, map, 2));
  EXPECT_FALSE(Has(marks, map, 3));
  EXPECT_TRUE(Has(marks, map, 4));
  EXPECT_FALSE(Has(marks, map, 9)) << "is new";
}

TEST(StateMarks, TellACloneFromItsOriginal) {
  Map map = RowOfBlocks(1);
  const StateMarks marks(*map.Publish(0));
  const SubmapId clone = map.Clone(kThing)->id();
  EXPECT_FALSE(marks.Has(clone, *map.Find(clone)->blocks().Find({0, 0, 0})));
}

TEST(StateMarks, KnowWhatIsWrittenAnewInThePlaceOfWhatIsGone) {
  Map map = RowOfBlocks(1);
  const StateMarks marks(*map.Publish(0));
  for (int i = 1; i < 20; ++i) {  // memory that was freed is soon given to the next
    map.FindMutable(kThing)->MutableTsdf({0, 0, 0});
    map.Publish(i);
    EXPECT_FALSE(Has(marks, map, 0));
  }
}

/// Everything that a difference says, in one line each.
std::vector<std::string> TextOf(const std::vector<SubmapChange>& changes) {
  std::vector<std::string> lines;
  for (const SubmapChange& change : changes) {
    const std::string id = std::to_string(change.id.value);
    lines.push_back(id + (change.after == nullptr ? " removed" : change.is_new ? " new" : " written"));
    const auto add = [&](const char* what, BlockIndex b) {
      lines.push_back(id + what + std::to_string(b.x) + ' ' + std::to_string(b.y) + ' ' + std::to_string(b.z));
    };
    for (const BlockEntry* entry : change.written_tsdf) add(" tsdf ", entry->index);
    for (const BlockEntry* entry : change.written_labels) add(" labels ", entry->index);
    for (const BlockEntry* entry : change.written_gone) add(" gone ", entry->index);
    for (const BlockIndex index : change.erased_tsdf) add(" no tsdf ", index);
    for (const BlockIndex index : change.erased_labels) add(" no labels ", index);
    for (const BlockIndex index : change.erased_gone) add(" no gone ", index);
  }
  return lines;
}

/// One of the changes that writers make, at random.
void Change(std::mt19937& random, Map& map) {
  const SubmapId id = map.submaps()[random() % map.submaps().size()]->id();
  const BlockIndex block{static_cast<std::int32_t>(random() % 12) - 6, 0, static_cast<std::int32_t>(random() % 2)};
  switch (random() % 10) {
    case 0: map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04}); break;
    case 1: map.Clone(id); break;
    case 2: map.Remove(id); break;
    case 3: map.FindMutable(id)->EraseBlock(block); break;
    case 4: map.FindMutable(id)->DropLabels(); break;
    case 5: map.FindMutable(id)->DropGone(); break;
    case 6: map.FindMutable(id)->MutableGone(block).Set(3, 2); break;
    case 7: map.FindMutable(id)->MutableLabels(block).AddObservation(3, ClassId(1)); break;
    case 8: {
      FreeBlocks seen;
      seen.full = 1;
      FreeSpace& layer = random() % 2 == 0 ? map.mutable_free_space() : map.mutable_vacated();
      layer.Add({block.x, 0, block.z}, seen, static_cast<std::int64_t>(random()));
      break;
    }
    default: map.FindMutable(id)->MutableTsdf(block).weight[3] = 1;
  }
}

TEST(StateMarks, TellTheDifferenceOfTwoStatesAsTheStatesThemselvesDo) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    Map map = RowOfBlocks(8);
    auto before = map.Publish(0);
    StateMarks marks(*before);
    for (int step = 1; step < 40; ++step) {
      for (auto num = random() % 8; num > 0; --num) Change(random, map);
      const auto after = map.Publish(step);
      auto expected = TextOf(DiffSnapshots(before.get(), *after)), told = TextOf(DiffSnapshots(marks, *after));
      ASSERT_EQ(told, expected) << "seed " << seed << " step " << step;
      const FreeSpaceChange free = DiffFreeSpace(before->free_space().get(), *after->free_space());
      const FreeSpaceChange free_told = DiffFreeSpace(marks, *after->free_space());
      ASSERT_EQ(free_told.written, free.written);
      ASSERT_EQ(free_told.erased.size(), free.erased.size());
      ASSERT_EQ(DiffVacated(marks, *after->vacated()).written,
                DiffFreeSpace(before->vacated().get(), *after->vacated()).written);
      if (step % 3 == 0) continue;  // later states are compared with this one, too
      marks = StateMarks(*after, step % 2 == 0 ? &marks : nullptr);
      before = after;
    }
  }
}

using LayersOfTiles = std::map<TileIndex, std::array<bool, kNumBlockLayers>>;

/// Which layers of which tiles were written, from the difference block by block.
LayersOfTiles WrittenLayers(const SubmapChange& change) {
  LayersOfTiles tiles;
  const auto add = [&tiles](BlockLayer layer, BlockIndex block) {
    tiles[TileOf(block)][static_cast<std::size_t>(layer)] = true;
  };
  for (const BlockEntry* entry : change.written_tsdf) add(BlockLayer::kTsdf, entry->index);
  for (const BlockEntry* entry : change.written_labels) add(BlockLayer::kLabels, entry->index);
  for (const BlockEntry* entry : change.written_gone) add(BlockLayer::kGone, entry->index);
  for (const BlockIndex index : change.erased_tsdf) add(BlockLayer::kTsdf, index);
  for (const BlockIndex index : change.erased_labels) add(BlockLayer::kLabels, index);
  for (const BlockIndex index : change.erased_gone) add(BlockLayer::kGone, index);
  return tiles;
}

std::array<std::int32_t, kNumBlockLayers> NumBlocks(const Submap* submap, TileIndex index) {
  std::array<std::int32_t, kNumBlockLayers> counts{};
  const TileEntry* tile = submap != nullptr ? submap->blocks().FindTile(index) : nullptr;
  if (tile == nullptr) return counts;
  for (const BlockEntry& entry : tile->tile->entries()) {
    counts[0] += entry.tsdf != nullptr;
    counts[1] += entry.labels != nullptr;
    counts[2] += entry.gone != nullptr;
  }
  return counts;
}

TEST(StateMarks, TellTheDifferenceTileByTileAsBlockByBlock) {
  std::mt19937 random(8);
  Map map = RowOfBlocks(10);
  int num_clones = 0;
  for (int round = 0; round < 60; ++round) {
    const auto before = map.Publish(round);
    const StateMarks marks(*before);
    for (int n = 0; n < 6; ++n) Change(random, map);
    const auto after = map.Publish(1000 + round);
    const std::vector<SubmapChange> blocks = DiffSnapshots(marks, *after);
    const std::vector<SubmapTileChange> tiles = DiffTiles(marks, *after);
    ASSERT_EQ(tiles.size(), blocks.size());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      // A clone is compared with what it was cloned from.
      const Submap* old = before->Find(tiles[i].copy_of.value_or(tiles[i].id));
      num_clones += tiles[i].copy_of.has_value();
      EXPECT_TRUE(!tiles[i].copy_of || (tiles[i].is_new && old != nullptr));
      EXPECT_EQ(tiles[i].id, blocks[i].id);
      EXPECT_EQ(tiles[i].after, blocks[i].after);
      EXPECT_EQ(tiles[i].is_new, blocks[i].is_new);
      LayersOfTiles written;
      for (const TileChange& tile : tiles[i].tiles) {
        const bool is_any_written =
            std::find(tile.is_written.begin(), tile.is_written.end(), true) != tile.is_written.end();
        if (is_any_written) written[tile.index] = tile.is_written;
        else EXPECT_NE(tile.after, nullptr) << "only another object with the same layers";
        EXPECT_EQ(tile.num_before, NumBlocks(old, tile.index));
        EXPECT_EQ(tile.num_after, NumBlocks(tiles[i].after, tile.index));
      }
      EXPECT_EQ(written, WrittenLayers(tiles[i].after != nullptr ? DiffSubmap(old, *tiles[i].after) : SubmapChange()));
    }
  }
  EXPECT_GT(num_clones, 5);
}

TEST(StoredKey, IsOfOneStoreAndOfOneState) {
  const StoredKey key;
  EXPECT_EQ(key.In(1), 0);
  key.Set(1, 77);
  EXPECT_EQ(key.In(1), 77);
  EXPECT_EQ(key.In(2), 0);
  EXPECT_EQ(StoredKey(key).In(1), 0) << "a copy is made to be written to";
  key.Set(65535, (std::int64_t{1} << 48) - 1);
  EXPECT_EQ(key.In(65535), (std::int64_t{1} << 48) - 1);
  EXPECT_EQ(key.In(1), 0);
  for (const std::int64_t bad : {std::int64_t{1} << 48, std::int64_t{0}, std::int64_t{-1}}) {
    key.Set(3, bad);
    EXPECT_EQ(key.In(3), 0) << "not certain to be told apart";
  }
}

TEST(StateMarks, ShareWhatIsTheSameWithThoseOfTheStateBefore) {
  Map map = RowOfBlocks(9);  // in three tiles
  map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04}).MutableTsdf({0, 0, 0});
  const StateMarks first(*map.Publish(0));
  map.FindMutable(kThing)->MutableTsdf({5, 0, 0});
  const StateMarks second(*map.Publish(1), &first);
  EXPECT_EQ(second.Find(SubmapId(2)), first.Find(SubmapId(2)));
  const auto tile = [](const StateMarks& marks, int x) { return marks.Find(kThing)->FindTile({x, 0, 0}); };
  EXPECT_EQ(tile(second, 0), tile(first, 0));
  EXPECT_NE(tile(second, 1), tile(first, 1));
  EXPECT_EQ(tile(second, 2), tile(first, 2));
  for (int x = 0; x < 9; ++x) EXPECT_TRUE(Has(second, map, x));
}

TEST(StateMarks, OfNothingSayThatAllWasWrittenSince) {
  Map map = RowOfBlocks(3);
  const auto state = map.Publish(0);
  EXPECT_EQ(TextOf(DiffSnapshots(StateMarks(), *state)), TextOf(DiffSnapshots(nullptr, *state)));
}

TEST(StateMarks, KeepNoVoxels) {
  constexpr int kBlocks = 1000;
  Map map = RowOfBlocks(kBlocks);
  const StateMarks marks(*map.Publish(0));
  const std::size_t with_blocks = BytesInUse();
  map.Remove(kThing);
  map.Publish(1);
  EXPECT_LT(BytesInUse() + kBlocks * (sizeof(TsdfBlock) + sizeof(LabelBlock)) * 9 / 10, with_blocks);
}

}  // namespace
}  // namespace dhpmap
