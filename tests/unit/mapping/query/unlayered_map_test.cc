// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <vector>

#include "mapping/query/body_query.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/point_lookup.h"
#include "mapping/query/ray_query.h"
#include "mapping/query/voxel_sampler.h"
#include "mapping/query/voxel_states.h"
#include "tests/unit/mapping/query/surface_scene.h"

// A map that keeps nothing of what sensors have looked through, as those made before there was such a layer: nothing
// is free but what was observed in front of a surface.

namespace dhpmap {
namespace {

/// What the submaps' own voxels say of a place. All lie as mapped.
struct OwnVoxels {
  bool is_observed = false, is_front = false;

  OwnVoxels(const MapSnapshot& map, const Eigen::Vector3d& p_map) {
    for (const auto& submap : map.submaps()) {
      const VoxelSample voxel = SampleVoxelAt(*submap, p_map);
      if (!voxel.IsObserved()) continue;
      is_observed = true;
      is_front |= voxel.distance_m() > 0;
    }
  }
};

/// Also what is asked for to be free if it is old enough, or was left by something.
std::vector<QueryScope> Scopes() {
  std::vector<QueryScope> scopes(3);
  scopes[1].vacated_is_free = true;
  scopes[2].max_free_age_s = 1e6;
  return scopes;
}

class UnlayeredMap : public ::testing::Test {
 protected:
  UnlayeredMap() : state_(map_.Publish(0)), surfaces_(cache_.Of(state_)) {}

  Map map_ = testing::FurnishedRoom();
  SurfaceCache cache_{std::size_t{1} << 30};
  std::shared_ptr<const MapSnapshot> state_;
  std::shared_ptr<const MapSurfaces> surfaces_;
  const std::vector<Eigen::Vector3d> points_ = testing::RandomPoints(600, 1.9, 31);
};

TEST_F(UnlayeredMap, NoPointIsFree) {
  const PointLookup lookup(state_);
  int num_unknown = 0;
  for (const Eigen::Vector3d& p : points_) {
    const PointInfo info = lookup.At(p);
    EXPECT_FALSE(info.is_free);
    EXPECT_EQ(info.is_observed, OwnVoxels(*state_, p).is_observed);
    num_unknown += !info.is_observed;
  }
  EXPECT_GT(num_unknown, 200);
}

TEST_F(UnlayeredMap, DistancesAreUnknownWhereNoVoxelWasObserved) {
  for (const QueryScope& scope : Scopes()) {
    for (const double tolerance_vox : {0.0, 0.5}) {
      const DistanceQuery query(surfaces_, {.tolerance_vox = tolerance_vox, .scope = scope});
      // By near fields once they were asked for often enough; some will do, as each takes a millisecond to make.
      const std::span some = std::span(points_).first(tolerance_vox > 0 ? 40 : points_.size());
      std::vector<SurfaceDistance> answers(some.size());
      for (int n = 0; n < (tolerance_vox > 0 ? 70 : 1); ++n) query.At(some, answers);
      for (std::size_t i = 0; i < some.size(); ++i) {
        const bool is_observed = OwnVoxels(*state_, points_[i]).is_observed;
        EXPECT_EQ(answers[i].status, is_observed ? DistanceStatus::kOk : DistanceStatus::kUnknown);
      }
    }
  }
}

TEST_F(UnlayeredMap, VoxelsAreFreeOnlyInFrontOfASurface) {
  for (const QueryScope& scope : Scopes()) {
    VoxelStates states(surfaces_, {.scope = scope}, false);
    int num_free = 0;
    for (const Eigen::Vector3d& p : points_) {
      const OwnVoxels own(*state_, p);
      const VoxelState state = states.At(p).state;
      num_free += state == VoxelState::kFree;
      EXPECT_EQ(state == VoxelState::kUnknown, !own.is_observed);
      if (state == VoxelState::kFree) {
        EXPECT_TRUE(own.is_front);
      }
    }
    EXPECT_GT(num_free, 20);
  }
}

TEST_F(UnlayeredMap, RaysEnterTheUnknownWhereNoVoxelWasObserved) {
  for (const QueryScope& scope : Scopes()) {
    const RayQuery query(surfaces_, {.scope = scope});
    for (const Eigen::Vector3d& p : points_) {
      const RayHit hit = query.Cast({p, Eigen::Vector3d::UnitX()});
      if (hit.distance_m <= 0) continue;
      const bool is_observed = OwnVoxels(*state_, p).is_observed;
      EXPECT_EQ(hit.free_m > 0, is_observed);
      EXPECT_EQ(hit.is_unknown, hit.free_m < hit.distance_m);
      // The voxel in which it ends to be known, a little farther on.
      if (hit.is_unknown) {
        EXPECT_FALSE(OwnVoxels(*state_, p + (hit.free_m + 1e-6) * Eigen::Vector3d::UnitX()).is_observed);
      }
    }
  }
}

TEST_F(UnlayeredMap, BodiesInTheUnknownAreInTheWayOrToldOf) {
  for (const QueryScope& scope : Scopes()) {
    const BodyQuery blocked(surfaces_, {.unknown = UnknownSpace::kOccupied, .scope = scope});
    const BodyQuery told(surfaces_, {.unknown = UnknownSpace::kReported, .scope = scope});
    const BodyQuery heedless(surfaces_, {.unknown = UnknownSpace::kFree, .scope = scope});
    int num_unknown = 0;
    for (const Eigen::Vector3d& p : points_) {
      if (OwnVoxels(*state_, p).is_observed) continue;
      const Capsule ball{p, p, 0.06};  // more than a voxel's diagonal, so that it holds a centre
      EXPECT_TRUE(blocked.Check(ball).is_colliding);
      EXPECT_TRUE(blocked.Test(ball).is_colliding);
      const BodyAnswer answer = told.Check(ball);
      EXPECT_TRUE(answer.is_colliding || answer.is_unknown);
      num_unknown += answer.is_unknown;
      EXPECT_EQ(heedless.Check(ball).is_colliding, answer.is_colliding);
    }
    EXPECT_GT(num_unknown, 100);
  }
}

}  // namespace
}  // namespace dhpmap
