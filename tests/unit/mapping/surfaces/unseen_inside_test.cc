// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/unseen_inside.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "mapping/query/occupancy_slice.h"
#include "mapping/surfaces/look_into_cell.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

// What is kept of the inside of things changes no slice.

namespace dhpmap {
namespace {

using testing::kPlenty;
using testing::kSceneVoxel_m;

SliceOptions WholeRoom(bool with_objects) {
  return {.min_z_m = -0.15,
          .max_z_m = 0.2,
          .resolution_m = 2 * kSceneVoxel_m,
          .min_m = {-2.4, -2.4},
          .width = 48,
          .height = 48,
          .unknown = kFreeCell,
          .with_objects = with_objects};
}

struct Cells {
  std::vector<std::int8_t> values;
  std::vector<const SubmapInfo*> whose;
  bool operator==(const Cells&) const = default;
};

Cells SliceOf(const std::shared_ptr<const MapSurfaces>& surfaces, bool with_objects) {
  const SliceOptions options = WholeRoom(with_objects);
  OccupancySlice slice(surfaces, options);
  Cells cells;
  std::vector<std::int8_t> row(static_cast<std::size_t>(options.width));
  std::vector<const SubmapInfo*> objects(with_objects ? row.size() : 0);
  for (int y = 0; y < options.height; ++y) {
    slice.Row(y, row, objects);
    cells.values.insert(cells.values.end(), row.begin(), row.end());
    cells.whose.insert(cells.whose.end(), objects.begin(), objects.end());
  }
  return cells;
}

/// Of all blocks of the slice: those of which something is kept.
std::size_t NumKept(const MapSurfaces& surfaces) {
  std::size_t num_kept = 0;
  const double side_m = kBlockSide * kSceneVoxel_m;
  for (double x = -2.3; x < 2.4; x += side_m) {
    for (double y = -2.3; y < 2.4; y += side_m) {
      for (const double z : {-0.1, 0.1}) {
        const NearbyCell* cell = surfaces.cells().FindOrTakeOver(LookOf(surfaces), {x, y, z});
        num_kept += cell != nullptr && cell->unseen_inside != nullptr ? 1 : 0;
      }
    }
  }
  return num_kept;
}

/// Slices of one state after the other from one cache, and each from a cache of its own, which keeps nothing yet.
class UnseenInsideTest : public ::testing::Test {
 protected:
  UnseenInsideTest() : map_(testing::FurnishedRoom()) {
    testing::LookThrough(map_, testing::CubeAt({0, 0, 0}, 1.3), [](const Eigen::Vector3d& p) {
      return testing::Ball({0.61, 0.52, 0.43}, 0.5)(p) > 0 && p.x() + p.y() < 1.1 &&
             testing::Block({-0.7, -0.6, -0.2}, {0.4, 0.35, 0.5})(p) > 0;
    });
  }

  /// Whether the slice is another than the one before.
  bool ExpectAsFromNothing(const char* when) {
    const auto state = map_.Publish(0);
    SurfaceCache fresh(kPlenty);
    const auto surfaces = cache_.Of(state), anew = fresh.Of(state);
    num_taken_over_ = NumKept(*surfaces);
    const Cells first = SliceOf(anew, true);
    EXPECT_EQ(SliceOf(surfaces, true), first) << when;
    EXPECT_EQ(SliceOf(surfaces, true), first) << when << ", again";
    EXPECT_EQ(SliceOf(surfaces, false).values, first.values) << when << ", without objects";
    const bool is_other = first.values != before_;
    before_ = first.values;
    return is_other;
  }

