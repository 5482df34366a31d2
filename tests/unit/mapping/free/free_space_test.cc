// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/free/free_space.h"

#include <gtest/gtest.h>

#include <array>
#include <bitset>
#include <cstddef>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <utility>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// All free voxels, a bit each.
class NaiveSpace {
 public:
  void Insert(TileIndex tile, int cell, int linear) { tiles_[tile].set(BitOf(cell, linear)); }
  bool Erase(TileIndex tile) { return tiles_.erase(tile) > 0; }
  [[nodiscard]] bool Contains(VoxelIndex v) const {
    const auto tile = tiles_.find(TileOf(BlockOf(v)));
    return tile != tiles_.end() && tile->second.test(BitOf(CellOf(BlockOf(v)), LinearIndex(v)));
  }
  [[nodiscard]] std::size_t Count() const {
    std::size_t count = 0;
    for (const auto& [index, voxels] : tiles_) count += voxels.count();
    return count;
  }
  bool operator==(const NaiveSpace&) const = default;

 private:
  static std::size_t BitOf(int cell, int linear) { return static_cast<std::size_t>(cell * kBlockVoxels + linear); }

  std::map<TileIndex, std::bitset<std::size_t{kTileBlocks} * kBlockVoxels>> tiles_;  // none without a voxel
};

NaiveSpace ContentOf(const FreeSpace& space) {
  NaiveSpace content;
  for (const FreeTileEntry& entry : space.tiles()) {
    for (int cell = 0; cell < kTileBlocks; ++cell) {
      for (int linear = 0; linear < kBlockVoxels; ++linear) {
        if (entry.tile->IsFree(cell, linear)) content.Insert(entry.index, cell, linear);
      }
    }
  }
  return content;
}

/// Some whole blocks and some voxels of two others of a tile; every fourth has all voxels of one of them.
FreeBlocks RandomBlocks(std::mt19937& random) {
  FreeBlocks seen;
  seen.full = std::uint64_t{1} << random() % 64;
  for (int i = 0; i < 2; ++i) {
    const std::size_t cell = random() % 64;
    if ((seen.full >> cell & 1u) != 0) continue;
    seen.mixed |= std::uint64_t{1} << cell;
    seen.masks[cell].fill(random() % 4 == 0 ? ~std::uint64_t{0} : std::uint64_t{random()} << random() % 32);
  }
  return seen;
}

void AddTo(NaiveSpace& naive, TileIndex index, const FreeBlocks& seen) {
  for (int cell = 0; cell < kTileBlocks; ++cell) {
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      const auto c = static_cast<std::size_t>(cell), word = static_cast<std::size_t>(linear / 64);
      const bool is_free = (seen.full >> c & 1u) != 0 ||
                           ((seen.mixed >> c & 1u) != 0 && (seen.masks[c][word] >> (linear % 64) & 1u) != 0);
      if (is_free) naive.Insert(index, cell, linear);
    }
  }
}

TEST(FreeSpace, AgreesWithASetOfVoxelsAndSoDoItsCopies) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uint64_t generation = 1;
    FreeSpace space(generation);
    NaiveSpace naive;
    std::vector<std::pair<FreeSpace, NaiveSpace>> copies;
    for (int step = 0; step < 120; ++step) {
      const TileIndex index{static_cast<std::int32_t>(random() % 3) - 1, static_cast<std::int32_t>(random() % 2) - 1,
                            0};
      if (random() % 20 == 0) {
        EXPECT_EQ(space.Erase(index), naive.Erase(index));
      } else {
        const FreeBlocks seen = RandomBlocks(random);
        space.Add(index, seen, 0);
        AddTo(naive, index, seen);
      }
      if (step % 15 == 0) {
        copies.emplace_back(space, naive);
        space.set_generation(++generation);
      }
    }
    EXPECT_EQ(ContentOf(space), naive);
    EXPECT_EQ(space.NumFreeVoxels(), static_cast<std::int64_t>(naive.Count()));
    for (int i = 0; i < 5000; ++i) {
      const VoxelIndex v{static_cast<std::int32_t>(random() % 120) - 60, static_cast<std::int32_t>(random() % 120) - 60,
                         static_cast<std::int32_t>(random() % 40)};
      EXPECT_EQ(space.IsFree(v), naive.Contains(v));
    }
    for (const auto& [copy, content] : copies) EXPECT_EQ(ContentOf(copy), content) << "a copy must not change";
  }
}

