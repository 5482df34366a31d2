// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/vacated_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::Solid;

constexpr double kVoxel_m = 0.05, kTruncation_m = 0.15;

/// And stamps.
bool HasSameVoxels(const FreeSpace& a, const FreeSpace& b) {
  return a.tiles().size() == b.tiles().size() && std::ranges::all_of(a.tiles(), [&b](const FreeTileEntry& entry) {
           const FreeTile* other = b.Find(entry.index);
           return other != nullptr && *other == *entry.tile;
         });
}

/// A map of boxes, each a submap, observed wherever somebody says so.
class VacatedSpaceTest : public ::testing::Test {
 protected:
  using Condition = std::function<bool(const Eigen::Vector3d&)>;

  VacatedSpaceTest() : map(InfoOfMap()) {}

  static MapInfo InfoOfMap() {
    MapInfo info;
    info.name = "m";
    info.config.voxel_size_m = kVoxel_m;
    info.config.truncation_m = kTruncation_m;
    return info;
  }
  static Solid Box(const Eigen::Vector3d& center_m, const Eigen::Vector3d& half_m) {
    return {.shape = Solid::Shape::kBox, .center_m = center_m, .size_m = half_m};
  }
  /// Calls visit(voxel, centre) all over the scene.
  template <typename Visitor>
  static void ForEachVoxel(Visitor&& visit) {
    for (int z = -24; z < 24; ++z) {
      for (int y = -24; y < 24; ++y) {
        for (int x = -24; x < 24; ++x) visit(VoxelIndex{x, y, z}, VoxelCentre({x, y, z}, kVoxel_m));
      }
    }
  }
  SubmapId Observe(const Solid& solid, Panoptic panoptic, const Condition& is_seen) {
    Submap& submap = map.Create({.panoptic = panoptic, .voxel_size_m = kVoxel_m, .truncation_m = kTruncation_m});
    ForEachVoxel([&](VoxelIndex voxel, const Eigen::Vector3d& centre) {
      const double distance_m = solid.Distance(centre);
      if (std::abs(distance_m) > kTruncation_m || !is_seen(centre)) return;
      TsdfBlock& block = submap.MutableTsdf(BlockOf(voxel));
      block.distance_m[static_cast<std::size_t>(LinearIndex(voxel))] = static_cast<float>(distance_m);
      block.weight[static_cast<std::size_t>(LinearIndex(voxel))] = 1;
    });
    submap.UpdateBoundingSphere();
    return submap.id();
  }
  void LookThrough(const Condition& is_free) {
    ForEachVoxel([&](VoxelIndex voxel, const Eigen::Vector3d& centre) {
      if (!is_free(centre)) return;
      FreeBlocks seen;
      const int cell = CellOf(BlockOf(voxel)), i = LinearIndex(voxel);
      seen.mixed = std::uint64_t{1} << cell;
      seen.masks[static_cast<std::size_t>(cell)][static_cast<std::size_t>(i >> 6)] = std::uint64_t{1} << (i & 63);
      map.mutable_free_space().Add(TileOf(BlockOf(voxel)), seen, 7);
    });
  }
  void Leave(SubmapId id) { NoteVacated(*map.Find(id), map); }
  void ExpectVacated(const Condition& expected) {
    int num = 0, num_wrong = 0;
    ForEachVoxel([&](VoxelIndex voxel, const Eigen::Vector3d& centre) {
      num += expected(centre);
      num_wrong += map.vacated().IsFree(voxel) != expected(centre);
    });
    EXPECT_EQ(num_wrong, 0) << "of " << num;
    EXPECT_EQ(map.vacated().NumFreeVoxels(), num);
  }

  static bool Everywhere(const Eigen::Vector3d&) { return true; }

  const Solid box = Box({0.01, 0.02, 0.03}, {0.6, 0.5, 0.4});
  Map map;
};

TEST_F(VacatedSpaceTest, AThingLeavesWhatItShowedAndItsInside) {
  const SubmapId id = Observe(box, Panoptic::kThing, Everywhere);
  Leave(id);
  ExpectVacated([&](const Eigen::Vector3d& p) { return box.Distance(p) <= kTruncation_m; });
  Leave(id);  // once more changes nothing
  ExpectVacated([&](const Eigen::Vector3d& p) { return box.Distance(p) <= kTruncation_m; });
}

TEST_F(VacatedSpaceTest, OfAThingSeenFromOneSideTheRestOfItsBoxGoesWithIt) {
  const auto is_above = [](const Eigen::Vector3d& p) { return p.z() > 0.2; };
  Leave(Observe(box, Panoptic::kThing, is_above));
  // From its top on down to the lowest voxel of its surface: behind that nobody has seen anything.
  ExpectVacated([&](const Eigen::Vector3d& p) { return is_above(p) && box.Distance(p) <= kTruncation_m; });
}

TEST_F(VacatedSpaceTest, WhatWasLookedThroughOrIsShownByAnotherIsNotLeft) {
  const Solid other = Box({0.6, 0.02, 0.03}, {0.3, 0.2, 0.2});
  const auto is_free = [](const Eigen::Vector3d& p) { return p.y() > 0.3; };
  LookThrough(is_free);
  Observe(other, Panoptic::kThing, Everywhere);
  Leave(Observe(box, Panoptic::kThing, Everywhere));
  ExpectVacated([&](const Eigen::Vector3d& p) {
    const double to_other_m = other.Distance(p);
    if (is_free(p) || std::abs(to_other_m) <= kTruncation_m) return false;
    // The inside of the other cannot be reached but through what it shows.
    return box.Distance(p) <= kTruncation_m && (to_other_m > 0 || box.Distance(p) >= -kTruncation_m);
  });
}

TEST_F(VacatedSpaceTest, AThingTooLargeForAnInsideLeavesNoMoreThanItShowed) {
  const auto is_free = [](const Eigen::Vector3d& p) { return p.y() > 0.3; };
  LookThrough(is_free);
  const SubmapId id = Observe(box, Panoptic::kThing, Everywhere);
  TsdfBlock& far = map.FindMutable(id)->MutableTsdf({60, 60, 60});
  far.weight[7] = 1;
  far.distance_m[7] = -0.01f;
  map.FindMutable(id)->UpdateBoundingSphere();
  Leave(id);
  int num = 0, num_wrong = 0;
  ForEachVoxel([&](VoxelIndex voxel, const Eigen::Vector3d& p) {
    const bool is_left = std::abs(box.Distance(p)) <= kTruncation_m && !is_free(p);
    num += is_left;
    num_wrong += map.vacated().IsFree(voxel) != is_left;
  });
  EXPECT_EQ(num_wrong, 0) << "of " << num;
  EXPECT_TRUE(map.vacated().IsFree(VoxelIn({60, 60, 60}, 7)));
  EXPECT_EQ(map.vacated().NumFreeVoxels(), num + 1);
}

TEST_F(VacatedSpaceTest, StuffLeavesNoMoreThanItShowed) {
  Leave(Observe(box, Panoptic::kStuff, Everywhere));
  ExpectVacated([&](const Eigen::Vector3d& p) { return std::abs(box.Distance(p)) <= kTruncation_m; });
}

TEST_F(VacatedSpaceTest, WhatSomebodyHasPutThereLeavesNothing) {
  const SubmapId id = Observe(box, Panoptic::kThing, Everywhere);
  map.FindMutable(id)->mutable_info().is_placed = true;
  Leave(id);
  EXPECT_TRUE(map.vacated().empty());
  map.FindMutable(id)->mutable_info().is_placed = false;
  map.FindMutable(id)->mutable_info().T_map_submap.translation().x() = 1;
  Leave(id);
  EXPECT_TRUE(map.vacated().empty()) << "its voxels are not the map's";
  Leave(kUnknownSubmap);
  EXPECT_TRUE(map.vacated().empty());
}

