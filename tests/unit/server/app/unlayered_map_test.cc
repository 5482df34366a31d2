// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "server/app/queries/body_check.h"
#include "server/app/queries/distance_grid.h"
#include "server/app/queries/distance_lookup.h"
#include "server/app/queries/point_query.h"
#include "server/app/queries/ray_cast.h"
#include "server/app/queries/slice_export.h"
#include "server/app/queries/trajectory_check.h"
#include "tests/unit/mapping/query/surface_scene.h"

// Answers about a map without a free-space layer.

namespace dhpmap {
namespace {

class UnlayeredMapOnServer : public ::testing::Test {
 protected:
  UnlayeredMapOnServer() {
    testing::ObserveBand(testing::AddThing(map_), testing::Ball({0, 0, 0}, 0.5), testing::CubeAt({0, 0, 0}, 0.7));
    view_ = std::make_shared<const MapView>(map_.Publish(0));
  }
  Map map_{testing::SceneInfo()};
  std::shared_ptr<const MapView> view_;
  SurfaceCache cache_{std::size_t{1} << 28};
  const std::vector<Eigen::Vector3d> seen_ = {{0.6, 0, 0}, {0.02, -0.61, 0.03}};
  const std::vector<Eigen::Vector3d> unseen_ = {{0.9, 0, 0}, {-0.7, 0.8, 0.3}, {0, 0, 1.4}, {0, 0, 0.02}};
};

TEST_F(UnlayeredMapOnServer, PointsAreNeitherFreeNorObserved) {
  int num_answers = 0;
  ASSERT_TRUE(LookUpPoints(*view_, unseen_, {}, InPlace, [&](const PointInfo& info) {
                EXPECT_FALSE(info.is_free);
                EXPECT_FALSE(info.is_observed);
                ++num_answers;
              }).ok());
  EXPECT_EQ(num_answers, 4);
  ASSERT_TRUE(LookUpPoints(*view_, seen_, {}, InPlace, [](const PointInfo& info) {
                EXPECT_FALSE(info.is_free) << "nobody has kept whether it was looked through";
                EXPECT_TRUE(info.is_observed);
              }).ok());
}

TEST_F(UnlayeredMapOnServer, DistancesAreUnknown) {
  const auto ask = [this](const std::vector<Eigen::Vector3d>& points_m, DistanceStatus expected) {
    ASSERT_TRUE(LookUpDistances(*view_, cache_, {}, points_m, {}, InPlace, [&](const SurfaceDistance& answer) {
                  EXPECT_EQ(answer.status, expected);
                }).ok());
  };
  ask(unseen_, DistanceStatus::kUnknown);
  ask(seen_, DistanceStatus::kOk);
  GridQuestion question;
  question.corner_m = Eigen::Vector3d(0.8, 0.8, 0.8);
  question.resolution_m = 0.05;
  question.size = {3, 4, 5};
  DistanceGrid grid(view_, cache_, question);
  while (!grid.is_done()) {
    const auto batch = grid.NextBatch({});
    ASSERT_TRUE(batch.ok());
    for (const SurfaceDistance& answer : *batch) EXPECT_EQ(answer.status, DistanceStatus::kUnknown);
  }
}

TEST_F(UnlayeredMapOnServer, RaysEndAtUnknownSpace) {
  std::vector<Ray> rays;
  for (const Eigen::Vector3d& p : unseen_) rays.push_back({p, Eigen::Vector3d::UnitY()});
  rays.push_back({{0.6, 0, 0}, Eigen::Vector3d::UnitX()});
  std::vector<RayHit> hits;
  ASSERT_TRUE(CastRays(*view_, cache_, {}, rays, {}, [&](const RayHit& hit) { hits.push_back(hit); }).ok());
  ASSERT_EQ(hits.size(), rays.size());
  for (std::size_t i = 0; i < unseen_.size(); ++i) {
    EXPECT_TRUE(hits[i].is_unknown);
    EXPECT_EQ(hits[i].free_m, 0);
  }
  EXPECT_TRUE(hits.back().is_unknown);
  EXPECT_NEAR(hits.back().free_m, 0.05, 0.011) << "to the end of the band";
}

TEST_F(UnlayeredMapOnServer, UnknownSpaceBlocksBodiesAndMotions) {
  CheckQuestion question;
  std::vector<Body> bodies;
  for (const Eigen::Vector3d& p : unseen_) bodies.push_back(Capsule{p, p, 0.05});
  ASSERT_TRUE(CheckBodies(*view_, cache_, question, bodies, {}, [](const BodyAnswer& answer) {
                EXPECT_TRUE(answer.is_colliding);
              }).ok());
  const auto motion_of = [](std::size_t) {
    RobotMotion motion;
    motion.spheres.resize(1);
    motion.spheres[0] = {{.at = 0, .center_m = {1, -1, 0}, .radius_m = 0.05},
                         {.at = 1, .center_m = {1, 1, 0}, .radius_m = 0.05}};
    return motion;
  };
  for (const UnknownSpace unknown : {UnknownSpace::kOccupied, UnknownSpace::kReported, UnknownSpace::kFree}) {
    question.options.unknown = unknown;
    ASSERT_TRUE(CheckTrajectories(*view_, cache_, question, 1, motion_of, {}, [&](const TrajectoryAnswer& answer) {
                  EXPECT_EQ(answer.is_valid, unknown != UnknownSpace::kOccupied);
                  EXPECT_EQ(answer.is_unknown, unknown != UnknownSpace::kFree);
                }).ok());
  }
}

TEST_F(UnlayeredMapOnServer, SlicesShowNothingFreeBeyondTheBand) {
  SliceRequest request;
  request.options.min_z_m = 0;
  request.options.max_z_m = 0.05;
  request.options.resolution_m = 0.05;
  request.area_m = Eigen::AlignedBox2d(Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1));
  const Result<SliceAnswer> slice = ExportSlice(*view_, cache_, request, {});
  ASSERT_TRUE(slice.ok());
  int num_free = 0, num_unknown = 0;
  for (int y = 0; y < slice->options.height; ++y) {
    for (int x = 0; x < slice->options.width; ++x) {
      const Eigen::Vector3d p(slice->options.min_m.x() + 0.05 * (x + 0.5), slice->options.min_m.y() + 0.05 * (y + 0.5),
                              0.025);
      const std::int8_t cell = slice->cells[static_cast<std::size_t>(y * slice->options.width + x)];
      num_free += cell == kFreeCell;
      num_unknown += cell == kUnknownCell;
      const double ball_m = std::abs(p.norm() - 0.5);
      if (ball_m > testing::kSceneTruncation_m + 1e-6) {
        EXPECT_EQ(cell, kUnknownCell) << p.transpose();
      }
    }
  }
  EXPECT_GT(num_free, 50) << "in front of the surface";
  EXPECT_GT(num_unknown, 500);
}

}  // namespace
}  // namespace dhpmap
