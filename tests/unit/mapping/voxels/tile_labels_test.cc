// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tile_labels.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {
namespace {

BlockIndex SomeBlock(std::mt19937& random) {
  return {static_cast<std::int32_t>(random() % 10), static_cast<std::int32_t>(random() % 3), 0};
}

/// Something that changes what is seen, or where: a sighting, one of another, a conclusion, a voxel or block less.
void ChangeSomething(Submap& thing, std::mt19937& random) {
  const BlockIndex index = SomeBlock(random);
  const int linear = static_cast<int>(random() % kBlockVoxels);
  switch (random() % 8) {
    case 0: thing.EraseBlock(index); return;
    case 1: thing.MutableLabels(index).Clear(linear); return;
    case 2: thing.MutableLabels(index).SetConcluded(linear, random() % 2 == 0); return;
    case 3:
      thing.MutableLabels(index).Add(linear, {.classes = {{3, 1}}, .instances = {{SeenInstance(SubmapId(7)), 1}}});
      return;
    case 4: thing.PutBlock(index, nullptr, std::make_shared<const LabelBlock>()); return;
    default: thing.MutableLabels(index).AddObservation(linear, ClassId(static_cast<std::uint16_t>(random() % 5)));
  }
}

LabelTotals CountAnew(const Submap& thing) {
  LabelTotals totals;
  for (const BlockEntry& block : thing.blocks().entries()) {
    if (block.labels) block.labels->AddTo(totals);
  }
  while (!totals.classes.empty() && totals.classes.back() == 0) totals.classes.pop_back();
  return totals;
}

LabelTotals Kept(const Submap& thing) {
  LabelTotals totals;
  for (const TileEntry& tile : thing.blocks().tiles()) tile.tile->AddLabelsTo(totals);
  return totals;
}

void ExpectCountedRight(const Submap& thing) {
  const LabelTotals anew = CountAnew(thing), kept = Kept(thing);
  EXPECT_EQ(kept.classes, anew.classes);
  EXPECT_EQ(kept.own, anew.own);
  EXPECT_EQ(kept.instances, anew.instances);
}

TEST(TileLabels, AreThoseOfTheBlocksWhateverIsWrittenInBetweenAndInEachState) {
  std::mt19937 random(12);
  Map map{MapInfo{.name = "m"}};
  map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
  std::vector<std::shared_ptr<const MapSnapshot>> states;
  for (int n = 0; n < 3000; ++n) {
    ChangeSomething(*map.FindMutable(SubmapId(1)), random);
    if (random() % 4 == 0) ExpectCountedRight(*map.Find(SubmapId(1)));
    if (random() % 40 == 0) states.push_back(map.Publish(n));
    if (random() % 40 == 0) states.push_back(map.Freeze());
    if (!states.empty() && random() % 10 == 0) ExpectCountedRight(*states[random() % states.size()]->Find(SubmapId(1)));
    if (HasFailure()) FAIL() << "after change " << n;
  }
}

TEST(TileLabels, AreTheSameForAllWhoAskAtOnce) {
  std::mt19937 random(5);
  Map map{MapInfo{.name = "m"}};
  map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
  for (int n = 0; n < 2000; ++n) ChangeSomething(*map.FindMutable(SubmapId(1)), random);
  const auto state = map.Publish(1);
  const BlockTile& tile = *state->Find(SubmapId(1))->blocks().tiles().front().tile;
  std::vector<LabelTotals> found(4);
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (LabelTotals& one : found) threads.emplace_back([&one, &tile] { tile.AddLabelsTo(one); });
  for (std::thread& thread : threads) thread.join();
  const TileLabels expected = LabelsOf(tile.entries());
  EXPECT_GT(expected.instances, 0u);
  for (const LabelTotals& one : found) {
    EXPECT_EQ(one.own, expected.own);
    EXPECT_EQ(one.instances, expected.instances);
    for (const auto& [id, count] : expected.classes) EXPECT_EQ(one.classes.at(id), count);
    EXPECT_EQ(one.seen.size(), expected.classes.size());
  }
}

}  // namespace
}  // namespace dhpmap
