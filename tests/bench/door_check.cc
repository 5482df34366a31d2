// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "clients/simulator/apartment.h"
#include "mapping/query/distance_query.h"
#include "tests/bench/bench.h"
#include "tests/bench/recording.h"

namespace dhpmap::bench {
namespace {

using simulator::ApartmentScene;

struct Door {
  Eigen::Vector2d middle_m, through;  ///< on the floor, and across the wall
};

/// Between each two upright posts of the class door that face each other.
std::vector<Door> DoorsOf(const ApartmentScene& scene) {
  std::vector<Eigen::AlignedBox3d> posts;
  for (const simulator::Solid& solid : scene.solids()) {
    const auto& instance = *std::find_if(scene.instances().begin(), scene.instances().end(),
                                         [&](const auto& one) { return one.id == solid.instance; });
    constexpr double kLeastHeight_m = 1.5;
    if (instance.object_class != simulator::ObjectClass::kDoor) continue;
    if (solid.Bounds().sizes().z() > kLeastHeight_m) posts.push_back(solid.Bounds());
  }
  std::vector<Door> doors;
  std::vector<bool> is_taken(posts.size());
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const Eigen::Vector3d a = posts[i].center();
    std::size_t other = posts.size();
    double least_m = 2.5;
    for (std::size_t k = i + 1; k < posts.size() && !is_taken[i]; ++k) {
      const Eigen::Vector3d b = posts[k].center();
      const Eigen::Vector2d way = b.head<2>() - a.head<2>();
      const bool is_opposite = way.cwiseAbs().minCoeff() < 1e-6;
      if (is_taken[k] || !is_opposite || way.norm() >= least_m) continue;
      other = k;
      least_m = way.norm();
    }
    if (other == posts.size()) continue;
    is_taken[other] = true;
    const Eigen::Vector3d b = posts[other].center();
    const Eigen::Vector2d along = (b.head<2>() - a.head<2>()).normalized();
    doors.push_back({(a.head<2>() + b.head<2>()) / 2, Eigen::Vector2d(-along.y(), along.x())});
  }
  return doors;
}

std::string NameOf(const MapSnapshot& map, const SubmapInfo& submap) {
  const LabelClass* known = map.info().label_set->Find(submap.class_id);
  return submap.panoptic == Panoptic::kUnknown || known == nullptr ? "nobody knows what" : known->name;
}

}  // namespace

Status RunDoorCheck(const DoorCheckOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(options.directory, options.num_frames));
  SurfaceCache cache(std::size_t{1} << 30);
  const auto state = recording.builder->map().Publish(0);
  const DistanceQuery distances(cache.Of(state), {.unknown_is_free = true});
  const ApartmentScene scene;
  constexpr double kStep_m = 0.02, kWay_m = 0.6, kLow_m = 0.5, kHigh_m = 1.7;
  for (const Door& door : DoorsOf(scene)) {
    double least_m = 1e9, true_least_m = 1e9, worst_m = 0, in_middle_m = 1e9;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    SurfaceDistance worst;
    for (double t = -kWay_m; t <= kWay_m; t += kStep_m) {
      for (double z = kLow_m; z <= kHigh_m; z += kStep_m) {
        const Eigen::Vector2d floor = door.middle_m + t * door.through;
        const Eigen::Vector3d p(floor.x(), floor.y(), z);
        const double true_m = scene.Distance(p);
        const SurfaceDistance told = distances.At(p);
        least_m = std::min(least_m, told.distance_m);
        true_least_m = std::min(true_least_m, true_m);
        if (std::abs(t) < kStep_m / 2) in_middle_m = std::min(in_middle_m, told.distance_m);
        if (told.submap == nullptr || true_m - told.distance_m <= worst_m) continue;
        worst_m = true_m - told.distance_m;
        at = p;
        worst = told;
      }
    }
    std::printf("door at %.2f %.2f: on the way through no nearer than %.3f m, by the scene %.3f; in the middle %.3f\n",
                door.middle_m.x(), door.middle_m.y(), least_m, true_least_m, in_middle_m);
    if (worst.submap == nullptr) continue;
    std::printf("  most short, %.3f m, at %.2f %.2f %.2f by %.3f %.3f %.3f of %s\n", worst_m, at.x(), at.y(), at.z(),
                worst.nearest_m.x(), worst.nearest_m.y(), worst.nearest_m.z(), NameOf(*state, *worst.submap).c_str());
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench
