// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/occupancy_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kSceneVoxel_m;

/// Marks the voxels whose centres `is_free` as looked through.
void LookThrough(Map& map, const Eigen::AlignedBox3d& box, const std::function<bool(const Eigen::Vector3d&)>& is_free) {
  std::map<TileIndex, FreeBlocks> tiles;
  const VoxelIndex low = VoxelAt(box.min(), kSceneVoxel_m), high = VoxelAt(box.max(), kSceneVoxel_m);
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const VoxelIndex voxel{x, y, z};
        if (!is_free(VoxelCentre(voxel, kSceneVoxel_m))) continue;
        const int cell = CellOf(BlockOf(voxel)), linear = LinearIndex(voxel);
        FreeBlocks& seen = tiles[TileOf(BlockOf(voxel))];
        seen.mixed |= std::uint64_t{1} << cell;
        seen.masks[static_cast<std::size_t>(cell)][static_cast<std::size_t>(linear >> 6)] |= std::uint64_t{1}
                                                                                             << (linear & 63);
      }
    }
  }
  for (const auto& [index, seen] : tiles) map.mutable_free_space().Add(index, seen, 0);
}

struct ToldOfPlace {
  VoxelState state = VoxelState::kUnknown;
  std::vector<SubmapId> submaps;  ///< that have a surface there
};

/// What is known of the voxel that holds a point, by its definition: every submap is asked.
ToldOfPlace Look(const MapSnapshot& map, const Eigen::Vector3d& p_map, const QueryScope& scope) {
  const Eigen::Vector3d centre = VoxelCentre(VoxelAt(p_map, kSceneVoxel_m), kSceneVoxel_m);
  const bool is_seen_through = map.free_space()->IsFree(VoxelAt(p_map, kSceneVoxel_m));
  const bool is_left = scope.vacated_is_free && map.vacated()->IsFree(VoxelAt(p_map, kSceneVoxel_m));
  bool is_in_front = false;
  ToldOfPlace told;
  for (const auto& submap : map.submaps()) {
    if (!scope.Holds(submap->info())) continue;
    const VoxelIndex voxel = VoxelAt(submap->info().T_map_submap.inverse() * centre, kSceneVoxel_m);
    const BlockEntry* block = submap->blocks().Find(BlockOf(voxel));
    if (block == nullptr || block->tsdf == nullptr || !block->tsdf->IsObserved(LinearIndex(voxel))) continue;
    const double distance_vox = block->tsdf->distance_m[static_cast<std::size_t>(LinearIndex(voxel))] / kSceneVoxel_m;
    if (distance_vox > 0.5005) is_in_front = true;
    else if (distance_vox >= -0.5005 || !is_seen_through) told.submaps.push_back(submap->id());
  }
  if (!told.submaps.empty()) told.state = VoxelState::kOccupied;
  else if (is_in_front || is_seen_through || is_left) told.state = VoxelState::kFree;
  return told;
}

struct Whole {
  std::vector<std::int8_t> cells;
  std::vector<const SubmapInfo*> objects;
  std::shared_ptr<const MapSurfaces> surfaces;
};

Whole SliceOf(Map& map, const SliceOptions& options) {
  SurfaceCache cache(std::size_t{1} << 30);
  Whole whole{.cells = {}, .objects = {}, .surfaces = cache.Of(map.Publish(0))};
  OccupancySlice slice(whole.surfaces, options);
  std::vector<std::int8_t> row(static_cast<std::size_t>(options.width));
  std::vector<const SubmapInfo*> objects(options.with_objects ? row.size() : 0);
  for (int y = 0; y < options.height; ++y) {
    slice.Row(y, row, objects);
    whole.cells.insert(whole.cells.end(), row.begin(), row.end());
    whole.objects.insert(whole.objects.end(), objects.begin(), objects.end());
  }
  return whole;
}

Map RoomSeenThrough() {
  Map map = testing::FurnishedRoom();
  LookThrough(map, testing::CubeAt({0, 0, 0}, 1.5), [](const Eigen::Vector3d& p) {
    return testing::Room({0, 0, 0}, {1.4, 1.4, 1.4})(p) > 0 && testing::Ball({0.61, 0.52, 0.43}, 0.5)(p) > 0 &&
           p.x() + p.y() < 1.1;  // a corner that nobody looked into
  });
  return map;
}

/// Every cell against every submap in each of its points. Returns how many of each value there are.
std::map<std::int8_t, int> ExpectSliceEqualsBruteForce(Map& map, SliceOptions options) {
  options.with_objects = true;
  const Whole whole = SliceOf(map, options);
  const auto parts = [](double length_m) { return static_cast<int>(std::ceil(length_m / kSceneVoxel_m - 1e-6)); };
  const int side = parts(options.resolution_m), up = parts(options.max_z_m - options.min_z_m);
  std::map<std::int8_t, int> counts;
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      std::map<SubmapId, int> owners;
      int num_free = 0;
      for (int n = 0; n < side * side * up; ++n) {
        const double i = n % side + 0.5, j = n / side % side + 0.5, k = n / side / side + 0.5;
        const Eigen::Vector3d p(options.min_m.x() + (x + i / side) * options.resolution_m,
                                options.min_m.y() + (y + j / side) * options.resolution_m,
                                options.min_z_m + k / up * (options.max_z_m - options.min_z_m));
        const ToldOfPlace told = Look(*map.published(), options.T_map_query * p, options.scope);
        num_free += told.state == VoxelState::kFree;
        for (const SubmapId id : told.submaps) ++owners[id];
      }
      const std::int8_t expected = !owners.empty()                                     ? kOccupiedCell
                                   : num_free >= options.free_share * side * side * up ? kFreeCell
                                                                                       : kUnknownCell;
      const auto at = static_cast<std::size_t>(y * options.width + x);
      EXPECT_EQ(whole.cells[at], expected) << x << " " << y;
      ++counts[whole.cells[at]];
      EXPECT_EQ(whole.objects[at] != nullptr, whole.cells[at] == kOccupiedCell);
      if (owners.size() == 1 && whole.objects[at] != nullptr) {
        EXPECT_EQ(whole.objects[at]->id, owners.begin()->first);
      }
      EXPECT_TRUE(whole.objects[at] == nullptr || owners.contains(whole.objects[at]->id));
    }
  }
  return counts;
}

SliceOptions WholeRoom(double min_z_m, double max_z_m) {
  return {.min_z_m = min_z_m,
          .max_z_m = max_z_m,
          .resolution_m = kSceneVoxel_m,
          .min_m = {-1.8, -1.8},
          .width = 72,
          .height = 72};
}

TEST(OccupancySlice, EqualsBruteForce) {
  Map map = RoomSeenThrough();
  const auto counts = ExpectSliceEqualsBruteForce(map, WholeRoom(-0.3, 0.2));
  EXPECT_GT(counts.at(kFreeCell), 1000);
  EXPECT_GT(counts.at(kOccupiedCell), 200);
  EXPECT_GT(counts.at(kUnknownCell), 200);
}

TEST(OccupancySlice, EqualsBruteForceInAFrameAndWhereObjectsAreMovedClonedAndLeftOut) {
  Map map = RoomSeenThrough();
  std::mt19937 random(5);
  map.FindMutable(SubmapId(1))->mutable_info().T_map_submap = testing::RandomPose(random, 0.4);
  map.Clone(SubmapId(2))->mutable_info().T_map_submap = testing::RandomPose(random, 0.7);
  SliceOptions options = WholeRoom(-0.4, 0.13);
  options.T_map_query = testing::RandomPose(random, 0.2);
  options.resolution_m = 0.13;
  options.width = 27;
  options.height = 25;
  options.free_share = 0.6;
  options.scope.excluded_submaps = {SubmapId(3)};
  const auto counts = ExpectSliceEqualsBruteForce(map, options);
  EXPECT_GT(counts.at(kFreeCell), 50);
  EXPECT_GT(counts.at(kOccupiedCell), 50);
  EXPECT_GT(counts.at(kUnknownCell), 50);
}