  Map map_;
  SurfaceCache cache_{kPlenty};
  std::size_t num_taken_over_ = 0;  ///< blocks of which something is kept before the slice is made
  std::vector<std::int8_t> before_;
};

TEST_F(UnseenInsideTest, IsThatOfEachStateWhateverChanges) {
  std::mt19937 random(3);
  ExpectAsFromNothing("as it is");
  map_.FindMutable(SubmapId(2))->mutable_info().T_map_submap = testing::RandomPose(random, 0.3);
  EXPECT_TRUE(ExpectAsFromNothing("a thing moved"));
  map_.Clone(SubmapId(1))->mutable_info().T_map_submap = testing::RandomPose(random, 0.9);
  EXPECT_TRUE(ExpectAsFromNothing("a thing more"));
  testing::LookThrough(map_, testing::CubeAt({0, -2, 0}, 0.3), [](const Eigen::Vector3d&) { return true; });
  EXPECT_TRUE(ExpectAsFromNothing("behind a wall looked through"));
  const Eigen::Vector3d more(-0.2, 0.9, 0);
  testing::ObserveBand(*map_.FindMutable(SubmapId(1)), testing::Ball(more, 0.3), testing::CubeAt(more, 0.5));
  EXPECT_TRUE(ExpectAsFromNothing("a thing seen elsewhere, too"));
  ASSERT_TRUE(map_.Remove(SubmapId(4)));
  EXPECT_TRUE(ExpectAsFromNothing("without walls"));
}

TEST_F(UnseenInsideTest, GoesOnWhereNothingNearHasChanged) {
  const Eigen::Vector3d far_off(9, 0, 0);
  const SubmapId far_thing = testing::AddThing(map_).id();
  testing::ObserveBand(*map_.FindMutable(far_thing), testing::Ball(far_off, 0.3), testing::CubeAt(far_off, 0.5));
  ExpectAsFromNothing("as it is");
  EXPECT_EQ(num_taken_over_, 0u);
  const std::size_t num_kept = NumKept(*cache_.Of(map_.published()));
  EXPECT_GT(num_kept, 50u);
  map_.FindMutable(far_thing)->mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0.1, 0, 0));
  ExpectAsFromNothing("a thing moved far off");
  EXPECT_EQ(num_taken_over_, num_kept);
  map_.FindMutable(SubmapId(2))->mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0.1, 0, 0));
  ExpectAsFromNothing("a thing moved in the room");
  EXPECT_LT(num_taken_over_, num_kept);
}

/// The face of a thing that looks to +x, and of background what sensors saw beside it 0.9 m behind: so much of the
/// thing is taken to be solid as it is wide, farther from it than what is nearest.
TEST(UnseenInside, EndsWithTheFarEndOfAThing) {
  Map map(testing::SceneInfo());
  const auto see = [&](Panoptic panoptic, double x_m, double half_m,
                       const std::function<bool(const Eigen::Vector3d&)>& is_seen) {
    Submap& submap = testing::AddThing(map);
    submap.mutable_info().panoptic = panoptic;
    testing::ObserveBand(
        submap, [x_m](const Eigen::Vector3d& p) { return p.x() - x_m; }, testing::CubeAt({x_m, 0, 0}, half_m), is_seen);
  };
  see(Panoptic::kThing, 0, 0.5,
      [](const Eigen::Vector3d& p) { return std::abs(p.y()) < 0.4 && std::abs(p.z()) < 0.4; });
  see(Panoptic::kStuff, -0.9, 1, [](const Eigen::Vector3d& p) { return std::abs(p.y()) > 0.45; });
  SurfaceCache cache(kPlenty);
  const auto surfaces = cache.Of(map.Publish(0));
  const BlockIndex deep = BlockOf(VoxelAt({-0.68, 0.3, 0}, kSceneVoxel_m));
  const auto before = ThingsAround(*surfaces, deep);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before[0].id, SubmapId(1));
  EXPECT_TRUE(AreSame(before, ThingsAround(*cache.Of(map.published()), deep)));
  map.FindMutable(SubmapId(1))->mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0, 0, 0.05));
  const auto moved = cache.Of(map.Publish(0));
  EXPECT_FALSE(AreSame(before, ThingsAround(*moved, deep)));
  testing::ObserveBand(
      *map.FindMutable(SubmapId(1)), [](const Eigen::Vector3d& p) { return p.x(); }, testing::CubeAt({0, 0, 0}, 0.6));
  EXPECT_FALSE(AreSame(ThingsAround(*moved, deep), ThingsAround(*cache.Of(map.Publish(0)), deep)));
}

TEST(UnseenInside, OfOneSubmapTheNearestIsThatOfASearchWithItAlone) {
  Map map = testing::DisarrayedRoom(8);
  const auto surfaces = testing::SurfacesOf(map);
  const std::vector<bool> everybody;
  NearestSearch search(*surfaces, everybody, everybody);
  std::size_t num_found = 0;
  for (std::size_t number = 0; number < surfaces->index().entries().size(); ++number) {
    std::vector<bool> alone(surfaces->index().entries().size());
    alone[number] = true;
    for (const Eigen::Vector3d& p : testing::RandomPoints(200, 1.8, 5)) {
      for (const double limit_m : {0.3, 5.0}) {
        const NearestSurface expected = NearestSearch(*surfaces, alone, everybody).Find(p, limit_m);
        const NearestSurface found = search.FindOf(number, p, limit_m);
        ASSERT_EQ(found.is_any, expected.is_any);
        if (!found.is_any) continue;
        ++num_found;
        EXPECT_EQ(found.point_submap, expected.point_submap);
        EXPECT_EQ(found.is_behind, expected.is_behind);
        EXPECT_EQ(found.is_beside, expected.is_beside);
      }
    }
  }
  EXPECT_GT(num_found, 1000u);
}

}  // namespace
}  // namespace dhpmap
