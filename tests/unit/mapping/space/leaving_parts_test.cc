// SPDX-License-Identifier: BSD-3-Clause
// Of a thing that was moved, the part at its old place leaves as a whole.
#include "mapping/space/leaving_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "mapping/space/presence.h"
#include "tests/support/map_infos.h"

namespace dhpmap {
namespace {

constexpr BlockIndex kHere{0, 0, 0}, kBesideHere{1, 1, 1}, kThere{3, 0, 0};

class LeavingParts : public ::testing::Test {
 protected:
  LeavingParts() : map_(testing::NamedMap("room", 1, 1)) {
    id_ = map_.Create(testing::SettledThingOn(map_, ClassId(1))).id();
  }
  Submap& thing() { return *map_.FindMutable(id_); }

  /// So many voxels of surface in a block, of which the first `num_doubted` were looked through so often.
  void AddSurface(BlockIndex block, int num_voxels, int num_doubted, int times = 2) {
    TsdfBlock& tsdf = thing().MutableTsdf(block);
    VoxelMask doubted{};
    for (int i = 0; i < num_voxels; ++i) {
      tsdf.weight[static_cast<std::size_t>(i)] = 1;
      if (i < num_doubted) doubted[static_cast<std::size_t>(i >> 6)] |= std::uint64_t{1} << (i & 63);
    }
    for (int k = 0; k < times && num_doubted > 0; ++k) thing().MutableGone(block).Raise(doubted, {});
  }
  [[nodiscard]] int NumShown(BlockIndex block) {
    const BlockEntry& entry = *thing().blocks().Find(block);
    int num = 0;
    for (int i = 0; i < kBlockVoxels; ++i) num += entry.Shows(i);
    return num;
  }

  Map map_;
  SubmapId id_;
};

TEST_F(LeavingParts, BlocksThatTouchEvenAtACornerAreOnePart) {
  AddSurface(kHere, 10, 4);
  AddSurface(kBesideHere, 20, 3);
  AddSurface(kThere, 30, 0);
  const auto parts = FindSurfaceParts(thing());
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].blocks, (std::vector<BlockIndex>{kHere, kBesideHere}));
  EXPECT_EQ(std::pair(parts[0].num_voxels, parts[0].num_doubted), std::pair(std::int64_t{30}, std::int64_t{7}));
  EXPECT_EQ(parts[1].blocks, std::vector<BlockIndex>{kThere});
  EXPECT_EQ(std::pair(parts[1].num_voxels, parts[1].num_doubted), std::pair(std::int64_t{30}, std::int64_t{0}));
}

TEST_F(LeavingParts, WhatWasMovedLeavesAllOfItsOldPlaceAndIsPresentAtTheNew) {
  // Three quarters of all of it are at the old place, of which no sensor looked at the far end.
  AddSurface(kHere, 100, 90);
  AddSurface(kBesideHere, 50, 0);
  AddSurface(kThere, 50, 0);
  UpdatePresenceOfAll(map_);
  EXPECT_FALSE(thing().IsAbsent());
  EXPECT_EQ(NumShown(kHere), 0);
  EXPECT_EQ(NumShown(kBesideHere), 0);
  EXPECT_EQ(NumShown(kThere), 50);
  UpdatePresenceOfAll(map_);  // what has left counts no longer
  EXPECT_FALSE(thing().IsAbsent());
  EXPECT_EQ(NumShown(kThere), 50);
}

TEST_F(LeavingParts, APartOfWhichLittleOrOnlyOnceWasLookedThroughStays) {
  AddSurface(kHere, 100, 40);
  AddSurface(kThere, 100, 0);
  UpdatePresenceOfAll(map_);
  EXPECT_EQ(NumShown(kHere), 100);
  AddSurface({6, 0, 0}, 100, 100, 1);
  UpdatePresenceOfAll(map_);
  EXPECT_EQ(NumShown({6, 0, 0}), 100);
}

TEST_F(LeavingParts, AThingInOnePieceLosesNothingButWhatWasContradicted) {
  thing().mutable_info().last_observed_ns = 1;  // after it was looked through
  AddSurface(kHere, 100, 50);
  UpdatePresenceOfAll(map_);
  EXPECT_FALSE(thing().IsAbsent());
  EXPECT_EQ(NumShown(kHere), 100);
}

TEST_F(LeavingParts, AThingOfWhichAllPartsLeaveIsAbsentAndKept) {
  AddSurface(kHere, 100, 90, 3);
  AddSurface(kThere, 100, 90, 3);
  UpdatePresenceOfAll(map_);
  EXPECT_TRUE(thing().IsAbsent());
  EXPECT_EQ(NumShown(kHere), 10);
}

}  // namespace
}  // namespace dhpmap
