// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of submaps that share the map's grid: one surface for all answers, of what was seen and of nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mapping/mesh/map_mesh.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/ray_query.h"
#include "mapping/surfaces/near_field.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kSceneVoxel_m;

constexpr std::size_t kPlentyBytes = std::size_t{1} << 30;

/// The distance to the exported mesh of a map, triangle by triangle.
class ExportedMesh {
 public:
  explicit ExportedMesh(const MapSnapshot& map) {
    ThreadPool here(1);
    const Mesh mesh = ExtractMapMesh(map, MeshColoring::kInstance, here);
    for (const auto& t : mesh.triangles) {
      triangles_.push_back({mesh.vertices_m[t[0]].cast<double>(), mesh.vertices_m[t[1]].cast<double>(),
                            mesh.vertices_m[t[2]].cast<double>()});
    }
  }
  [[nodiscard]] double Distance(const Eigen::Vector3d& p) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const auto& triangle : triangles_) nearest_m = std::min(nearest_m, testing::DistanceToTriangle(p, triangle));
    return nearest_m;
  }

 private:
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
};

/// A ball whose voxels belong to five submaps in a chequered pattern of patches, some of them to the unknown one.
Map ChequeredBall() {
  Map map(testing::SceneInfo());
  for (int k = 1; k < 5; ++k) (void)testing::AddThing(map, ClassId(static_cast<std::uint16_t>(1 + k % 2)));
  const auto patch = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q = (p / (3 * kSceneVoxel_m)).array().floor();
    return static_cast<int>(std::abs(7 * q.x() + 3 * q.y() + 5 * q.z())) % 5;
  };
  for (int k = 0; k < 5; ++k) {
    testing::ObserveBand(*map.FindMutable(SubmapId(static_cast<std::uint32_t>(k))), testing::Ball({0, 0, 0}, 0.5),
                         testing::CubeAt({0, 0, 0}, 0.7), [&](const Eigen::Vector3d& p) { return patch(p) == k; });
  }
  return map;
}

void ExpectDistancesOf(const DistanceQuery& query, const ExportedMesh& truth, unsigned seed) {
  for (const Eigen::Vector3d& p : testing::RandomPoints(150, 0.8, seed)) {
    EXPECT_NEAR(std::abs(query.At(p).distance_m), truth.Distance(p), 1e-3 * kSceneVoxel_m) << p.transpose();
  }
}

TEST(SharedSurface, DistancesAreThoseToTheExportedMesh) {
  Map map = ChequeredBall();
  SurfaceCache cache(kPlentyBytes);
  const auto state = map.Publish(0);
  ExpectDistancesOf(DistanceQuery(cache.Of(state), {}), ExportedMesh(*state), 1);
}

TEST(SharedSurface, WithoutAnObjectTheyAreThoseOfAMapThatNeverHadIt) {
  Map map = ChequeredBall();
  SurfaceCache cache(kPlentyBytes);
  const auto state = map.Publish(0);
  for (std::uint32_t k = 1; k < 5; ++k) {
    Map without = map.Fork();
    ASSERT_TRUE(without.Remove(SubmapId(k)));
    const ExportedMesh truth(*without.Publish(0));
    for (const double tolerance_vox : {0.0, NearField::kTolerance_vox}) {
      const DistanceQuery query(cache.Of(state),
                                {.tolerance_vox = tolerance_vox, .scope = {.excluded_submaps = {SubmapId(k)}}});
      ExpectDistancesOf(query, truth, k);
    }
  }
}

TEST(SharedSurface, OfSomethingThatWasMovedTheyAreThoseOfTheMeshThen) {
  Map map = ChequeredBall();
  SurfaceCache cache(kPlentyBytes);
  (void)DistanceQuery(cache.Of(map.Publish(0)), {}).At({0, 0, 0});
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap.translation() = Eigen::Vector3d(0.31, 0.2, 0.1);
  const auto state = map.Publish(0);
  ExpectDistancesOf(DistanceQuery(cache.Of(state), {}), ExportedMesh(*state), 3);
}

TEST(SharedSurface, FollowsWhatBecomesOfItsNeighbours) {
  Map map = ChequeredBall();
  SurfaceCache cache(kPlentyBytes);
  std::mt19937 random(7);
  for (int round = 0; round < 8; ++round) {
    const auto state = map.Publish(round);
    ExpectDistancesOf(DistanceQuery(cache.Of(state), {}), ExportedMesh(*state), static_cast<unsigned>(round));
    Submap& submap = *map.FindMutable(SubmapId(1 + random() % 4));  // the others stay as they are
    const BlockIndex block{static_cast<int>(random() % 4) - 2, static_cast<int>(random() % 4) - 2, 0};
    if (submap.blocks().Find(block) == nullptr) continue;
    TsdfBlock& tsdf = submap.MutableTsdf(block);
    for (std::size_t i = random() % 2; i < kBlockVoxels; i += 2) tsdf.weight[i] = 0;
  }
}