TEST(FreeSpace, TheSameVoxelsHaveTheSameFormWhateverTheWayThere) {
  FreeTile at_once, step_by_step;
  FreeBlocks block, upper, lower;
  block.full = 1u << 5;
  at_once.Add(block);
  upper.mixed = lower.mixed = 1u << 5 | 1u << 9;
  for (std::size_t z = 0; z < 8; ++z) {
    upper.masks[5][z] = z < 3 ? ~std::uint64_t{0} : 0x1234;
    lower.masks[5][z] = z < 3 ? 0 : ~std::uint64_t{0};
    upper.masks[9][z] = lower.masks[9][z] = 0;  // nothing of this block
  }
  step_by_step.Add(upper);
  EXPECT_FALSE(step_by_step.Holds(lower));
  step_by_step.Add(lower);
  EXPECT_EQ(step_by_step, at_once);
  EXPECT_TRUE(step_by_step.Holds(upper));
  EXPECT_TRUE(step_by_step.masks().empty());
  EXPECT_EQ(step_by_step.NumFreeVoxels(), kBlockVoxels);
}

TEST(FreeSpace, WhatIsTakenOutIsGoneWhateverWasThere) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const auto draw = [&random] {
      FreeBlocks blocks;
      for (std::size_t cell = 0; cell < 8; ++cell) {
        const std::uint64_t bit = std::uint64_t{1} << cell;
        const auto kind = random() % 3;
        if (kind == 1) blocks.full |= bit;
        if (kind != 2) continue;
        blocks.mixed |= bit;
        for (std::uint64_t& word : blocks.masks[cell]) {
          word = random() % 3 == 0 ? ~std::uint64_t{0} : std::uint64_t{random()} << 32 | random();
        }
      }
      return blocks;
    };
    FreeTile tile, gone;
    tile.Add(draw());
    const FreeBlocks taken = draw();
    gone.Add(taken);
    FreeTile rest = tile, twice = tile;
    rest.Remove(taken);
    for (int cell = 0; cell < 9; ++cell) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        ASSERT_EQ(rest.IsFree(cell, i), tile.IsFree(cell, i) && !gone.IsFree(cell, i));
      }
    }
    twice.Remove(taken);
    twice.Remove(taken);
    EXPECT_EQ(twice, rest);
  }
}

TEST(FreeSpace, HoldsNoTileInWhichNothingIsFree) {
  FreeSpace space(1);
  EXPECT_FALSE(space.Add({0, 0, 0}, {}, 5));
  FreeBlocks nothing;
  nothing.mixed = 1;  // with a mask of zeros
  EXPECT_FALSE(space.Add({0, 0, 0}, nothing, 5));
  EXPECT_TRUE(space.empty());
}

TEST(FreeSpace, RenewsAStampAtMostOnceASecondAndNeverTurnsItBack) {
  FreeSpace space(1);
  FreeBlocks seen;
  seen.full = 1;
  EXPECT_TRUE(space.Add({0, 0, 0}, seen, 10 * kSecond_ns));
  EXPECT_FALSE(space.Add({0, 0, 0}, seen, 11 * kSecond_ns - 1));
  EXPECT_FALSE(space.Add({0, 0, 0}, seen, 3 * kSecond_ns)) << "an older frame";
  EXPECT_EQ(space.Find({0, 0, 0})->last_seen_ns(), 10 * kSecond_ns);
  EXPECT_TRUE(space.Add({0, 0, 0}, seen, 11 * kSecond_ns));
  EXPECT_EQ(space.Find({0, 0, 0})->last_seen_ns(), 11 * kSecond_ns);
  seen.full = 2;
  EXPECT_TRUE(space.Add({0, 0, 0}, seen, 3 * kSecond_ns)) << "it sees something new all the same";
  EXPECT_EQ(space.Find({0, 0, 0})->last_seen_ns(), 11 * kSecond_ns);
  constexpr std::int64_t kEarliest = std::numeric_limits<std::int64_t>::min(), kLatest = -(kEarliest + 1);
  EXPECT_TRUE(space.Add({1, 0, 0}, seen, kEarliest));
  EXPECT_TRUE(space.Add({1, 0, 0}, seen, kLatest)) << "a difference that does not fit";
  EXPECT_FALSE(space.Add({1, 0, 0}, seen, kEarliest));
}

TEST(FreeSpace, TakesABitForAWholeBlockAndCopiesOnlyTheTilesItWrites) {
  FreeSpace space(1);
  FreeBlocks all;
  all.full = ~std::uint64_t{0};
  for (std::int32_t x = 0; x < 100; ++x) space.Add({x, 0, 0}, all, 0);
  EXPECT_LT(space.MemoryBytes(), 100u * 256u);  // 25 KB for 3.3 million voxels
  const FreeSpace before = space;
  space.set_generation(2);
  all.full = 1;
  space.Add({3, 0, 0}, all, 2 * kSecond_ns);
  EXPECT_NE(before.Find({3, 0, 0}), space.Find({3, 0, 0}));
  EXPECT_EQ(before.Find({4, 0, 0}), space.Find({4, 0, 0}));
}

