// SPDX-License-Identifier: BSD-3-Clause
// Blocks of maps are counted where they are allocated, once, however many states have them.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>

#include "mapping/base/free_memory.h"
#include "mapping/base/memory_count.h"
#include "mapping/changes/state_marks.h"
#include "mapping/map/map.h"

namespace dhpmap {
namespace {

constexpr SubmapId kFirst{1}, kSecond{2};

std::size_t CountedNow() { return CountOf(MemoryKind::kBlocks).now_bytes(); }

/// The slow way: the layers that are in any of the states, by their addresses.
template <typename... States>
std::size_t BytesOfLayers(const States&... states) {
  std::set<const void*> geometry;
  std::set<const LabelBlock*> labels;
  const auto add = [&](const auto& state) {
    for (const auto& submap : state.submaps()) {
      for (const BlockEntry& entry : submap->blocks().entries()) {
        if (entry.tsdf) geometry.insert(entry.tsdf.get());
        if (entry.labels) labels.insert(entry.labels.get());
      }
    }
  };
  (add(states), ...);
  std::size_t bytes = geometry.size() * HeapBytesFor(sizeof(TsdfBlock));
  for (const LabelBlock* block : labels) bytes += block->CountedBytes();
  return bytes;
}

void Write(Map& map, SubmapId id, int begin, int end) {
  for (int x = begin; x < end; ++x) {
    map.FindMutable(id)->MutableTsdf({x, 0, 0}).weight[0] += 1;
    if (x % 3 != 0) map.FindMutable(id)->MutableLabels({x, 0, 0}).AddObservation(0, ClassId(1));
  }
}

class CountedBlocks : public ::testing::Test {
 protected:
  CountedBlocks() {
    for (int i = 0; i < 2; ++i) map_.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
    Write(map_, kFirst, 0, 30);
    Write(map_, kSecond, -5, 5);
  }
  [[nodiscard]] std::size_t Counted() const { return CountedNow() - before_; }

  const std::size_t before_ = CountedNow();
  Map map_{MapInfo{.name = "m"}};
};

TEST_F(CountedBlocks, AreThoseOfTheMap) {
  EXPECT_EQ(Counted(), BytesOfLayers(map_));
  EXPECT_GE(Counted(), 40 * sizeof(TsdfBlock));
  std::size_t told = 0;
  for (const auto& submap : map_.submaps()) told += submap->MemoryBytes();
  EXPECT_NEAR(static_cast<double>(Counted()), static_cast<double>(told), 0.15 * static_cast<double>(told))
      << "what the map says of itself, with its tables";
}

TEST_F(CountedBlocks, AreCountedOnceWhateverStatesAndClonesShareThem) {
  const std::size_t written = Counted();
  const auto first = map_.Publish(0);
  map_.Clone(kFirst);
  const auto second = map_.Publish(0);
  const Map fork = map_.Fork();
  const StateMarks marks(*first);
  EXPECT_EQ(Counted(), written);
}

TEST_F(CountedBlocks, ThatOnlyAnOldStateOrTheWriterHasAreCountedUntilTheyLetGo) {
  auto old = map_.Publish(0);
  const StateMarks marks(*old);
  Write(map_, kFirst, 10, 20);
  EXPECT_EQ(Counted(), BytesOfLayers(map_, *old)) << "what nobody has published is the writer's";
  EXPECT_GT(Counted(), BytesOfLayers(map_));
  const auto now = map_.Publish(0);
  EXPECT_EQ(Counted(), BytesOfLayers(*now, *old));
  old = nullptr;
  EXPECT_EQ(Counted(), BytesOfLayers(*now)) << "marks keep none of it";
}

TEST_F(CountedBlocks, AreNoneWhenAllIsGone) {
  auto held = map_.Publish(0);
  Write(map_, kFirst, 10, 20);
  map_ = Map(MapInfo{.name = "m"});
  EXPECT_EQ(Counted(), BytesOfLayers(*held));
  held = nullptr;
  EXPECT_EQ(Counted(), 0u);
}

TEST_F(CountedBlocks, GoWithWhatAnErrorThrowsAway) {
  const std::size_t written = Counted();
  Map before = map_.Fork();
  Write(map_, kSecond, 0, 50);
  EXPECT_GT(Counted(), written);
  map_ = std::move(before);
  EXPECT_EQ(Counted(), written);
}

}  // namespace
}  // namespace dhpmap
