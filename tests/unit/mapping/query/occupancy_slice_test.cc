// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/occupancy_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "mapping/query/trajectory_query.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::AllTriangles;
using testing::kSceneVoxel_m;

struct ToldOfPlace {
  VoxelState state = VoxelState::kUnknown;
  std::vector<SubmapId> submaps;  ///< inside of which it is
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
    if (block->tsdf->distance_m[static_cast<std::size_t>(LinearIndex(voxel))] > 0) is_in_front = true;
    else if (!is_seen_through) told.submaps.push_back(submap->id());
  }
  if (!told.submaps.empty()) told.state = VoxelState::kInside;
  else if (is_in_front || is_seen_through || is_left) told.state = VoxelState::kFree;
  return told;
}

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Whether a triangle meets a box: unless an axis keeps them apart, of the box, the triangle or across two edges.
bool Meets(const Triangle& triangle, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d half = box.sizes() / 2, middle = box.center();
  const auto is_apart = [&](const Eigen::Vector3d& axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Eigen::Vector3d& corner : triangle) {
      low = std::min(low, axis.dot(corner - middle));
      high = std::max(high, axis.dot(corner - middle));
    }
    const double reach = axis.cwiseAbs().dot(half);
    return low > reach || high < -reach;
  };
  const Eigen::Vector3d a = triangle[1] - triangle[0], b = triangle[2] - triangle[1], c = triangle[0] - triangle[2];
  if (is_apart(a.cross(b))) return false;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    if (is_apart(axis) || is_apart(axis.cross(a)) || is_apart(axis.cross(b)) || is_apart(axis.cross(c))) return false;
  }
  return true;
}

/// All triangles of what is there, in the frame of a slice.
std::vector<std::pair<SubmapId, Triangle>> TrianglesOf(const MapSnapshot& map, const SliceOptions& options) {
  std::vector<std::pair<SubmapId, Triangle>> triangles;
  for (const auto& submap : map.submaps()) {
    if (!options.scope.Holds(submap->info())) continue;
    for (Triangle triangle : testing::TrianglesInMap(*submap)) {
      for (Eigen::Vector3d& corner : triangle) corner = options.T_map_query.inverse() * corner;
      triangles.emplace_back(submap->id(), triangle);
    }
  }
  return triangles;
}

/// The submaps that have a surface in a box, and whether it is a matter of rounding that there is any.
struct SurfaceInBox {
  std::vector<SubmapId> submaps;
  bool is_close = false;
};
SurfaceInBox SurfaceIn(const Eigen::AlignedBox3d& box, const std::vector<std::pair<SubmapId, Triangle>>& triangles) {
  const Eigen::Vector3d rounding = Eigen::Vector3d::Constant(1e-5);
  const Eigen::AlignedBox3d wide(box.min() - rounding, box.max() + rounding),
      tight(box.min() + rounding, box.max() - rounding);
  SurfaceInBox found{.submaps = {}, .is_close = true};
  for (const auto& [id, triangle] : triangles) {
    Eigen::AlignedBox3d around(triangle[0]);
    around.extend(triangle[1]).extend(triangle[2]);
    if (!around.intersects(wide) || !Meets(triangle, wide)) continue;
    found.submaps.push_back(id);
    if (Meets(triangle, tight)) found.is_close = false;
  }
  if (found.submaps.empty()) found.is_close = false;
  return found;
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
  testing::LookThrough(map, testing::CubeAt({0, 0, 0}, 1.5), [](const Eigen::Vector3d& p) {
    return testing::Room({0, 0, 0}, {1.4, 1.4, 1.4})(p) > 0 && testing::Ball({0.61, 0.52, 0.43}, 0.5)(p) > 0 &&
           p.x() + p.y() < 1.1;  // a corner that nobody looked into
  });
  return map;
}