TEST_F(VacatedSpaceTest, WhatIsWorkedOutAfterAMoveIsWhatWouldHaveBeenNotedBeforeIt) {
  LookThrough([](const Eigen::Vector3d& p) { return p.y() > 0.3; });
  const SubmapId other = Observe(Box({0.6, 0.02, 0.03}, {0.3, 0.2, 0.2}), Panoptic::kThing, Everywhere);
  const SubmapId id = Observe(box, Panoptic::kThing, Everywhere);
  Leave(other);  // there is something already
  map.Publish(1);
  Map noted = map.Fork();
  NoteVacated(*noted.Find(id), noted);
  const auto expected = noted.Publish(2)->vacated();

  const auto move = [id](Map& moved) {
    moved.FindMutable(id)->mutable_info().T_map_submap.translation().x() = 2;
    moved.FindMutable(id)->mutable_info().is_placed = true;
    moved.NoteLeaving(id);
  };
  Map settled = map.Fork();
  move(settled);
  settled.SettleVacated();  // as before a further edit of the same revision
  settled.Remove(other);
  EXPECT_TRUE(HasSameVoxels(settled.vacated(), *expected));

  move(map);
  const auto moved = map.Publish(2);
  EXPECT_EQ(moved->leaving(), id);
  EXPECT_LT(moved->noted_vacated()->NumFreeVoxels(), expected->NumFreeVoxels());
  // Whatever comes later, whoever asks first.
  map.Remove(other);
  LookThrough(Everywhere);
  const auto later = map.Publish(3);
  EXPECT_FALSE(later->leaving());
  EXPECT_TRUE(HasSameVoxels(*later->vacated(), *expected));
  EXPECT_TRUE(HasSameVoxels(*moved->vacated(), *expected));
  EXPECT_EQ(later->vacated(), moved->vacated()) << "it was worked out once";
}

TEST_F(VacatedSpaceTest, WhatWasNotedIsLeftAsItIsEvenWhereItWasRead) {
  const SubmapId first = Observe(box, Panoptic::kThing, Everywhere);
  Leave(first);
  const SubmapId id = Observe(Box({0.6, 0.02, 0.03}, {0.3, 0.2, 0.2}), Panoptic::kThing, Everywhere);
  map.Remove(first);
  const auto state = map.Publish(1);
  auto read = std::make_shared<FreeSpace>();  // as a store makes it
  for (const FreeTileEntry& entry : state->vacated()->tiles()) read->Put(entry.index, entry.tile);
  Map loaded(
      std::make_shared<const MapSnapshot>(state->info(), state->submaps(), state->free_space(), VacatedSpace{read}));
  const std::int64_t num_noted = read->NumFreeVoxels();
  loaded.FindMutable(id)->mutable_info().is_placed = true;
  loaded.NoteLeaving(id);
  const auto moved = loaded.Publish(2);
  EXPECT_GT(moved->vacated()->NumFreeVoxels(), num_noted);
  EXPECT_EQ(moved->noted_vacated()->NumFreeVoxels(), num_noted);
}

TEST_F(VacatedSpaceTest, OneWhoReadsAStateKnowsWhatWasLeftWhileOthersAsk) {
  const SubmapId id = Observe(box, Panoptic::kThing, Everywhere);
  map.FindMutable(id)->mutable_info().is_placed = true;
  map.NoteLeaving(id);
  const auto moved = map.Publish(1);
  std::vector<std::shared_ptr<const FreeSpace>> seen(4);
  {
    std::vector<std::jthread> readers;
    readers.reserve(seen.size());
    for (auto& layer : seen) readers.emplace_back([&layer, &moved] { layer = moved->vacated(); });
  }
  for (const auto& layer : seen) EXPECT_EQ(layer, seen.front());
  EXPECT_FALSE(seen.front()->empty());
}

TEST_F(VacatedSpaceTest, ItIsAsOldAsTheNewestLook) {
  LookThrough([](const Eigen::Vector3d& p) { return p.x() > 1; });
  Leave(Observe(box, Panoptic::kThing, Everywhere));
  ASSERT_FALSE(map.vacated().empty());
  for (const FreeTileEntry& entry : map.vacated().tiles()) EXPECT_EQ(entry.tile->last_seen_ns(), 7);
}

}  // namespace
}  // namespace dhpmap
