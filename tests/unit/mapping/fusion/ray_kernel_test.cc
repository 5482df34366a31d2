// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/ray_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "mapping/fusion/grid_ray.h"
#include "mapping/fusion/ray_band.h"

namespace dhpmap {
namespace {

struct Walk {
  std::vector<VoxelIndex> voxels;
  std::vector<float> distances_m;
  std::vector<bool> is_labelled;
};

struct RayScene {
  float voxel_size_m = 0.05f, truncation_m = 0.15f;
  VoxelIndex sensor{-300, 7, 100'000};
  Eigen::Vector3f offset_vox{0.25f, 0.5f, 0.875f};
};

/// One ray, voxel by voxel.
Walk SlowWalk(const RayScene& scene, const Bundle& bundle) {
  const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
  const float range_m = end_m.norm();
  const Eigen::Vector3f direction = end_m / range_m;
  const RayBand band(bundle.plane, direction, range_m, scene.truncation_m, scene.voxel_size_m);
  GridRay ray(scene.sensor, scene.offset_vox, direction, scene.voxel_size_m, band.from_m, band.to_m);
  DistanceToPlane across(ray, scene.offset_vox, scene.voxel_size_m, bundle.plane.normal, bundle.plane.offset_m);
  Walk walk;
  for (int step = ray.num_voxels(); step > 0; --step, across.GoOn(ray.Next())) {
    const float along_m = ray.CentreAlongRay_m();
    if (along_m >= band.to_m) continue;
    walk.voxels.push_back(ray.voxel());
    walk.distances_m.push_back(across.distance_m());
    const float before_m = range_m - along_m;
    walk.is_labelled.push_back(before_m > -scene.truncation_m &&
                               before_m <= scene.truncation_m + 0.87f * scene.voxel_size_m);
  }
  return walk;
}

BlockIndex BlockOfEnd(const RayScene& scene, const Bundle& bundle) {
  const Eigen::Vector3f end_vox = bundle.weighted_sum_m / bundle.weight / scene.voxel_size_m + scene.offset_vox;
  return BlockOf({scene.sensor.x + static_cast<std::int32_t>(std::floor(end_vox.x())),
                  scene.sensor.y + static_cast<std::int32_t>(std::floor(end_vox.y())),
                  scene.sensor.z + static_cast<std::int32_t>(std::floor(end_vox.z()))});
}

/// What the kernel makes of one bundle in a lane, with others in the other lanes.
Walk WalkInLane(const RayScene& scene, const Bundle& bundle, const Bundle& others, std::size_t lane) {
  RayLanes rays;
  for (std::size_t i = 0; i < kRayLanes; ++i) {
    const Bundle& of_lane = i == lane ? bundle : others;
    rays.sum_x_m[i] = of_lane.weighted_sum_m.x(), rays.sum_y_m[i] = of_lane.weighted_sum_m.y();
    rays.sum_z_m[i] = of_lane.weighted_sum_m.z(), rays.weight[i] = of_lane.weight;
    rays.normal_x[i] = of_lane.plane.normal.x(), rays.normal_y[i] = of_lane.plane.normal.y();
    rays.normal_z[i] = of_lane.plane.normal.z(), rays.offset_m[i] = of_lane.plane.offset_m;
    rays.before_m[i] = of_lane.plane.before_m, rays.behind_m[i] = of_lane.plane.behind_m;
    const BlockIndex block = BlockOfEnd(scene, of_lane);
    const VoxelIndex first = VoxelIn({block.x - 1, block.y - 1, block.z - 1}, 0);
    rays.from_corner_x[i] = scene.sensor.x - first.x, rays.from_corner_y[i] = scene.sensor.y - first.y;
    rays.from_corner_z[i] = scene.sensor.z - first.z;
  }
  const BlockIndex center = BlockOfEnd(scene, bundle);
  WalkedVoxels walked;
  WalkRays({scene.voxel_size_m, scene.truncation_m, scene.offset_vox.x(), scene.offset_vox.y(), scene.offset_vox.z()},
           rays, walked);
  Walk walk;
  for (std::size_t step = 0; step < static_cast<std::size_t>(walked.num_steps[lane]); ++step) {
    const std::int32_t code = walked.voxel[step][lane];
    if (code == WalkedVoxels::kNone) continue;
    const int voxel = code & (WalkedVoxels::kLabelled - 1), block = voxel / kBlockVoxels;
    walk.voxels.push_back(VoxelIn({center.x + block % 3 - 1, center.y + block / 3 % 3 - 1, center.z + block / 9 - 1},
                                  voxel % kBlockVoxels));
    walk.distances_m.push_back(walked.distance_m[step][lane]);
    walk.is_labelled.push_back((code & WalkedVoxels::kLabelled) != 0);
  }
  return walk;
}

/// Ends somewhere, on a plane that it meets at any angle.
Bundle RandomBundle(const RayScene& scene, std::mt19937& random) {
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> share(0, 1);
  Bundle bundle;
  Eigen::Vector3f direction{normal(random), normal(random), normal(random)};
  if (random() % 8 == 0) direction[random() % 3] = 0;
  if (random() % 16 == 0) direction = Eigen::Vector3f::Unit(static_cast<int>(random() % 3)) * (random() % 2 ? 1 : -1);
  direction.normalize();
  const float range_m = 0.02f + 8 * share(random);
  bundle.weight = 0.1f + 5 * share(random);
  bundle.weighted_sum_m = direction * range_m * bundle.weight;
  do bundle.plane.normal = Eigen::Vector3f{normal(random), normal(random), normal(random)}.normalized();
  while (-bundle.plane.normal.dot(direction) < 0.05f);
  bundle.plane.offset_m = -bundle.plane.normal.dot(direction * range_m) + 0.02f * normal(random);
  const float most_m = static_cast<float>(kBlockSide) * scene.voxel_size_m;
  bundle.plane.before_m = random() % 2 ? 0 : most_m * share(random);
  bundle.plane.behind_m = random() % 2 ? 0 : most_m * share(random);
  return bundle;
}

TEST(RayKernel, WalksEachLaneAsOneRayIsWalked) {
  std::mt19937 random(4);
  for (const float truncation_m : {0.05f, 0.15f, 0.4f}) {
    RayScene scene;
    scene.truncation_m = truncation_m;
    for (int n = 0; n < 4000; ++n) {
      const Bundle bundle = RandomBundle(scene, random), others = RandomBundle(scene, random);
      const Walk slow = SlowWalk(scene, bundle);
      const Walk walk = WalkInLane(scene, bundle, others, static_cast<std::size_t>(n) % kRayLanes);
      ASSERT_EQ(walk.voxels, slow.voxels) << n << " at " << truncation_m;
      ASSERT_EQ(walk.distances_m, slow.distances_m) << "to the last bit";
      ASSERT_EQ(walk.is_labelled, slow.is_labelled);
    }
  }
}

TEST(RayKernel, HasRoomForTheLongestDiagonal) {
  RayScene scene;
  scene.truncation_m = static_cast<float>(kBlockSide) * scene.voxel_size_m;
  Bundle bundle;
  bundle.weight = 1;
  bundle.weighted_sum_m = Eigen::Vector3f(1.01f, 1.013f, -1.017f);
  bundle.plane = {.normal = -bundle.weighted_sum_m.normalized(), .offset_m = bundle.weighted_sum_m.norm()};
  const Walk walk = WalkInLane(scene, bundle, bundle, 3);
  EXPECT_GE(walk.voxels.size(), 27u);
  EXPECT_EQ(walk.voxels, SlowWalk(scene, bundle).voxels);
}

}  // namespace
}  // namespace dhpmap