TEST(DiffFreeSpace, NamesTheTilesThatAreNotTheSame) {
  FreeSpace space(1);
  FreeBlocks seen;
  seen.full = 1;
  for (std::int32_t x = 0; x < 4; ++x) space.Add({x, 0, 0}, seen, 0);
  EXPECT_EQ(DiffFreeSpace(nullptr, space).written.size(), 4u);
  const FreeSpace before = space;
  EXPECT_TRUE(DiffFreeSpace(&before, space).empty());
  space.set_generation(2);
  space.Erase({0, 0, 0});
  seen.full = 6;
  space.Add({2, 0, 0}, seen, 0);
  space.Add({9, 0, 0}, seen, 0);
  const FreeSpaceChange change = DiffFreeSpace(&before, space);
  std::set<TileIndex> written;
  for (const FreeTileEntry* entry : change.written) written.insert(entry->index);
  EXPECT_EQ(written, (std::set<TileIndex>{{2, 0, 0}, {9, 0, 0}}));
  EXPECT_EQ(change.erased, (std::vector<TileIndex>{{0, 0, 0}}));
}

// The layers of a map are copied on write, go back with a fork, and make a revision when they change.

/// One of them, by its ways in.
struct Layer {
  FreeSpace& (*of_writer)(Map&);
  const FreeSpace& (*of_state)(const MapSnapshot&);
};

void ExpectGoesWithStates(const Layer& layer) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    MapInfo info;
    info.name = "m";
    Map map(info);
    std::vector<std::pair<std::shared_ptr<const MapSnapshot>, NaiveSpace>> history;
    for (int step = 0; step < 100; ++step) {
      const NaiveSpace now = ContentOf(layer.of_state(*map.Freeze()));
      switch (random() % 5) {
        case 0: history.emplace_back(map.Publish(step), now); break;
        case 1: history.emplace_back(map.Freeze(), now); break;
        case 2: {
          Map before = map.Fork();
          layer.of_writer(map).Add({0, 0, 0}, RandomBlocks(random), step);
          EXPECT_EQ(ContentOf(layer.of_state(*before.Freeze())), now);
          if (random() % 2 == 0) {
            layer.of_writer(before).Add({1, 0, 0}, RandomBlocks(random), step);
            history.emplace_back(map.Freeze(), ContentOf(layer.of_state(*map.Freeze())));
            map = std::move(before);
          }
          break;
        }
        case 3: {
          const auto snapshot = map.Publish(step);
          history.emplace_back(snapshot, now);
          map = Map(snapshot);  // as after a restart
          break;
        }
        default: layer.of_writer(map).Add({static_cast<std::int32_t>(random() % 2), 0, 0}, RandomBlocks(random), step);
      }
    }
    for (const auto& [snapshot, content] : history) EXPECT_EQ(ContentOf(layer.of_state(*snapshot)), content);
  }
}

TEST(MapFreeSpace, GoesWithSnapshotsForksAndFrozenStatesAndNoneOfThemChanges) {
  ExpectGoesWithStates({[](Map& map) -> FreeSpace& { return map.mutable_free_space(); },
                        [](const MapSnapshot& state) -> const FreeSpace& { return *state.free_space(); }});
}

TEST(MapVacated, GoesWithSnapshotsForksAndFrozenStatesAndNoneOfThemChanges) {
  ExpectGoesWithStates({[](Map& map) -> FreeSpace& { return map.mutable_vacated(); },
                        [](const MapSnapshot& state) -> const FreeSpace& { return *state.vacated(); }});
}

TEST(MapFreeSpace, OfANewMapIsCopiedBeforeItIsWrittenToWhateverWasInItsMemory) {
  // As if its memory held the generation that comes after the first Publish.
  alignas(Map) std::array<std::byte, sizeof(Map)> memory;
  for (std::size_t at = 0; at < memory.size(); ++at) {
    *static_cast<volatile std::byte*>(&memory[at]) = static_cast<std::byte>(at % sizeof(std::uint64_t) == 0 ? 2 : 0);
  }
  Map* map = new (memory.data()) Map(MapInfo{});
  const auto first = map->Publish(1);
  FreeBlocks seen;
  seen.full = 1;
  map->mutable_free_space().Add({0, 0, 0}, seen, 0);
  map->mutable_vacated().Add({0, 0, 0}, seen, 0);
  EXPECT_TRUE(first->free_space()->empty());
  EXPECT_TRUE(first->vacated()->empty());
  map->~Map();
}

TEST(MapFreeSpace, ARevisionIsMadeOfWhatIsWritten) {
  Map map(MapInfo{});
  const auto first = map.Publish(1);
  EXPECT_TRUE(first->free_space()->empty());
  FreeBlocks seen;
  seen.full = 1;
  map.mutable_free_space().Add({0, 0, 0}, seen, 0);
  const auto second = map.Publish(2);
  EXPECT_EQ(second->revision(), first->revision() + 1);
  EXPECT_TRUE(second->free_space()->IsFree({0, 0, 0}));
  EXPECT_FALSE(first->free_space()->IsFree({0, 0, 0}));
  map.mutable_info().display_name = "x";
  EXPECT_EQ(map.Publish(3)->free_space(), second->free_space()) << "what nobody wrote is shared";
}

}  // namespace
}  // namespace dhpmap