TEST(SharedSurface, PaddingOfOneLeavesTheSeamToItsNeighbours) {
  Map map = ChequeredBall();
  SurfaceCache cache(kPlentyBytes);
  const auto state = map.Publish(0);
  const ExportedMesh truth(*state);
  constexpr double kPadding_m = 0.02;
  SurfacePadding padding;
  padding.submaps = {{SubmapId(1), kPadding_m}};
  const DistanceQuery query(cache.Of(state), {.scope = {.padding = padding}});
  for (const Eigen::Vector3d& p : testing::RandomPoints(100, 0.8, 4)) {
    const double told_m = query.At(p).distance_m, bare_m = truth.Distance(p);
    if (bare_m < kSceneVoxel_m) continue;  // here the side may turn on the padding
    // Within, the grown surface is the farther one: what is nearest less its padding may be padding_m beyond the seam.
    const bool is_inside = p.norm() < 0.5;
    EXPECT_LE(told_m, (is_inside ? -bare_m : bare_m) + 1e-4);
    EXPECT_GE(told_m, is_inside ? -bare_m - 2 * kPadding_m - 1e-4 : bare_m - kPadding_m - 1e-4);
  }
}

TEST(SharedSurface, NoRayPassesBetweenTwoBoxesThatTouch) {
  // Side by side, each with the voxels on its side of where they touch.
  Map map(testing::SceneInfo());
  const auto both = testing::Block({0, 0, 0}, {0.6, 0.3, 0.3});
  const auto box = testing::CubeAt({0, 0, 0}, 0.8);
  testing::ObserveBand(testing::AddThing(map), both, box, [](const Eigen::Vector3d& p) { return p.x() < 0.01; });
  testing::ObserveBand(testing::AddThing(map), both, box, [](const Eigen::Vector3d& p) { return p.x() >= 0.01; });
  SurfaceCache cache(kPlentyBytes);
  const RayQuery query(cache.Of(map.Publish(0)), {.max_distance_m = 3, .unknown_is_free = true});
  for (int i = -40; i <= 40; ++i) {
    for (int k = -5; k <= 5; ++k) {
      const Ray ray{.origin_m = {0.002 * i, 0.05 * k, 1}, .direction = {0, 0, -1}};
      EXPECT_NEAR(query.Cast(ray).distance_m, 0.7, 0.1 * kSceneVoxel_m) << ray.origin_m.transpose();
    }
  }
}

TEST(SharedSurface, AWallEndsWhereItWasSeenToEnd) {
  // A wall in y > 0, and beside it a gap that was never observed: whether free or not, no surface reaches into it.
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return p.x() - 0.01; };
  testing::ObserveBand(testing::AddThing(map), wall, testing::CubeAt({0, 0, 0}, 0.5),
                       [](const Eigen::Vector3d& p) { return p.y() > 0; });
  SurfaceCache cache(kPlentyBytes);
  const DistanceQuery query(cache.Of(map.Publish(0)), {.unknown_is_free = true});
  constexpr double kEnd_m = 0.5 * kSceneVoxel_m;  // the centre of the last voxel that was seen
  for (const double y_m : {-0.02, -0.1, -0.3}) {
    for (const double x_m : {-0.1, 0.01, 0.08}) {
      const SurfaceDistance answer = query.At({x_m, y_m, 0.1});
      EXPECT_NEAR(std::abs(answer.distance_m), std::hypot(x_m - 0.01, kEnd_m - y_m), 1e-4);
      EXPECT_NEAR(answer.nearest_m.y(), kEnd_m, 1e-4);
    }
  }
}

TEST(SharedSurface, BehindABoxThatIsExcludedIsOnlyWhatWasSeen) {
  // A box stands before a wall, which was seen to both sides of the box and not behind it.
  Map map(testing::SceneInfo());
  const auto wall = [](const Eigen::Vector3d& p) { return p.x() - 0.01; };
  testing::ObserveBand(testing::AddThing(map), wall, testing::CubeAt({0, 0, 0}, 0.8),
                       [](const Eigen::Vector3d& p) { return std::abs(p.y()) > 0.3; });
  const auto box = testing::Block({0.1, 0, 0}, {0.2, 0.3, 0.8});
  testing::ObserveBand(testing::AddThing(map), box, testing::CubeAt({0.1, 0, 0}, 0.5),
                       [](const Eigen::Vector3d& p) { return std::abs(p.y()) <= 0.3; });
  SurfaceCache cache(kPlentyBytes);
  const DistanceQuery query(cache.Of(map.Publish(0)),
                            {.unknown_is_free = true, .scope = {.excluded_submaps = {SubmapId(2)}}});
  const double end_m = 0.3 + 0.5 * kSceneVoxel_m;
  for (const double y_m : {0.0, 0.1, 0.2}) {
    const SurfaceDistance answer = query.At({0.05, y_m, 0.1});
    EXPECT_NEAR(std::abs(answer.distance_m), std::hypot(0.04, end_m - y_m), 1e-4);
    EXPECT_EQ(answer.submap->id, SubmapId(1));
  }
}

}  // namespace
}  // namespace dhpmap
