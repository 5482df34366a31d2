// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-bench query: checks of bodies and motions on a data set's map.
#include "tests/bench/check_bench.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include "mapping/query/trajectory_query.h"
#include "tests/bench/cpu_time.h"

namespace dhpmap::bench {
namespace {

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Places that were looked through.
std::vector<Eigen::Vector3d> FreePlaces(const MapSnapshot& map, std::size_t count, std::mt19937& random) {
  const auto tiles = map.free_space()->tiles();
  std::vector<Eigen::Vector3d> places;
  if (tiles.empty()) return places;
  std::uniform_int_distribution<std::size_t> tile(0, tiles.size() - 1);
  std::uniform_int_distribution<int> along(0, kTileSide * kBlockSide - 1);
  for (std::size_t tries = 0; places.size() < count && tries < 1000 * count; ++tries) {
    const TileIndex t = tiles[tile(random)].index;
    constexpr int kSide = kTileSide * kBlockSide;
    const VoxelIndex voxel{t.x * kSide + along(random), t.y * kSide + along(random), t.z * kSide + along(random)};
    if (map.free_space()->IsFree(voxel)) places.push_back(VoxelCentre(voxel, map.info().config.voxel_size_m));
  }
  return places;
}

/// An arm of 20 spheres, 0.8 m long, that goes 0.8 m along and turns by 60 degrees, in 50 waypoints.
RobotMotion ArmFrom(const Eigen::Vector3d& place, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Eigen::Vector3d way = 0.8 * Eigen::Vector3d{unit(random), unit(random), 0.3 * unit(random)}.normalized();
  const double start_rad = 3 * unit(random);
  RobotMotion motion;
  for (int s = 0; s < 20; ++s) {
    auto& knots = motion.spheres.emplace_back();
    for (int h = 0; h < 50; ++h) {
      const double angle_rad = start_rad + h / 49.0, reach_m = 0.042 * s;
      knots.push_back(
          {static_cast<double>(h),
           place + h / 49.0 * way + reach_m * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.2),
           0.04 + 0.001 * s});
    }
  }
  return motion;
}

void MeasureTrajectories(const char* what, const std::shared_ptr<const MapSurfaces>& surfaces,
                         const std::vector<RobotMotion>& motions, UnknownSpace unknown, bool with_clearance = false) {
  const auto query = TrajectoryQuery::Make(
      surfaces, {.bodies = {.unknown = unknown}, .attached = {}, .with_clearance = with_clearance});
  if (!query.ok()) return;
  std::vector<double> valid_ms, invalid_ms;
  for (int repetition = 0; repetition < 2; ++repetition) {  // the first makes surfaces
    valid_ms.clear(), invalid_ms.clear();
    for (const RobotMotion& motion : motions) {
      const double start_s = ThreadCpu_s();
      const auto answer = query->Check(motion);
      (answer->is_valid ? valid_ms : invalid_ms).push_back(1e3 * (ThreadCpu_s() - start_s));
    }
  }
  std::printf("  50 waypoints x 20 spheres, unknown %-16s valid %4zu: median %.3f ms p95 %.3f;  not %4zu: %.3f, %.3f\n",
              what, valid_ms.size(), Quantile(valid_ms, 0.5), Quantile(valid_ms, 0.95), invalid_ms.size(),
              Quantile(invalid_ms, 0.5), Quantile(invalid_ms, 0.95));
}

SphereKnot At(const std::vector<SphereKnot>& knots, double at) {
  const auto i = std::min(static_cast<std::size_t>(at), knots.size() - 2);
  const double share = at - static_cast<double>(i);
  const SphereKnot &a = knots[i], &b = knots[i + 1];
  return {at, a.center_m + share * (b.center_m - a.center_m), a.radius_m + share * (b.radius_m - a.radius_m)};
}

/// How far spheres are from the surface when they are said to touch it first, and how many moments before that, of very
/// many, they touch one at.
void PrintErrors(const std::shared_ptr<const MapSurfaces>& surfaces, const std::vector<RobotMotion>& motions) {
  const SweepQuery sweep(surfaces, {.unknown = UnknownSpace::kFree});
  const DistanceQuery distances(surfaces, {});
  const double voxel_m = surfaces->state().info().config.voxel_size_m;
  constexpr double kSame_m = 1e-5, kMomentsAWaypoint = 10;
  std::vector<double> errors_vox;
  std::size_t num_moments = 0, num_missed = 0;
  for (const RobotMotion& motion : motions) {
    const std::vector<SphereKnot>& knots = motion.spheres.back();
    const SweepAnswer answer = sweep.First(knots);
    const double end = answer.first ? answer.first->at : knots.back().at;
    for (int moment = 0; moment < kMomentsAWaypoint * end; ++moment) {
      const SphereKnot knot = At(knots, moment / kMomentsAWaypoint);
      ++num_moments;
      num_missed += std::abs(distances.At(knot.center_m).distance_m) < knot.radius_m - kSame_m;
    }
    if (!answer.first || answer.first->at == 0) continue;
    const SphereKnot knot = At(knots, answer.first->at);
    errors_vox.push_back(std::abs(std::abs(distances.At(knot.center_m).distance_m) - knot.radius_m) / voxel_m);
  }
  std::printf(
      "  first contacts of %zu spheres: gap in voxels median %.5f p99 %.5f max %.5f; missed %zu of %zu moments\n",
      errors_vox.size(), Quantile(errors_vox, 0.5), Quantile(errors_vox, 0.99), Quantile(errors_vox, 1), num_missed,
      num_moments);
}

}  // namespace

