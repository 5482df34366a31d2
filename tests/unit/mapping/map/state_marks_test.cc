// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/state_marks.h"

#include <gtest/gtest.h>
#include <malloc.h>
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#include <sanitizer/allocator_interface.h>
#endif

namespace dhpmap {
namespace {

constexpr SubmapId kThing{1};

MapInfo Info() {
  MapInfo info;
  info.name = "m";
  return info;
}

/// `num_blocks` in a row, with all layers.
Map RowOfBlocks(int num_blocks) {
  Map map(Info());
  Submap& submap = map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.04});
  for (int x = 0; x < num_blocks; ++x) {
    submap.MutableTsdf({x, 0, 0}).weight[0] = 1;
    submap.MutableLabels({x, 0, 0}).AddObservation(0, ClassId(1));
  }
  return map;
}

/// Of memory that was asked for and not given back.
std::size_t BytesInUse() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
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
