// SPDX-License-Identifier: BSD-3-Clause
// What a LiDAR is said to have looked through, against exact rays through analytic scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "mapping/space/free_space_finder.h"
#include "tests/unit/mapping/space/looked_through_scene.h"

namespace dhpmap {
namespace {

using testing::CastRay;
using testing::ForEachVoxel;
using testing::MapOfLooks;
using testing::Scan;
using testing::Scene;
using testing::Solid;

MapConfig Config() {
  MapConfig config = OutdoorLidarConfig();
  config.integration.max_range_m = 12;
  config.truncation_m = 0.3;
  return config;
}

/// A yard with walls, a box, a ball and a post.
Scene Yard() {
  using Shape = Solid::Shape;
  const auto wall = [](Eigen::Vector3d point, Eigen::Vector3d normal) {
    return Solid{.shape = Shape::kHalfSpace, .center_m = point, .size_m = normal};
  };
  return {{wall({0, 0, 0}, {0, 0, 1}),
           wall({9, 0, 0}, {-1, 0, 0}),
           wall({-8, 0, 0}, {1, 0, 0}),
           wall({0, 7, 0}, {0, -1, 0}),
           wall({0, -10, 0}, {0, 1, 0}),
           {.shape = Shape::kBox, .center_m = {4, 2, 0.8}, .size_m = {1.0, 0.8, 0.8}},
           {.shape = Shape::kSphere, .center_m = {-3, -3, 1.0}, .size_m = {1.0, 0, 0}},
           {.shape = Shape::kBox, .center_m = {2, -4, 1.5}, .size_m = {0.15, 0.15, 1.5}}}};
}

Transform Pose() {
  Transform pose = Transform::Identity();
  pose.translate(Eigen::Vector3d(0.2, 0.1, 1.7)).rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  return pose;
}

struct Scanner {
  int num_beams;
  double low_deg, high_deg;
  int num_columns;
};

/// The ranges of all beams, row by row; infinite where nothing is hit.
std::vector<double> Ranges(const Scene& scene, const Transform& pose, const Scanner& scanner) {
  std::vector<double> ranges;
  for (int beam = 0; beam < scanner.num_beams; ++beam) {
    const double elevation =
        (scanner.low_deg + (scanner.high_deg - scanner.low_deg) * beam / (scanner.num_beams - 1)) * M_PI / 180;
    for (int column = 0; column < scanner.num_columns; ++column) {
      const double azimuth = 2 * M_PI * column / scanner.num_columns;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      ranges.push_back(CastRay(scene, pose.translation(), pose.linear() * ray));
    }
  }
  return ranges;
}

/// The least range of the four beams around a direction, which has beams above and below.
double LeastAround(const std::vector<double>& ranges, const Scanner& scanner, double elevation_deg, double azimuth) {
  const double step_deg = (scanner.high_deg - scanner.low_deg) / (scanner.num_beams - 1);
  const int beam = static_cast<int>((elevation_deg - scanner.low_deg) / step_deg);
  const int column = static_cast<int>((azimuth < 0 ? azimuth + 2 * M_PI : azimuth) / (2 * M_PI) * scanner.num_columns);
  double least = std::numeric_limits<double>::infinity();
  for (const int row : {beam, beam + 1}) {
    for (const int next : {column, column + 1}) {
      least = std::min(least, ranges[static_cast<std::size_t>(row * scanner.num_columns + next % scanner.num_columns)]);
    }
  }
  return least;
}

struct ScanScore {
  std::int64_t num_free = 0, num_found = 0, num_unseen = 0, num_wrong = 0;
};

ScanScore CompareScan(const Map& map, const Scene& scene, const Transform& pose, const Scanner& scanner) {
  const MapConfig& config = map.info().config;
  const std::vector<double> ranges = Ranges(scene, pose, scanner);
  ScanScore score;
  ForEachVoxel({-9, -11, -0.5}, {10, 8, 3}, config.voxel_size_m, [&](VoxelIndex voxel) {
    const Eigen::Vector3d p = VoxelCentre(voxel, config.voxel_size_m);
    const Eigen::Vector3d ray = p - pose.translation();
    const double range = ray.norm(), hit = CastRay(scene, pose.translation(), ray / range);
    const Eigen::Vector3d ray_lidar = pose.linear().transpose() * ray;
    const double elevation_deg = std::asin(ray_lidar.z() / range) * 180 / M_PI;
    const bool is_said = map.free_space().IsFree(voxel);
    // The last beams have no neighbour on one side: what lies within a beam of the edge is neither asked for nor wrong.
    const double step_deg = (scanner.high_deg - scanner.low_deg) / (scanner.num_beams - 1);
    const bool in_view = elevation_deg > scanner.low_deg + step_deg && elevation_deg < scanner.high_deg - step_deg;
    const bool is_out = elevation_deg < scanner.low_deg || elevation_deg > scanner.high_deg;
    const double least =
        in_view ? LeastAround(ranges, scanner, elevation_deg, std::atan2(ray_lidar.y(), ray_lidar.x())) : 0;
    if (std::isfinite(least) && range < std::min(least - config.truncation_m, config.integration.max_range_m)) {
      ++score.num_free;
      score.num_found += is_said;
    } else if (is_out || range > hit) {
      ++score.num_unseen;
      score.num_wrong += is_said;
    }
  });
  return score;
}

TEST(LidarLook, FindsWhatAllBeamsAroundGoBeyondAndNothingBehindSurfaces) {
  for (const Scanner& scanner : {Scanner{64, -25, 3, 1800}, Scanner{128, -40, 40, 1024}}) {
    const PanopticFrame frame =
        Scan(Yard(), Pose(), scanner.num_beams, scanner.low_deg, scanner.high_deg, scanner.num_columns);
    const Map map = MapOfLooks(Config(), {frame});
    const ScanScore score = CompareScan(map, Yard(), Pose(), scanner);
    EXPECT_GT(score.num_free, 10'000);
    EXPECT_GE(static_cast<double>(score.num_found), 0.98 * static_cast<double>(score.num_free));
    EXPECT_LE(static_cast<double>(score.num_wrong), 0.001 * static_cast<double>(score.num_unseen));
  }
}

/// The voxel at a place of the scanner's frame.
bool IsFreeAt(const Map& map, const Eigen::Vector3d& p_m) {
  return map.free_space().IsFree(VoxelAt(p_m, map.info().config.voxel_size_m));
}

/// Points of `num_beams` beams `step_deg` apart, centred on the horizon, and 1 degree wide columns all around.
PanopticFrame Fan(int num_beams, double step_deg, double range_m) {
  PanopticFrame frame;
  frame.lidar.emplace();
  for (int beam = 0; beam < num_beams; ++beam) {
    const double elevation = (beam - 0.5 * (num_beams - 1)) * step_deg * M_PI / 180;
    for (int column = 0; column < 720; ++column) {
      const double azimuth = (column + 0.5) * M_PI / 360;
      frame.lidar->points_m.emplace_back(
          (range_m * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                     std::sin(elevation)))
              .cast<float>());
    }
  }
  return frame;
}

TEST(LidarLook, BetweenTwoBeamsItIsAsFarAsTheNearerOneGoes) {
  PanopticFrame frame = Fan(8, 2.0, 10.0);
  const Eigen::Vector3d between = Eigen::Vector3d(8, 0.05, 0).normalized();  // beams 1 degree above and below
  EXPECT_TRUE(IsFreeAt(MapOfLooks(Config(), {frame}), 8 * between));
  for (Eigen::Vector3f& p : frame.lidar->points_m) {
    const double elevation_deg = std::asin(p.z() / p.norm()) * 180 / M_PI;
    if (elevation_deg > 0.9 && elevation_deg < 1.1) p *= 0.5f;  // the beam above
  }
  const Map map = MapOfLooks(Config(), {frame});
  EXPECT_FALSE(IsFreeAt(map, 8 * between));
  EXPECT_TRUE(IsFreeAt(map, 4.5 * between));
  EXPECT_TRUE(IsFreeAt(map, 8 * Eigen::Vector3d(1, 0, -std::tan(2 * M_PI / 180)).normalized()));
}

TEST(LidarLook, WhereABeamIsMissingNothingIsFree) {
  PanopticFrame frame = Fan(9, 2.0, 10.0);
  std::erase_if(frame.lidar->points_m, [](const Eigen::Vector3f& p) { return std::abs(p.z()) < 0.01f; });
  const Map map = MapOfLooks(Config(), {frame});
  for (const double elevation_deg : {-1.5, -0.5, 0.5, 1.5}) {
    EXPECT_FALSE(IsFreeAt(map, 5 * Eigen::Vector3d(1, 0, std::tan(elevation_deg * M_PI / 180)).normalized()));
  }
  EXPECT_TRUE(IsFreeAt(map, 5 * Eigen::Vector3d(1, 0, std::tan(3 * M_PI / 180)).normalized()));
  EXPECT_FALSE(IsFreeAt(map, {0, 0, 3})) << "above all beams";
}

TEST(LidarLook, AReturnFromBeyondTheRangeFreesWhatLiesBeforeItUpToTheRange) {
  const Map map = MapOfLooks(Config(), {Fan(16, 1.0, 80.0)});
  EXPECT_TRUE(IsFreeAt(map, {11.8, 0, 0}));
  EXPECT_FALSE(IsFreeAt(map, {12.2, 0, 0}));
  EXPECT_TRUE(IsFreeAt(map, {-11.8, 0.02, 0})) << "where azimuths go around";
}

}  // namespace
}  // namespace dhpmap