/// Every cell against all triangles, and every submap in each of its points. Returns how many of each value there are.
std::map<std::int8_t, int> ExpectSliceEqualsBruteForce(Map& map, SliceOptions options) {
  options.with_objects = true;
  const Whole whole = SliceOf(map, options);
  const MapSnapshot& state = *map.published();
  const auto triangles = TrianglesOf(state, options);
  const DistanceQuery distances(whole.surfaces, {.max_distance_m = options.max_distance_m, .scope = options.scope});
  const double step_m = options.T_map_query.linear().isIdentity() ? kSceneVoxel_m : 0.57 * kSceneVoxel_m;
  const auto parts = [&](double length_m) { return static_cast<int>(std::ceil(length_m / step_m - 1e-6)); };
  const int side = parts(options.resolution_m), up = parts(options.max_z_m - options.min_z_m);
  std::map<std::int8_t, int> counts;
  int num_close = 0;
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      const Eigen::Vector2d low = options.min_m + options.resolution_m * Eigen::Vector2d(x, y);
      const Eigen::Vector2d high = options.min_m + options.resolution_m * Eigen::Vector2d(x + 1, y + 1);
      const SurfaceInBox surface = SurfaceIn(
          {Eigen::Vector3d(low.x(), low.y(), options.min_z_m), Eigen::Vector3d(high.x(), high.y(), options.max_z_m)},
          triangles);
      if (surface.is_close && ++num_close > 0) continue;
      std::vector<SubmapId> owners = surface.submaps;
      int num_free = 0, num_unknown = 0;
      for (int n = 0; n < side * side * up; ++n) {
        const double i = n % side + 0.5, j = n / side % side + 0.5, k = n / side / side + 0.5;
        const Eigen::Vector3d p(low.x() + i / side * options.resolution_m, low.y() + j / side * options.resolution_m,
                                options.min_z_m + k / up * (options.max_z_m - options.min_z_m));
        const Eigen::Vector3d p_map = options.T_map_query * p;
        const ToldOfPlace told = Look(state, p_map, options.scope);
        num_free += told.state == VoxelState::kFree;
        num_unknown += told.state == VoxelState::kUnknown;
        if (!surface.submaps.empty()) continue;
        owners.insert(owners.end(), told.submaps.begin(), told.submaps.end());
        if (told.state != VoxelState::kUnknown || options.unknown != kFreeCell) continue;
        const auto behind = distances.At(VoxelCentre(VoxelAt(p_map, kSceneVoxel_m), kSceneVoxel_m));
        if (behind.distance_m < 0) owners.push_back(behind.submap->id);
      }
      const bool is_blocked = num_unknown > 0 && options.unknown == kOccupiedCell;
      const std::int8_t expected = !owners.empty() || is_blocked                       ? kOccupiedCell
                                   : num_free >= options.free_share * side * side * up ? kFreeCell
                                                                                       : options.unknown;
      const auto at = static_cast<std::size_t>(y * options.width + x);
      EXPECT_EQ(whole.cells[at], expected) << x << " " << y;
      ++counts[whole.cells[at]];
      EXPECT_EQ(whole.objects[at] != nullptr, !owners.empty()) << x << " " << y;
      if (whole.objects[at] == nullptr) continue;
      EXPECT_NE(std::find(owners.begin(), owners.end(), whole.objects[at]->id), owners.end()) << x << " " << y;
    }
  }
  EXPECT_LT(num_close, options.width * options.height / 10) << "a matter of rounding";
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

