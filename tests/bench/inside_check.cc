// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "clients/simulator/apartment.h"
#include "mapping/query/body_query.h"
#include "mapping/query/occupancy_slice.h"
#include "mapping/query/point_lookup.h"
#include "tests/bench/bench.h"
#include "tests/bench/recording.h"

namespace dhpmap::bench {
namespace {

using simulator::ApartmentScene;

/// What answers say of places inside a thing, if what is unknown is free.
struct Solidity {
  std::size_t num_points = 0, num_solid = 0, num_behind = 0, num_occupied = 0, num_free = 0;
};

/// Places well inside one of the thing's solids.
std::vector<Eigen::Vector3d> Inside(const ApartmentScene& scene, std::uint8_t instance, double depth_m,
                                    std::mt19937& random) {
  Eigen::AlignedBox3d box;
  for (const simulator::Solid& solid : scene.solids()) {
    if (solid.instance == instance) box.extend(solid.Bounds());
  }
  std::vector<Eigen::Vector3d> places;
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int kTries = 4000;
  constexpr std::size_t kMost = 400;
  for (int n = 0; n < kTries && places.size() < kMost && !box.isEmpty(); ++n) {
    const Eigen::Array3d share{unit(random), unit(random), unit(random)};
    const Eigen::Vector3d p = box.min().array() + share * box.sizes().array();
    if (scene.Distance(p) <= -depth_m && scene.InstanceAt(p) == instance) places.push_back(p);
  }
  return places;
}

/// By a slice of one cell around the place.
bool IsOccupied(const std::shared_ptr<const MapSurfaces>& surfaces, const Eigen::Vector3d& p, double voxel_m) {
  OccupancySlice slice(surfaces, {.min_z_m = p.z() - voxel_m / 2,
                                  .max_z_m = p.z() + voxel_m / 2,
                                  .resolution_m = voxel_m,
                                  .min_m = p.head<2>().array() - voxel_m / 2,
                                  .width = 1,
                                  .height = 1,
                                  .unknown = kFreeCell,
                                  .scope = {}});
  std::int8_t cell = kFreeCell;
  slice.Row(0, {&cell, 1}, {});
  return cell == kOccupiedCell;
}

/// Surfaces where there are none: places in the rooms that are farther from all there is than the map says, by class of
/// what it says is near.
void PrintGhosts(const ApartmentScene& scene, const MapSnapshot& map, const DistanceQuery& distances,
                 std::mt19937& random) {
  struct Ghosts {
    std::size_t num_places = 0;
    double most_m = 0;
    Eigen::Vector3d at_m, nearest_m;
  };
  std::map<std::string, Ghosts> by_class;
  std::uniform_real_distribution<double> x(0, 11), y(0, 8), z(0.2, 1.9);
  constexpr std::size_t kPlaces = 200'000;
  constexpr double kFrom_m = 0.25, kShort_m = 0.06;
  std::size_t num_places = 0;
  for (std::size_t n = 0; n < kPlaces; ++n) {
    const Eigen::Vector3d p{x(random), y(random), z(random)};
    const double true_m = scene.Distance(p);
    if (true_m < kFrom_m) continue;
    ++num_places;
    const SurfaceDistance told = distances.At(p);
    const double short_m = true_m - std::abs(told.distance_m);
    if (told.submap == nullptr || short_m < kShort_m) continue;
    const LabelClass* object_class = map.info().label_set->Find(told.submap->class_id);
    const bool is_unknown = told.submap->panoptic == Panoptic::kUnknown || object_class == nullptr;
    Ghosts& ghosts = by_class[is_unknown ? "nobody knows what" : object_class->name];
    ++ghosts.num_places;
    if (short_m > ghosts.most_m) {
      ghosts.most_m = short_m;
      ghosts.at_m = p;
      ghosts.nearest_m = told.nearest_m;
    }
  }
  for (const auto& [name, ghosts] : by_class) {
    std::printf("ghosts of %-18s at %zu of %zu places, worst %.2f m too near at %.2f %.2f %.2f by %.3f %.3f %.3f\n",
                name.c_str(), ghosts.num_places, num_places, ghosts.most_m, ghosts.at_m.x(), ghosts.at_m.y(),
                ghosts.at_m.z(), ghosts.nearest_m.x(), ghosts.nearest_m.y(), ghosts.nearest_m.z());
  }
}

}  // namespace

Status RunInsideCheck(const InsideCheckOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(options.directory, options.num_frames));
  SurfaceCache cache(std::size_t{1} << 30);
  const auto state = recording.builder->map().Publish(0);
  const auto surfaces = cache.Of(state);
  const BodyQuery bodies(surfaces, {.unknown = UnknownSpace::kFree});
  const DistanceQuery distances(surfaces, {.unknown_is_free = true});
  const PointLookup points(state);
  const ApartmentScene scene;
  std::mt19937 random(options.seed);
  std::map<std::string, Solidity> by_class;
  Solidity all;
  for (const simulator::Instance& instance : scene.instances()) {
    if (!InfoOf(instance.object_class).is_thing) continue;
    Solidity& one = by_class[InfoOf(instance.object_class).name];
    for (const Eigen::Vector3d& p : Inside(scene, instance.id, options.depth_m, random)) {
      for (Solidity* sum : {&one, &all}) {
        ++sum->num_points;
        sum->num_solid += bodies.Test(Capsule{p, p, 0.001}).is_colliding ? 1 : 0;
        sum->num_behind += distances.At(p).distance_m < 0 ? 1 : 0;
        sum->num_occupied += IsOccupied(surfaces, p, recording.voxel_m()) ? 1 : 0;
        sum->num_free += points.At(p).is_free ? 1 : 0;
      }
    }
  }
  by_class["all"] = all;
  for (const auto& [name, sum] : by_class) {
    if (sum.num_points == 0) continue;
    const double share = 100 / static_cast<double>(sum.num_points);
    std::printf("%-16s %5zu places: collide %5.1f %%, distance below 0 %5.1f %%, occupied %5.1f %%, free %5.1f %%\n",
                name.c_str(), sum.num_points, share * static_cast<double>(sum.num_solid),
                share * static_cast<double>(sum.num_behind), share * static_cast<double>(sum.num_occupied),
                share * static_cast<double>(sum.num_free));
  }
  PrintGhosts(scene, *state, distances, random);
  return Status::Ok();
}

}  // namespace dhpmap::bench