TEST(OccupancySlice, EqualsBruteForceWhereSomethingWasLeft) {
  Map map = RoomSeenThrough();
  FreeBlocks left;  // on both sides of surfaces, too
  left.full = 0x0FF0F00F3CC3A55Aull;
  for (int n = 0; n < 8; ++n) map.mutable_vacated().Add({(n & 1) - 1, (n >> 1 & 1) - 1, (n >> 2) - 1}, left, 0);
  SliceOptions options = WholeRoom(-0.3, 0.2);
  const auto counts = ExpectSliceEqualsBruteForce(map, options);
  options.scope.vacated_is_free = true;
  const auto counts_if_free = ExpectSliceEqualsBruteForce(map, options);
  EXPECT_GT(counts_if_free.at(kFreeCell), counts.at(kFreeCell));
  EXPECT_EQ(counts_if_free.at(kOccupiedCell), counts.at(kOccupiedCell)) << "what is seen counts before it";
}

TEST(OccupancySlice, AnythingInTheBandOccupiesACellAndAShareFreesIt) {
  Map map(testing::SceneInfo());
  const Eigen::Vector3d block(0.525, 0.525, 0.525);
  testing::ObserveBand(testing::AddThing(map), testing::Block(block, {0.2, 0.2, 0.2}), testing::CubeAt(block, 0.6));
  LookThrough(map, {Eigen::Vector3d(2.01, 0.01, 0.01), Eigen::Vector3d(2.99, 0.99, 0.29)},
              [](const Eigen::Vector3d&) { return true; });
  SliceOptions options{.min_z_m = 0, .max_z_m = 1, .resolution_m = 0.05, .width = 60, .height = 20};
  const auto at = [&](double x_m) { return SliceOf(map, options).cells[static_cast<std::size_t>(10 * 60 + x_m * 20)]; };
  EXPECT_EQ(at(0.525), kOccupiedCell);
  EXPECT_EQ(at(0.32), kOccupiedCell) << "the side of the block: half of the band only";
  EXPECT_EQ(at(0.28), kFreeCell) << "observed in front of it, over more than half of the band";
  EXPECT_EQ(at(2.5), kFreeCell) << "looked through over 0.3 of the band";
  EXPECT_EQ(at(1.5), kUnknownCell);
  options.free_share = 0.31;
  EXPECT_EQ(at(2.5), kUnknownCell);
  options.max_z_m = 0.35;
  EXPECT_EQ(at(2.5), kFreeCell);
  EXPECT_EQ(at(0.525), kOccupiedCell) << "the bottom of the block is at 0.325";
  options.max_z_m = 0.3;
  EXPECT_NE(at(0.525), kOccupiedCell) << "below the block";
  options.unknown = kFreeCell;
  EXPECT_EQ(at(1.5), kFreeCell) << "the caller's word on the unknown";
}

TEST(OccupancySlice, TheKnownAreaHoldsAllThatIsSeenInTheBandAndNothingIsFarOutside) {
  Map map = RoomSeenThrough();
  SurfaceCache cache(std::size_t{1} << 30);
  const auto surfaces = cache.Of(map.Publish(0));
  SliceOptions options = WholeRoom(-0.2, 0.2);
  const auto area = KnownArea(*surfaces, options);
  ASSERT_TRUE(area);
  EXPECT_TRUE(area->contains(Eigen::Vector2d(-1.6, 1.6)) && area->contains(Eigen::Vector2d(1.6, -1.6)));
  EXPECT_LT(area->sizes().maxCoeff(), 3.4 + 2 * 0.5);
  options.min_z_m = 50;
  options.max_z_m = 51;
  EXPECT_FALSE(KnownArea(*surfaces, options));
}

}  // namespace
}  // namespace dhpmap