TEST(OccupancySlice, EqualsBruteForceWhereTheUnknownIsFreeAndWhereItIsOccupied) {
  Map map = RoomSeenThrough();
  SliceOptions options = WholeRoom(-0.33, 0.21);
  const auto if_unknown = ExpectSliceEqualsBruteForce(map, options);
  options.unknown = kFreeCell;
  const auto if_free = ExpectSliceEqualsBruteForce(map, options);
  EXPECT_GT(if_free.at(kOccupiedCell), if_unknown.at(kOccupiedCell) + 50) << "balls are not hollow";
  EXPECT_GT(if_free.at(kFreeCell), if_unknown.at(kFreeCell) + 50);
  options.unknown = kOccupiedCell;
  const auto if_occupied = ExpectSliceEqualsBruteForce(map, options);
  EXPECT_LT(if_occupied.at(kFreeCell), if_unknown.at(kFreeCell)) << "nothing unknown is within a cell that is free";
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
  testing::LookThrough(map, {Eigen::Vector3d(2.01, 0.01, 0.01), Eigen::Vector3d(2.99, 0.99, 0.29)},
                       [](const Eigen::Vector3d&) { return true; });
  SliceOptions options{.min_z_m = 0, .max_z_m = 1, .resolution_m = 0.05, .width = 60, .height = 20};
  const auto at = [&](double x_m) { return SliceOf(map, options).cells[static_cast<std::size_t>(10 * 60 + x_m * 20)]; };
  EXPECT_EQ(at(0.525), kOccupiedCell);
  EXPECT_EQ(at(0.33), kOccupiedCell) << "the side of the block: half of the band only";
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

/// Cells whose centre is farther than the radius and half a cell's diagonal from those of all that are not free.
std::vector<bool> Inflated(const Whole& whole, const SliceOptions& options, double radius_m) {
  const double reach = radius_m / options.resolution_m + std::sqrt(0.5);
  std::vector<bool> may_go(whole.cells.size(), true);
  for (int at = 0; at < options.width * options.height; ++at) {
    for (int other = 0; other < options.width * options.height; ++other) {
      const double dx = at % options.width - other % options.width, dy = at / options.width - other / options.width;
      if (whole.cells[static_cast<std::size_t>(other)] == kFreeCell || std::hypot(dx, dy) > reach) continue;
      may_go[static_cast<std::size_t>(at)] = false;
    }
  }
  return may_go;
}

/// Whatever way a ball goes from cell to cell, at whatever height, no check finds anything in its way, and there is no
/// triangle that it touches. Returns how many cells it may be in.
int ExpectWaysAreFree(Map& map, const SliceOptions& options, double radius_m) {
  const Whole whole = SliceOf(map, options);
  const std::vector<bool> may_go = Inflated(whole, options, radius_m);
  const UnknownSpace unknown = options.unknown == kFreeCell ? UnknownSpace::kFree : UnknownSpace::kOccupied;
  const auto query =
      TrajectoryQuery::Make(whole.surfaces, {.bodies = {.unknown = unknown, .scope = options.scope}, .attached = {}});
  const AllTriangles all(*map.published(), [&](const SubmapInfo& submap) { return options.scope.Holds(submap); });
  const auto may_go_at = [&](int x, int y) {
    return x < options.width && y >= 0 && y < options.height && may_go[static_cast<std::size_t>(y * options.width + x)];
  };
  const double low_m = options.min_z_m + radius_m, high_m = options.max_z_m - radius_m;
  int num_cells = 0;
  for (int n = 0; n < options.width * options.height; ++n) {
    const int x = n % options.width, y = n / options.width;
    if (!may_go_at(x, y)) continue;
    ++num_cells;
    const auto centre = [&](int dx, int dy, double z_m) {
      const Eigen::Vector2d p = options.min_m + options.resolution_m * Eigen::Vector2d(x + dx + 0.5, y + dy + 0.5);
      return Eigen::Vector3d(options.T_map_query * Eigen::Vector3d(p.x(), p.y(), z_m));
    };
    const auto expect_free = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      RobotMotion motion;
      motion.spheres = {{{0, from, radius_m}, {1, to, radius_m}}};
      EXPECT_TRUE(query->Check(motion)->is_valid) << from.transpose() << " to " << to.transpose();
    };
    expect_free(centre(0, 0, low_m), centre(0, 0, high_m));
    const double z_m = low_m + (n % 7) / 6.0 * (high_m - low_m);
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}}) {
      if (may_go_at(x + dx, y + dy)) expect_free(centre(0, 0, z_m), centre(dx, dy, z_m));
    }
    if (n % 11 == 0) {
      EXPECT_GT(all.Nearest(centre(0, 0, z_m)).distance_m, radius_m) << n;
    }
  }
  return num_cells;
}

TEST(OccupancySlice, WhereItLetsABallGoNothingIsInItsWay) {
  Map map = RoomSeenThrough();
  SliceOptions options = WholeRoom(-0.43, 0.31);
  for (const std::int8_t unknown : {kFreeCell, kOccupiedCell}) {
    options.unknown = unknown;
    EXPECT_GT(ExpectWaysAreFree(map, options, 0.12), 400);
  }
  std::mt19937 random(11);
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap = testing::RandomPose(random, 0.3);
  options.T_map_query = testing::RandomPose(random, 0.1);
  options.resolution_m = 0.08;
  options.width = options.height = 45;
  options.scope.excluded_submaps = {SubmapId(3)};
  for (const std::int8_t unknown : {kFreeCell, kOccupiedCell}) {
    options.unknown = unknown;
    EXPECT_GT(ExpectWaysAreFree(map, options, 0.1), 100);
  }
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