void MeasureChecks(const std::shared_ptr<const MapSurfaces>& surfaces) {
  std::mt19937 random(5);
  const MapSnapshot& map = surfaces->state();
  const std::vector<Eigen::Vector3d> places = FreePlaces(map, 20'000, random);
  if (places.empty()) return;
  const BodyQuery query(surfaces, {});
  std::size_t num_colliding = 0;
  const auto measure = [&](const char* what, const std::function<Body(const Eigen::Vector3d&)>& make, bool whether) {
    double best_s = 1e9;
    for (int repetition = 0; repetition < 2; ++repetition) {
      num_colliding = 0;
      const double start_s = ThreadCpu_s();
      for (const Eigen::Vector3d& p : places) {
        num_colliding += (whether ? query.Test(make(p)) : query.Check(make(p))).is_colliding;
      }
      best_s = std::min(best_s, ThreadCpu_s() - start_s);
    }
    std::printf("  %-34s %8.3f M/s, %2.0f %% collide\n", what, 1e-6 * static_cast<double>(places.size()) / best_s,
                100 * static_cast<double>(num_colliding) / static_cast<double>(places.size()));
  };
  const auto sphere = [](const Eigen::Vector3d& p) -> Body { return Capsule{p, p, 0.1}; };
  measure("spheres of 10 cm: whether", sphere, true);
  measure("the same with the contact", sphere, false);
  measure(
      "capsules of 5 cm, 40 cm long",
      [](const auto& p) -> Body {
        return Capsule{p, p + Eigen::Vector3d(0.2, 0.2, 0.28), 0.05};
      },
      true);
  measure(
      "boxes of 30 x 20 x 10 cm",
      [](const auto& p) -> Body {
        OrientedBox box{Transform::Identity(), {0.15, 0.1, 0.05}};
        box.T_world_box.translate(p);
        box.T_world_box.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 2) / 3));
        return box;
      },
      true);
  std::vector<RobotMotion> motions;
  for (std::size_t i = 0; i < std::min<std::size_t>(300, places.size()); ++i) {
    motions.push_back(ArmFrom(places[i], random));
  }
  MeasureTrajectories("occupied:", surfaces, motions, UnknownSpace::kOccupied);
  MeasureTrajectories("free:", surfaces, motions, UnknownSpace::kFree);
  MeasureTrajectories("free, clearance:", surfaces, motions, UnknownSpace::kFree, /*with_clearance=*/true);
  PrintErrors(surfaces, motions);
}

}  // namespace dhpmap::bench
